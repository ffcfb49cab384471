#include "sinew/run/bring_up/bring_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/run/bring_up/muscles.h"
#include "sinew/run/bring_up/progress.h"
#include "sinew/run/bring_up/wires.h"
#include "sinew/run/bring_up/wiring_drawing.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/output_folder.h"
#include "sinew/run/simulation/remote_boards.h"

namespace sinew::run {

namespace fs = std::filesystem;

namespace {

// Each joint where the sensors' rest counts are taken, without stiffness.
config::Node joints_of(const robot::Robot& robot, std::string_view key, bool angles) {
  config::Node out = config::make_table(key);
  for (const robot::Joint& j : robot.joints)
    if (angles)
      out.put(config::make_text(j.name, fmt::format("{} rad", j.rest_angle)));
    else if (j.kind == robot::Joint::Kind::driven)
      out.put(config::make_text(j.name, "0 N m/rad"));
  return out;
}

}  // namespace

experiment::Experiment bench_of(const std::string& robot, const fs::path& folder,
                                const std::vector<std::string>& sets) {
  config::Node root = config::parse_text(
      "format = \"sinew.experiment/1\"\n"
      "title = \"The robot hangs empty and does nothing\"\n"
      "[sequence]\nphases = [\"rest\"]\n"
      "[phase.rest]\nsource = \"sinew bring-up\"\nduration = \"1 s\"\n",
      "bench.toml");
  const robot::Robot machine = experiment::load_machine_file(robot).experiment.robot;
  config::Node start = config::make_table("start"), control = config::make_table("control");
  start.put(config::make_text("pressure", "0 psi gauge"));
  start.put(config::make_text("settle", "1 s"));
  start.put(joints_of(machine, "joint_angles", true));
  control.put(joints_of(machine, "stiffness", false));
  if (machine.ground.present) {
    config::Node ground = config::make_table("ground");
    ground.put(config::make_flag("present", false));
    root.put(std::move(ground));
  }
  root.put(std::move(start));
  root.put(std::move(control));
  const fs::path there = fs::absolute(folder);
  root.put(config::make_text("robot", fs::absolute(robot).lexically_relative(there).string()));
  make_folders(there);
  write_file(there / "bench.toml", config::to_toml(root));
  return experiment::load((there / "bench.toml").string(), sets);
}

// --- the steps ----------------------------------------------------------------------------------

namespace {

struct Result {
  std::vector<std::string> wrong;  // empty: the step is done
  std::vector<std::string> said;
};

struct NobodyAnswers {};

struct Step {
  std::string name, title;
  std::function<Result()> work;
};

struct Rest {
  double mean = 0, deviation = 0;
  int readings = 0, bad = 0;
};

Rest rest_of(const Recording& r, std::size_t channel) {
  Rest out;
  for (const Sample& s : r.samples) {
    out.mean += s.counts[channel];
    out.bad += s.status[channel] != signals::Status::ok;
    ++out.readings;
  }
  out.mean /= std::max(out.readings, 1);
  for (const Sample& s : r.samples) out.deviation += std::pow(s.counts[channel] - out.mean, 2);
  out.deviation = std::sqrt(out.deviation / std::max(out.readings - 1, 1));
  return out;
}

}  // namespace

struct BringUp::Impl {
  Impl(const experiment::Experiment& bench, std::string robot_file, plant::RemoteBoard& b, int l,
       Person p, const fs::path& where)
      : e(bench),
        robot(std::move(robot_file)),
        board(only_board(bench)),
        configuration(configuration_of(bench)),
        muscles(bench_muscles(bench, board, nullptr)),
        remote(&b),
        lead(l),
        person(std::move(p)),
        folder(where),
        progress(read_progress(folder.path() / "bring-up.json", robot)) {
    draw_wiring();
  }

  void draw_wiring() const {
    write_file(folder.path() / "wiring.svg", wiring_drawing(e, board, pins));
  }

  // --- what a step does ---

  Result identify() {
    const link::Identity who = remote->identify();
    const auto text = [](const auto& name) {
      return std::string(name.begin(), std::find(name.begin(), name.end(), '\0'));
    };
    progress.board = fmt::format("{}, firmware {}", text(who.board), text(who.firmware));
    pins = pins_of(text(who.board));
    muscles = bench_muscles(e, board, pins);
    draw_wiring();
    Result out{.said = {progress.board}};
    if (who.protocol != link::protocol_version)
      out.wrong.push_back(
          fmt::format("it speaks version {} of the protocol, this program {}: flash "
                      "the firmware of this release",
                      who.protocol, link::protocol_version));
    return out;
  }

  std::string wire_of(const std::string& sensor) const {
    for (const Wire& wire : sensor_wires(e, board, pins))
      if (wire.name == sensor) return wire.in_words();
    return "";
  }

