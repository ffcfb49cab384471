#include "sinew/run/bring_up/bring_up.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "sinew/control/supervise/limits.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/json/json.h"
#include "sinew/robot/robot.h"
#include "sinew/run/bring_up/muscles.h"
#include "sinew/run/bring_up/trial.h"
#include "sinew/run/bring_up/wires.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/simulation/remote_boards.h"
#include "sinew/units/hash.h"

namespace sinew::run {

namespace {

constexpr const char* format = "sinew.bring_up/1";

config::Node count_of(double count, const RestReadings& l) {
  config::Node out = config::make_table("at_rest");
  out.put(config::make_text("value", fmt::format("{:.1f} count", count)));
  out.put(config::make_text(
      "uncertainty",
      fmt::format("{:.2f} count", std::max(0.5, 2 * l.noise / std::sqrt(l.readings)))));
  out.put(config::make_text(
      "source", fmt::format("sinew bring-up: mean of {} readings, empty and still", l.readings)));
  return out;
}

}  // namespace

Progress read_progress(const std::filesystem::path& file, const std::string& robot) {
  if (!std::filesystem::exists(file)) return {.robot = robot};
  Progress out;
  try {
    std::ifstream in(file);
    Json root;
    if (!Json::parse(in, root) || root.at("format") != format) throw std::runtime_error("format");
    out.robot = root.at("robot").string();
    out.board = root.at("board").string();
    if (root.contains("machine")) out.machine = root.at("machine").string();
    for (const auto& [name, findings] : root.at("steps").items())
      out.done[name] = findings.strings();
    for (const auto& [name, l] : root.at("sensors").items())
      out.rest_readings[name] = {l.at("at_rest_count").number(), l.at("noise_count").number(),
                                 static_cast<int>(l.at("readings").integer())};
    if (const Json* joints = root.find("joints"))
      for (const auto& [name, s] : joints->items())
        out.strokes[name] = {s.at("lowest_count").number(), s.at("highest_count").number()};
  } catch (const std::exception&) {
    config::fail({file.string(), 0, 0}, "", "no bring-up of ours", std::string("format ") + format,
                 "another folder");
  }
  if (out.robot != robot)
    config::fail({file.string(), 0, 0}, "robot", out.robot, robot,
                 "another folder: this one has the steps of another robot");
  return out;
}

void write_progress(const Progress& p, const std::filesystem::path& file) {
  Json root{{"format", format},     {"robot", p.robot},        {"board", p.board},
            {"machine", p.machine}, {"steps", Json::object()}, {"sensors", Json::object()}};
  for (const auto& [name, findings] : p.done) root["steps"][name] = findings;
  for (const auto& [name, l] : p.rest_readings)
    root["sensors"][name] = {
        {"at_rest_count", l.at_rest}, {"noise_count", l.noise}, {"readings", l.readings}};
  root["joints"] = Json::object();
  for (const auto& [name, s] : p.strokes)
    root["joints"][name] = {{"lowest_count", s.lowest}, {"highest_count", s.highest}};
  write_file(file, root.exact_text(2) + "\n");
}

std::string measured_robot(const Progress& p, const std::filesystem::path& base,
                           const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  config::Node root = config::make_table("");
  root.put(config::make_text("format", "sinew.robot/1"));
  root.put(config::make_text(
      "base",
      fs::weakly_canonical(base).lexically_relative(fs::weakly_canonical(folder)).string()));
  config::Node sensors = config::make_table("sensor");
  for (const auto& [name, l] : p.rest_readings) {
    config::Node sensor = config::make_table(name);
    for (const char* side : {"real", "assumed"}) {
      config::Node group = config::make_table(side);
      group.put(count_of(l.at_rest, l));
      sensor.put(std::move(group));
    }
    sensors.put(std::move(sensor));
  }
  root.put(std::move(sensors));
  return config::to_toml(root);
}

namespace {

// --- clicks: each valve of the board alone, five times, heard by the operator ---

// A valve that the operator listens to.
struct BenchValve {
  std::string what;  // "the inlet of hip_flexor (output 0: bit 0, pins 31 and 32)"
  std::size_t board_joint = 0;
  std::int32_t control::Duties::*duty = nullptr;  // the duty that opens it
};

using control::Duties;
using control::JointKind;

std::string to_text(const Wire& wire) {
  const std::size_t space = wire.name.rfind(' ');
  return fmt::format("the {} of {} ({})", wire.name.substr(space + 1), wire.name.substr(0, space),
                     wire.to_text());
}

// Returns all valves that the board's outputs drive: those of the muscles, then the four of a
// cylinder. `pins` as in wires.h.
std::vector<BenchValve> bench_valves(const experiment::Experiment& e, const control::Board& board,
                                     const std::vector<BenchMuscle>& muscles, const Pins* pins) {
  const std::vector<Wire> wires = valve_wires(e, board, pins);
  std::vector<BenchValve> out;
  const auto add = [&](std::size_t joint, signals::Valve valve, std::int32_t Duties::*duty) {
    if (wires[valve.index].driven) out.push_back({to_text(wires[valve.index]), joint, duty});
  };
  for (const BenchMuscle& m : muscles) {
    const control::JointConfig& c = board.joint_controller.joint[m.board_joint];
    const control::MuscleConfig& muscle = m.flexor ? c.flexor : c.extensor;
    add(m.board_joint, muscle.inlet, m.flexor ? &Duties::flexor_inlet : &Duties::extensor_inlet);
    if (m.has_exhaust)
      add(m.board_joint, muscle.exhaust,
          m.flexor ? &Duties::flexor_exhaust : &Duties::extensor_exhaust);
  }
  for (std::size_t j = 0; j < board.joint_controller.joints; ++j) {
    const control::JointConfig& c = board.joint_controller.joint[j];
    if (c.kind != JointKind::cylinder) continue;
    add(j, c.flexor.inlet, &Duties::flexor_inlet);
    add(j, c.flexor.exhaust, &Duties::flexor_exhaust);
    add(j, c.extensor.inlet, &Duties::extensor_inlet);
    add(j, c.extensor.exhaust, &Duties::extensor_exhaust);
  }
  return out;
}

// Returns the stages that click the valve.
std::vector<Stage> clicks_of(const BenchValve& valve, std::size_t joints) {
  std::vector<Duties> open(joints);
  open[valve.board_joint].*valve.duty = 100;
  std::vector<Stage> out;
  for (int i = 0; i < 5; ++i) {
    out.push_back({0.15, open});
    out.push_back({0.25, {}});
  }
  return out;
}

// Returns the names of the parts that move the machine but are not tried with air by any step:
// cylinders and regulators.
std::vector<std::string> not_tried(const experiment::Experiment& e, const control::Board& board) {
  std::vector<std::string> out;
  for (std::size_t j = 0; j < board.joint_controller.joints; ++j) {
    const JointKind kind = board.joint_controller.joint[j].kind;
    if (kind == JointKind::cylinder) out.emplace_back("the cylinder with air");
    if (kind == JointKind::regulated)
      out.push_back(fmt::format("the regulators of {}",
                                e.robot.joints[static_cast<std::size_t>(board.joint[j])].name));
  }
  return out;
}

// --- sensors at rest: readings of a machine that hangs empty and still, and their faults ---

struct Rest {
  double mean = 0, deviation = 0;  // [count]
  int readings = 0, bad = 0;       // bad: late or invalid
};

// Returns the statistics of a channel's readings while nothing moves.
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

// Returns a sentence with the fault of a sensor and its remedy; empty if there is no fault. `top`
// is the converter's highest count, `wire` describes the sensor's wiring.
std::string wrong_with(const robot::Sensor& s, const Rest& rest,
                       const control::SensorLimits& limits, double top, const std::string& wire) {
  const double share = 0.05 * top;
  if (rest.bad > 0)
    return fmt::format("{}: {} of {} readings did not come in time or are none ({})", s.name,
                       rest.bad, rest.readings, wire);
  // A transducer may rest at the end of its scale; its muscle's step shows later whether it works.
  const bool rests_there = s.assumed_at_rest < 4 || s.assumed_at_rest > top - 4;
  if ((rest.mean < 4 || rest.mean > top - 4) && !rests_there)
    return fmt::format(
        "{} reads {:.0f}, an end of the converter's scale: check its cable and its "
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
        "its cable another's? ({}); for a robot whose sensor reads this, set "
        "sensor.{}.assumed.at_rest",
        s.name, rest.mean, s.assumed_at_rest, share, wire, s.name);
  return "";
}

namespace fs = std::filesystem;

// --- the steps ---

struct Result {
  std::vector<std::string> wrong;  // empty: the step is done
  std::vector<std::string> findings;
};

struct NoReply {};

struct Step {
  std::string name, title;
  std::function<Result()> work;
  bool with_air = false;
};

// Returns a hash of all values of the robot and its settings.
std::string machine_of(const experiment::Experiment& bench) {
  return fmt::format("{:016x}",
                     units::hash(config::to_toml(experiment::values_in_si({"experiment", bench}))));
}

}  // namespace

struct BringUp::Impl {
  Impl(const experiment::Experiment& bench, std::string robot_file, plant::RemoteBoard& b, int l,
       Operator p, const fs::path& where)
      : e(bench),
        robot(fs::weakly_canonical(robot_file).string()),
        board(only_board(bench)),
        configuration(bench_configuration_of(bench)),
        muscles(bench_muscles(bench, board, nullptr)),
        remote(&b),
        lead(l),
        bench_operator(std::move(p)),
        folder(where),
        progress(read_progress(folder.path() / "bring-up.json", robot)) {
    remote->stop_when(bench_operator.stops);
    begin_again_if(progress.machine != machine_of(bench),
                   "the robot's values are others than at the last time");
    progress.machine = machine_of(bench);
    draw_wiring();
  }

