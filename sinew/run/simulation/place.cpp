#include "sinew/run/simulation/place.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "sinew/config/diagnostics.h"
#include "sinew/control/link/baud.h"
#include "sinew/control/supervise/output_stage.h"
#include "sinew/host/realtime.h"
#include "sinew/port/comedi/comedi_port.h"
#include "sinew/port/hardware/serial_line.h"
#include "sinew/robot/wiring/wiring.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/remote_boards.h"
#include "sinew/run/simulation/wired_body.h"

namespace sinew::run {

namespace {

constexpr std::string_view serial = "serial:", emulated = "emulated:", lock_step = "lock-step:",
                           comedi = "comedi:", simulated = "simulated";

// A device and its rate; 0: not given.
struct Device {
  std::string path;
  std::uint32_t baud = 0;
  bool good = true;
};

Device device_of(std::string_view text) {
  const std::size_t at = text.rfind('@');
  Device out{std::string(text.substr(0, at))};
  if (at == std::string_view::npos) return out;
  const std::string_view rate = text.substr(at + 1);
  const auto [end, error] = std::from_chars(rate.data(), rate.data() + rate.size(), out.baud);
  out.good = error == std::errc{} && end == rate.data() + rate.size() && out.baud > 0;
  return out;
}

std::string text_of(const link::Name& name) {
  return {name.data(),
          static_cast<std::size_t>(std::find(name.begin(), name.end(), '\0') - name.begin())};
}

using Pulse = experiment::Stand::Drive::Pulse;

[[noreturn]] void refuse(const experiment::Experiment& e, const std::string& place,
                         const std::string& key, const std::string& found,
                         const std::string& expected) {
  config::fail({e.path, 0, 0}, key, found, fmt::format("{}, to run it at {}", expected, place));
}

void refuse_faults(const experiment::Experiment& e, const std::string& place) {
  if (!e.faults.empty())
    refuse(e, place, "fault", fmt::format("{} of them", e.faults.size()),
           "none: only a simulated machine is broken by a word");
}

void refuse_regulators(const experiment::Experiment& e, const control::Board& board,
                       const std::string& place) {
  for (std::size_t j = 0; j < board.joint_controller.joints; ++j)
    if (board.joint_controller.joint[j].kind == control::JointKind::regulated)
      refuse(e, place, "joint." + e.robot.joints[board.joint[j]].name, "pressure regulators",
             "valves that open and shut: a digital output sets no pressure");
}

// Returns whether two pulses overlap. Compares ticks, since a pulse may begin when another ends.
bool overlap(const Pulse& a, const Pulse& b) {
  const auto ticks = [](double seconds) { return std::llround(seconds / signals::tick_seconds); };
  const auto begins_within = [&](const Pulse& one, const Pulse& other) {
    const signals::Tick since = ticks(one.at) - ticks(other.at);
    return since >= 0 && since < ticks(other.open);
  };
  return begins_within(a, b) || begins_within(b, a);
}

void refuse_what_no_board_of_a_stand_can(const experiment::Experiment& e,
                                         const std::string& place) {
  constexpr double longest = 0.5;  // a board is given up after 1.5 s without a report [s]
  const experiment::Stand& stand = *e.stand;
  if (stand.charge.mode == robot::Stand::Charge::Mode::regulated)
    refuse(e, place, "charge.mode", "\"regulated\"",
           "\"valves\" or \"sealed\": no output of a board sets a pressure");
  if (stand.sweep.step > 0)
    refuse(e, place, "sweep", "many runs", "none: one duty in each run, by drive.duty");
  if (stand.sensors.empty())
    refuse(e, place, "sensor", "none", "at least one: a board without sensors is refused");
  if (stand.drive.period > longest)
    refuse(e, place, "drive.period", fmt::format("{:g} s", stand.drive.period),
           fmt::format("at most {:g} s, as a board reports once in a period", longest));
  for (std::size_t i = 0; i < stand.drive.pulses.size(); ++i)
    for (const Pulse& other : stand.drive.pulses)
      if (const Pulse& pulse = stand.drive.pulses[i];
          pulse.exhaust && !other.exhaust && overlap(pulse, other))
        refuse(
            e, place, fmt::format("drive.pulses[{}]", i), "an inlet that is open meanwhile",
            "one open valve at a time, as a board keeps an inlet shut while its exhaust is open");
}

void refuse_what_no_board_can(const experiment::Experiment& e, const std::string& place) {
  if (e.stand) refuse_what_no_board_of_a_stand_can(e, place);
  const std::vector<control::Board> boards = boards_of(e);
  if (boards.size() != 1)
    refuse(e, place, "board", fmt::format("{} boards", boards.size()), "one: a line leads to one");
  const double period = signals::tick_seconds * boards.front().joint_controller.period;
  const double samples = e.log.period / period;
  if (samples < 0.999 || std::abs(samples - std::round(samples)) > 1e-9)
    refuse(e, place, "log.period", fmt::format("{:g} s", e.log.period),
           fmt::format("a multiple of {:g} s, the period in which a board reports", period));
  if (!place.starts_with(serial)) return;
  refuse_faults(e, place);
  refuse_regulators(e, boards.front(), place);
}

// Returns the machine's number of a valve that bits_of() names.
std::size_t number_of(const robot::Robot& robot, const robot::ValveBit& b) {
  const std::size_t which = b.which == "inlet" ? 0 : 1;
  const int muscle = robot::find_muscle(robot, b.of);
  if (muscle >= 0) return 2 * static_cast<std::size_t>(muscle) + which;
  return 2 * robot.muscles.size() + (b.of == "cylinder_up" ? 0 : 2) + which;
}

// Returns the rate of the line: the given one, since another port of the firmware may differ,
// or that of the firmware. Throws plant::BoardError if it does not carry the telemetry.
std::uint32_t rate_for(const Device& device, const link::Configuration& configuration) {
  const control::JointControllerConfig& joint_controller = configuration.joint_controller;
  const std::uint32_t rate = device.baud > 0 ? device.baud : link::firmware_baud;
  if (link::carries(rate, link::load_of(joint_controller, true), joint_controller.period))
    return rate;
  const std::uint32_t least = link::choose_baud(joint_controller, true, plant::serial_rates());
  const std::string at = device.path + "@" + std::to_string(least);
  throw plant::BoardError(fmt::format(
      "{}: {} bits/s do not carry this robot's telemetry; expected {}", device.path, rate,
      least == 0        ? std::string("fewer sensors or joints: no rate of a serial line does")
      : device.baud > 0 ? fmt::format("{} at least", least)
                        : fmt::format("{}, if your board's firmware has that rate", at)));
}

}  // namespace

std::string problem_of_place(const std::string& place) {
  const std::string expected =
      "expected simulated, serial:DEVICE, serial:DEVICE@RATE, emulated:FILE, lock-step:FILE or "
      "comedi:DEVICE";
  const std::string_view text = place;
  if (!is_outside_simulation(place)) return "";
  for (const std::string_view kind : {serial, emulated, lock_step, comedi})
    if (text.starts_with(kind) && text.size() > kind.size()) {
      if (kind != serial || device_of(text.substr(kind.size())).good) return "";
      return fmt::format("found \"{}\", whose rate is not a number; {}", place, expected);
    }
  return fmt::format("found \"{}\"; {}", place, expected);
}

bool is_outside_simulation(const std::string& place) {
  return !place.empty() && place != simulated;
}

bool has_own_clock(const std::string& place) {
  return is_outside_simulation(place) && !place.starts_with(lock_step);
}

plant::CardMachine card_machine(const experiment::Experiment& e, const std::string& place) {
  const control::Board board = only_board(e);
  refuse_regulators(e, board, place);
  const robot::Converter& converter = e.robot.converter;
  plant::CardMachine out{
      .full_scale = converter.full_scale,
      .top = converter.top(),
      .active_low = !e.wiring.present || e.wiring.polarity == robot::Wiring::Polarity::low_opens,
      .vent = static_cast<signals::Tick>(board.joint_controller.shutdown_vent)};
  for (const robot::Sensor& s : e.robot.sensors) out.inputs.push_back({s.name, s.channel});

  out.outputs.resize(2 * e.robot.muscles.size() + 4);
  for (const robot::ValveBit& b : robot::bits_of(e.robot, e.wiring)) {
    plant::CardMachine::Output& valve = out.outputs[number_of(e.robot, b)];
    valve.valve = b.of + " " + b.which;
    valve.bit = b.bit;
    valve.inlet = b.which == "inlet";
  }
  const control::OutputStage stage(board.joint_controller, 0);
  for (std::size_t i = 0; i < board.valve.size(); ++i) {
    plant::CardMachine::Output& valve = out.outputs[board.valve[i]];
    valve.inverted = (stage.inverted() >> i & 1u) != 0;
    valve.vents = (stage.exhausts() >> i & 1u) != 0;
  }
  return out;
}

struct Place::Card {
  Card(const std::string& device, const plant::CardMachine& machine)
      : port(device, machine, beat) {}
  host::TickTimer beat;
  plant::ComediPort port;
};

struct Place::Serial {
  Serial(const Device& device, const link::Configuration& configuration)
      : line(device.path, rate_for(device, configuration)),
        board(line.line(), 1, configuration.joint_controller.period) {}