  // A robot that hangs empty and still.
  Result sensors() {
    ask_for("Are the muscles empty, the supply's air off, and does the machine hang still?");
    remote->configure(configuration);
    const Recording heard = listen(*remote, configuration, 1.0);
    Result out;
    for (std::size_t i = 0; i < board.channel.size(); ++i) {
      const robot::Sensor& s = e.robot.sensors[board.channel[i]];
      const Rest rest = rest_of(heard, i);
      out.said.push_back(fmt::format("{}: {:.1f} count, noise {:.2f} ({})", s.name, rest.mean,
                                     rest.deviation, wire_of(s.name)));
      if (const std::string wrong = wrong_with(s, rest, board.limits.sensor[i]); !wrong.empty())
        out.wrong.push_back(wrong);
      progress.learned[s.name] = {rest.mean, rest.deviation, rest.readings};
    }
    return out;
  }

  std::string wrong_with(const robot::Sensor& s, const Rest& rest,
                         const control::SensorLimits& limits) const {
    const double top = e.robot.converter.top(), share = 0.05 * top;
    const std::string wire = wire_of(s.name);
    if (rest.bad > 0)
      return fmt::format("{}: {} of {} readings did not come in time or are none ({})", s.name,
                         rest.bad, rest.readings, wire);
    // A transducer may rest at the scale's end; whether it is alive a muscle will show.
    const bool rests_there = s.assumed_at_rest < 4 || s.assumed_at_rest > top - 4;
    if ((rest.mean < 4 || rest.mean > top - 4) && !rests_there)
      return fmt::format(
          "{} reads {:.0f}, an end of the converter's scale: look at its cable and its "
          "supply ({})",
          s.name, rest.mean, wire);
    if (rest.mean < limits.low || rest.mean > limits.high)
      return fmt::format("{} reads {:.0f}; expected {} to {}: is its cable another's? ({})", s.name,
                         rest.mean, limits.low, limits.high, wire);
    const bool has_zero = s.kind == robot::Sensor::Kind::tension ||
                          s.kind == robot::Sensor::Kind::pressure ||
                          s.kind == robot::Sensor::Kind::angle;
    if (has_zero && std::abs(rest.mean - s.assumed_at_rest) > share)
      return fmt::format(
          "{} reads {:.0f} at rest; expected {:.0f}, within {:.0f}: is it loaded, or "
          "its cable another's? ({}); a robot whose sensor is so says it with "
          "sensor.{}.assumed.at_rest",
          s.name, rest.mean, s.assumed_at_rest, share, wire, s.name);
    return "";
  }

  Result clicks() {
    ask_for("Is the supply's air still off? Each valve is to click five times now.");
    Result out;
    for (const BenchMuscle& m : muscles)
      for (const bool inlet : {true, false}) {
        const Trial t = tried(click(m, inlet));
        const std::string what = fmt::format("the {} of {} ({})", inlet ? "inlet" : "exhaust",
                                             m.name, inlet ? m.inlet : m.exhaust);
        if (!t.problem.empty()) return {{"the board ended the trial: " + t.problem}, {}};
        if (answer("Did " + what + " click five times, and no other valve until the end?"))
          out.said.push_back(what);
        else
          out.wrong.push_back(what +
                              " did not click alone: look at its wire, its driver and the "
                              "driver's supply");
      }
    return out;
  }
  std::vector<Stage> click(const BenchMuscle& m, bool inlet) const {
    std::vector<control::Duties> open(configuration.spine.joints);
    control::Duties& d = open[m.board_joint];
    (m.flexor ? (inlet ? d.flexor_inlet : d.flexor_exhaust)
              : (inlet ? d.extensor_inlet : d.extensor_exhaust)) = 100;
    std::vector<Stage> out;
    for (int i = 0; i < 5; ++i) {
      out.push_back({0.15, open});
      out.push_back({0.25, {}});
    }
    return out;
  }

  // Coils without current let no air in.
  Result rest_with_air() {
    ask_for("Now open the supply's air, and stay clear of the machine. Is it open?");
    const Trial t = tried({{1.5, {}}});
    Result out;
    if (!t.problem.empty()) out.wrong.push_back("the board ended the trial: " + t.problem);
    for (const BenchMuscle& m : muscles) {
      const auto channel = m.tension ? m.tension : m.angle;
      if (!channel || !t.problem.empty()) continue;
      const double moved = t.stages[0].after(*channel) - t.stages[0].before(*channel);
      const double off = t.stages[0].after(*channel) - progress.learned[sensor(*channel)].at_rest;
      if (std::abs(moved) > 60 || (m.tension && std::abs(off) > 600))
        out.wrong.push_back(
            fmt::format("{} is {:+.0f} count off its rest though nothing is to be open: is the "
                        "inlet of {} ({}) open at rest, or its driver's polarity turned round? "
                        "Shut the air off",
                        sensor(*channel), off, m.name, m.inlet));
    }
    return out;
  }
  const std::string& sensor(std::size_t channel) const {
    return e.robot.sensors[board.channel[channel]].name;
  }

  Result muscle(std::size_t which) {
    const Trial t = tried(stages_for(muscles[which], configuration.spine.joints));
    const Judgement j = judge(muscles, which, t);
    filled_angle[muscles[which].name] = j.filled_angle;
    return {j.wrong, {j.said}};
  }