  void draw_wiring() const {
    write_file(folder.path() / "wiring.svg", wiring_drawing(e, board, pins));
  }

  // --- the work of each step ---

  Result identify() {
    const link::Identity who = remote->identify();
    const auto text = [](const auto& name) {
      return std::string(name.begin(), std::find(name.begin(), name.end(), '\0'));
    };
    const std::string found = fmt::format("{}, firmware {}", text(who.board), text(who.firmware));
    begin_again_if(progress.board != found,
                   "this is another board or program than " + config::in_quotes(progress.board));
    progress.board = found;
    pins = pins_of(text(who.board));
    muscles = bench_muscles(e, board, pins);
    draw_wiring();
    Result out{.findings = {progress.board}};
    if (const std::string fault = plant::fault_found(who); !fault.empty())
      out.findings.push_back(fault);
    if (who.protocol != link::protocol_version)
      out.wrong.push_back(
          fmt::format("it has version {} of the protocol, this program {}: flash "
                      "the firmware of this release",
                      who.protocol, link::protocol_version));
    return out;
  }

  std::string wire_of(const std::string& sensor) const {
    for (const Wire& wire : sensor_wires(e, board, pins))
      if (wire.name == sensor) return wire.to_text();
    return "";
  }

  // Requires a robot that hangs empty and still.
  Result sensors() {
    ask_for("Are the muscles empty, the supply's air off, and does the machine hang still?");
    remote->configure(configuration);
    const Recording recording = listen(*remote, configuration, 1.0);
    Result out;
    for (std::size_t i = 0; i < board.channel.size(); ++i) {
      const robot::Sensor& s = e.robot.sensors[board.channel[i]];
      const Rest rest = rest_of(recording, i);
      out.findings.push_back(fmt::format("{}: {:.1f} count, noise {:.2f} ({})", s.name, rest.mean,
                                         rest.deviation, wire_of(s.name)));
      if (const std::string wrong =
              wrong_with(s, rest, board.limits.sensor[i], e.robot.converter.top(), wire_of(s.name));
          !wrong.empty())
        out.wrong.push_back(wrong);
      progress.rest_readings[s.name] = {rest.mean, rest.deviation, rest.readings};
    }
    return out;
  }