  plant::SerialLine line;
  plant::RemoteBoard board;
};

template <class Emulated>
struct Place::AtMachine {
  AtMachine(const std::string& image, const experiment::Experiment& experiment)
      : body(experiment),
        emulator(image, body.wires()),
        board(emulator.line(), 1, only_board(experiment).joint_controller.period) {}

  WiredBody body;
  Emulated emulator;
  plant::RemoteBoard board;
};

Place::Place(const std::string& place, const experiment::Experiment& experiment)
    : keeps_time_(has_own_clock(place)), place_(place) {
  if (const std::string wrong = problem_of_place(place); !wrong.empty())
    throw std::invalid_argument(wrong);
  if (!is_outside_simulation(place)) return;
  if (place.starts_with(comedi)) {
    if (experiment.stand)
      refuse(experiment, place, "", "an experiment on a test stand",
             "one of a robot, whose wiring names the card's terminals");
    open_card(place.substr(comedi.size()), experiment, place);
    return;
  }
  refuse_what_no_board_can(experiment, place);
  configuration_ = keeps_time_ ? bench_configuration_of(experiment) : configuration_of(experiment);
  if (place.starts_with(serial)) {
    serial_ = std::make_unique<Serial>(device_of(place.substr(serial.size())), configuration_);
    board_ = &serial_->board;
    if (const robot::Wiring& w = experiment.wiring; w.present)
      board_->expect_levels(w.polarity == robot::Wiring::Polarity::low_opens);
  } else if (place.starts_with(emulated)) {
    emulated_ = std::make_unique<AtMachine<plant::EmulatedBoard>>(place.substr(emulated.size()),
                                                                  experiment);
    board_ = &emulated_->board;
  } else {
    lock_step_ = std::make_unique<AtMachine<plant::LockStepBoard>>(place.substr(lock_step.size()),
                                                                   experiment);
    board_ = &lock_step_->board;
    lead_ = 0;
  }
}

void Place::prepare(bool clear_fault, const std::atomic<bool>* stop) {
  if (board_ == nullptr) return;
  if (stop != nullptr) board_->stop_when([stop] { return stop->load(); });
  if (clear_fault) board_->allow_clearing();
  const link::Identity who = board_->prepare(configuration_);
  if (const std::string found = plant::fault_found(who); !found.empty()) messages_.push_back(found);
  who_ = fmt::format("{}, firmware {}, at {}", text_of(who.board), text_of(who.firmware), place_);
}

void Place::open_card(const std::string& device, const experiment::Experiment& e,
                      const std::string& place) {
  refuse_faults(e, place);
  card_ = std::make_unique<Card>(device, card_machine(e, place));
  who_ = fmt::format("{}, at {}", card_->port.board(), place);
  const host::RealTime real_time;
  const host::Latency latency = host::measure_latency(1);
  messages_ = host::problems(real_time);
  messages_.insert(messages_.begin(), "timer " + host::describe_latency(latency));
  if (host::class_of(latency) == host::LatencyClass::unfit)
    messages_.emplace_back(
        "this computer wakes too late for a tick of 100 us: expect missed ticks; see sinew doctor");
}

Place::~Place() = default;

void Place::apply(RunOptions& options) const {
  if (card_) options.body = {&card_->port, &card_->beat};
  options.board = board_;
  options.lead = lead_;
  options.board_keeps_time = board_keeps_time();
}

}  // namespace sinew::run