  // The board's own stop, and a person's.
  Result stop() {
    std::vector<control::Duties> all(configuration.spine.joints);
    for (const BenchMuscle& m : muscles)
      if (m.flexor) all[m.board_joint] = {100, 0, 0, 0};
    const Trial t = tried({{0.4, all}}, End::at_once);
    Result out;
    if (!t.problem.empty()) out.wrong.push_back("the board ended the trial: " + t.problem);
    const Recording after = listen(*remote, configuration, 1.0);
    for (const BenchMuscle& m : muscles) {
      if (!m.tension || !out.wrong.empty()) continue;
      const double rest = progress.learned[sensor(*m.tension)].at_rest;
      const double left = std::abs(after.after(*m.tension) - rest);
      double pulled = 0;
      for (const Sample& s : t.stages[0].samples)
        pulled = std::max(pulled, std::abs(s.counts[*m.tension] - rest));
      if (left > std::max(300.0, 0.5 * pulled))  // a cord may stay tight without air
        out.wrong.push_back(
            fmt::format("{} still pulls ({:.0f} count) a second after the stop", m.name, left));
    }
    if (!answer("Press the emergency stop now. Did the dump valve let the air out?"))
      out.wrong.push_back(
          "the emergency stop does not let the air out: nobody works at this machine "
          "until it does");
    return out;
  }

  // While valves move a person can stop them.
  Trial tried(const std::vector<Stage>& stages, End end = End::by_plan) {
    struct Moves {
      explicit Moves(const Person& p) : person(p) { tell(true); }
      ~Moves() { tell(false); }
      void tell(bool now) const {
        if (person.moves) person.moves(now);
      }
      const Person& person;
    } const moves(person);
    return try_out(*remote, configuration, lead, stages, end, person.stops);
  }

  // --- the person ---

  bool answer(const std::string& question) {
    const std::optional<bool> said = person.ask(question);
    if (!said) throw NobodyAnswers{};
    return *said;
  }
  void ask_for(const std::string& question) {
    if (!answer(question)) throw NobodyAnswers{};
  }

  // --- all of it ---

  std::vector<Step> steps() {
    std::vector<Step> out{
        {"board", "who is at the line", [this] { return identify(); }},
        {"sensors", "what the sensors read at rest", [this] { return sensors(); }},
        {"clicks", "each valve clicks", [this] { return clicks(); }},
        {"rest", "with air, nothing moves by itself", [this] { return rest_with_air(); }}};
    for (std::size_t i = 0; i < muscles.size(); ++i)
      out.push_back({"muscle " + muscles[i].name, "fill, hold and empty " + muscles[i].name,
                     [this, i] { return muscle(i); }});
    out.push_back({"stop", "stop in an emergency", [this] { return stop(); }});
    return out;
  }

  bool work_off(const Step& step, std::size_t number, std::size_t count) {
    if (progress.done.contains(step.name) && step.name != "board") {
      person.tell(fmt::format("{}/{} {}: done before", number, count, step.title));
      return true;
    }
    person.tell(fmt::format("{}/{} {}", number, count, step.title));
    const Result r = step.work();
    for (const std::string& line : r.said) person.tell("    " + line);
    for (const std::string& line : r.wrong) person.tell("    wrong: " + line);
    if (r.wrong.empty()) progress.done[step.name] = r.said;
    write_progress(progress, folder.path() / "bring-up.json");
    return r.wrong.empty();
  }

  experiment::Experiment e;
  std::string robot;
  control::Board board;
  const Pins* pins = nullptr;  // of the board that has answered
  link::Configuration configuration;
  std::vector<BenchMuscle> muscles;
  plant::RemoteBoard* remote;
  int lead;
  Person person;
  OutputFolder folder;
  Progress progress;
  std::map<std::string, double> filled_angle;
};

BringUp::BringUp(const experiment::Experiment& bench, std::string robot, plant::RemoteBoard& board,
                 int lead, Person person, const fs::path& folder)
    : impl_(std::make_unique<Impl>(bench, std::move(robot), board, lead, std::move(person),
                                   folder)) {}

BringUp::~BringUp() = default;

bool BringUp::go() {
  const std::vector<Step> steps = impl_->steps();
  try {
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (!impl_->work_off(steps[i], i + 1, steps.size())) {
        impl_->person.tell("Mend that, then run the same command again: it goes on from here.");
        return false;
      }
  } catch (const Stopped&) {
    impl_->person.tell("Stopped: the muscles were vented. The same command goes on from here.");
    return false;
  } catch (const NobodyAnswers&) {
    impl_->person.tell("Stopped. The same command goes on from here.");
    return false;
  }
  const fs::path out = impl_->folder.path() / "robot.toml";
  write_file(out, learned_robot(impl_->progress, impl_->robot, impl_->folder.path()));
  impl_->person.tell("All steps are done. What was learned is " + out.string());
  return true;
}

}  // namespace sinew::run