  Result clicks() {
    ask_for("Is the supply's air still off? Each valve is to click five times now.");
    Result out;
    for (const BenchValve& valve : bench_valves(e, board, muscles, pins)) {
      const Trial t = tried(clicks_of(valve, configuration.joint_controller.joints));
      if (!t.problem.empty()) return {{"the board ended the trial: " + t.problem}, {}};
      if (answer("Did " + valve.what + " click five times, and no other valve until the end?"))
        out.findings.push_back(valve.what);
      else
        out.wrong.push_back(valve.what +
                            " did not click alone: check its wire, its driver and the "
                            "driver's supply");
    }
    return out;
  }

  // Checks that coils without current let no air in.
  Result rest_with_air() {
    const Trial t = tried({{1.5, {}}});
    Result out;
    if (!t.problem.empty()) out.wrong.push_back("the board ended the trial: " + t.problem);
    for (const BenchMuscle& m : muscles) {
      const auto channel = m.tension ? m.tension : m.angle;
      if (!channel || !t.problem.empty()) continue;
      const double moved = t.stages[0].after(*channel) - t.stages[0].before(*channel);
      const double off =
          t.stages[0].after(*channel) - progress.rest_readings[sensor(*channel)].at_rest;
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
    const Trial t = tried(stages_for(muscles[which], configuration.joint_controller.joints));
    const MuscleResult j = evaluate(muscles, which, t);
    return {j.wrong, {j.findings}};
  }

  Result stroke(const BenchJoint& joint) {
    Result out;
    std::vector<double> ends;
    for (const std::size_t m : joint.muscles) {
      const Trial t = tried(stroke_of(muscles[m], configuration.joint_controller.joints));
      if (!t.problem.empty()) return {{"the board ended the trial: " + t.problem}, {}};
      ends.push_back(end_of_stroke(joint, t));
      out.findings.push_back(fmt::format("{} pulls {} to {:.0f} count", muscles[m].name,
                                         joint.angle_sensor, ends.back()));
    }
    out.wrong = wrong_with_ends(joint, muscles, ends);
    const auto [lowest, highest] = std::ranges::minmax(ends);
    progress.strokes[joint.name] = {lowest, highest};
    return out;
  }

  // Checks the stop by the board and the operator's emergency stop.
  Result stop() {
    std::vector<control::Duties> all(configuration.joint_controller.joints);
    for (const BenchMuscle& m : muscles)
      if (m.flexor) all[m.board_joint] = fill(m);
    const Trial t = tried({{0.4, all}}, End::at_once);
    Result out;
    if (!t.problem.empty()) out.wrong.push_back("the board ended the trial: " + t.problem);
    const Recording after = listen(*remote, configuration, 1.0);
    for (const BenchMuscle& m : muscles) {
      if (!m.tension || !out.wrong.empty()) continue;
      const double rest = progress.rest_readings[sensor(*m.tension)].at_rest;
      const double left = std::abs(after.after(*m.tension) - rest);
      double pulled = 0;
      for (const Sample& s : t.stages[0].samples)
        pulled = std::max(pulled, std::abs(s.counts[*m.tension] - rest));
      if (left > std::max(300.0, 0.5 * pulled))  // a tendon may stay tight without air
        out.wrong.push_back(
            fmt::format("{} still pulls ({:.0f} count) a second after the stop", m.name, left));
    }
    if (!answer("Press the emergency stop now. Did the dump valve let the air out?"))
      out.wrong.push_back(
          "the emergency stop does not let the air out: do not work at this machine "
          "until it does");
    return out;
  }

  // Runs stages, which the operator can stop while valves move.
  Trial tried(const std::vector<Stage>& stages, End end = End::by_plan) {
    struct Moves {
      explicit Moves(const Operator& p) : bench_operator(p) { tell(true); }
      ~Moves() { tell(false); }
      void tell(bool now) const {
        if (bench_operator.moves) bench_operator.moves(now);
      }
      const Operator& bench_operator;
    } const moves(bench_operator);
    Trial out = run_trial(*remote, configuration, lead, stages, end, bench_operator.stops);
    if (!out.found.empty()) bench_operator.inform("    " + out.found);
    return out;
  }

  // --- the operator ---

  bool answer(const std::string& question) {
    const std::optional<bool> reply = bench_operator.confirm(question);
    if (!reply) throw NoReply{};
    return *reply;
  }
  void ask_for(const std::string& question) {
    if (!answer(question)) throw NoReply{};
  }

  // Called once in each session: if the bring-up is continued on another day, an operator may stand
  // within reach of the machine again.
  void ask_for_air() {
    if (!air_is_open)
      ask_for(
          "Now open the supply's air, and stay clear of the machine. Is it open, and is "
          "everybody clear?");
    air_is_open = true;
  }

  // Discards the results of another machine, which do not apply to this one.
  void begin_again_if(bool other, const std::string& why) {
    if (!other || progress.done.empty()) return;
    const fs::path before = folder.path() / "bring-up-before.json";
    write_progress(progress, before);
    bench_operator.inform(fmt::format("All steps are to be done again: {}; their results are in {}",
                                      why, before.string()));
    progress.done.clear();
    progress.rest_readings.clear();
    progress.strokes.clear();
  }

  // --- the list of steps ---

  std::vector<Step> steps() {
    std::vector<Step> out{
        {"board", "who is at the line", [this] { return identify(); }},
        {"sensors", "what the sensors read at rest", [this] { return sensors(); }},
        {"clicks", "each valve clicks", [this] { return clicks(); }},
        {"rest", "with air, nothing moves by itself", [this] { return rest_with_air(); }, true}};
    for (std::size_t i = 0; i < muscles.size(); ++i)
      out.push_back({"muscle " + muscles[i].name, "fill, hold and empty " + muscles[i].name,
                     [this, i] { return muscle(i); }, true});
    for (const BenchJoint& joint : bench_joints(board, muscles))
      out.push_back({"stroke " + joint.name, joint.name + " from end to end",
                     [this, joint] { return stroke(joint); }, true});
    out.push_back({"stop", "stop in an emergency", [this] { return stop(); }, true});
    return out;
  }

  bool run_step(const Step& step, std::size_t number, std::size_t count) {
    if (progress.done.contains(step.name) && step.name != "board") {
      bench_operator.inform(fmt::format("{}/{} {}: done before", number, count, step.title));
      return true;
    }
    bench_operator.inform(fmt::format("{}/{} {}", number, count, step.title));
    if (step.with_air) ask_for_air();
    const Result r = step.work();
    for (const std::string& line : r.findings) bench_operator.inform("    " + line);
    for (const std::string& line : r.wrong) bench_operator.inform("    wrong: " + line);
    if (r.wrong.empty()) progress.done[step.name] = r.findings;
    write_progress(progress, folder.path() / "bring-up.json");
    return r.wrong.empty();
  }

  experiment::Experiment e;
  std::string robot;
  control::Board board;
  const Pins* pins = nullptr;  // those of the identified board
  link::Configuration configuration;
  std::vector<BenchMuscle> muscles;
  plant::RemoteBoard* remote;
  int lead;
  Operator bench_operator;
  OutputFolder folder;
  Progress progress;
  bool air_is_open = false;
};

BringUp::BringUp(const experiment::Experiment& bench, std::string robot, plant::RemoteBoard& board,
                 int lead, Operator bench_operator, const fs::path& folder)
    : impl_(std::make_unique<Impl>(bench, std::move(robot), board, lead, std::move(bench_operator),
                                   folder)) {}

BringUp::~BringUp() = default;

bool BringUp::go() {
  const std::vector<Step> steps = impl_->steps();
  try {
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (!impl_->run_step(steps[i], i + 1, steps.size())) {
        impl_->bench_operator.inform(
            "Mend that, then run the same command again: it continues from here.");
        return false;
      }
  } catch (const Stopped&) {
    impl_->bench_operator.inform(
        "Stopped: the muscles were vented. The same command continues from here.");
    return false;
  } catch (const NoReply&) {
    impl_->bench_operator.inform("Stopped. The same command continues from here.");
    return false;
  } catch (const plant::BoardStopped&) {
    impl_->bench_operator.inform("Stopped. The same command continues from here.");
    return false;
  }
  const fs::path out = impl_->folder.path() / "robot.toml";
  write_file(out, measured_robot(impl_->progress, impl_->robot, impl_->folder.path()));
  std::string left;
  for (const std::string& what : not_tried(impl_->e, impl_->board))
    left += (left.empty() ? "" : ", ") + what;
  impl_->bench_operator.inform(
      (left.empty() ? "All steps are done."
                    : "All steps that there are have been done; not tried: " + left + ".") +
      std::string(" What was learned is ") + out.string());
  return true;
}

namespace fs = std::filesystem;

namespace {

// Returns a table of the joints: their rest angles, at which the sensors' rest counts are taken, or
// a stiffness of 0 for each driven joint.
config::Node joints_of(const robot::Robot& robot, std::string_view key, bool angles) {
  config::Node out = config::make_table(key);
  for (const robot::Joint& j : robot.joints)
    if (angles)
      out.put(config::make_text(j.name, fmt::format("{} rad", j.rest_angle)));
    else if (j.kind == robot::Joint::Kind::driven)
      out.put(config::make_text(j.name, "0 N m/rad"));
  return out;
}

// Refuses a folder with another program's or the user's file that the bring-up would replace. Its
// own robot.toml never exists without its list of steps.
void refuse_other_files(const fs::path& folder) {
  constexpr FileKind bench{"experiment of `sinew bring-up`", "such a file",
                           "source=\"sinewbring-up\"", FileKind::At::anywhere, "another folder"};
  refuse_to_overwrite(folder / "bench.toml", true, bench);
  refuse_to_overwrite(folder / "wiring.svg", true, wiring_kind);
  if (fs::exists(folder / "robot.toml") && !fs::exists(folder / "bring-up.json"))
    refuse(folder / "robot.toml", "a file that is not of a bring-up", "a folder without one",
           "another folder");
}

}  // namespace

experiment::Experiment bench_of(const std::string& robot, const fs::path& folder,
                                const std::vector<std::string>& sets) {
  config::Node root = config::parse_text(
      "format = \"sinew.experiment/2\"\n"
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
  const fs::path there = fs::weakly_canonical(fs::absolute(folder));
  root.put(
      config::make_text("robot", fs::weakly_canonical(robot).lexically_relative(there).string()));
  make_folders(there);
  refuse_other_files(there);
  write_file(there / "bench.toml", config::to_toml(root));
  return experiment::load((there / "bench.toml").string(), sets);
}

}  // namespace sinew::run
