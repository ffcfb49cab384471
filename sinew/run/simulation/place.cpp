#include "sinew/run/simulation/place.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "sinew/config/diagnostics.h"
#include "sinew/control/link/baud.h"
#include "sinew/plant/hardware/serial_line.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/remote_boards.h"
#include "sinew/run/simulation/wired_body.h"

namespace sinew::run {

namespace {

constexpr std::string_view serial = "serial:", emulated = "emulated:", lock_step = "lock-step:",
                           simulated = "simulated";

// A device and its rate, 0 where none is given.
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

[[noreturn]] void refuse(const experiment::Experiment& e, const std::string& place,
                         const std::string& key, const std::string& found,
                         const std::string& expected) {
  config::fail({e.path, 0, 0}, key, found, fmt::format("{}, to run it at {}", expected, place));
}

void refuse_what_no_board_can(const experiment::Experiment& e, const std::string& place) {
  const std::vector<control::Board> boards = control::boards(installation(e));
  if (boards.size() != 1)
    refuse(e, place, "board", fmt::format("{} boards", boards.size()), "one: a line leads to one");
  const double period = signals::tick_seconds * boards.front().spine.period;
  const double samples = e.log.period / period;
  if (samples < 0.999 || std::abs(samples - std::round(samples)) > 1e-9)
    refuse(e, place, "log.period", fmt::format("{:g} s", e.log.period),
           fmt::format("a multiple of {:g} s, the period in which a board tells what it knows",
                       period));
  if (!e.faults.empty() && place.starts_with(serial))
    refuse(e, place, "fault", fmt::format("{} of them", e.faults.size()),
           "none: only a simulated machine is broken by a word");
}

std::uint32_t rate_for(const Device& device, const link::Configuration& configuration) {
  if (device.baud > 0) {
    if (link::carries(device.baud, link::load_of(configuration.spine, true),
                      configuration.spine.period))
      return device.baud;
    throw plant::BoardError(fmt::format(
        "{}: {} bits/s do not carry this robot's telemetry; expected {} at least", device.path,
        device.baud, link::choose_baud(configuration.spine, true, plant::serial_rates())));
  }
  const std::uint32_t chosen = link::choose_baud(configuration.spine, true, plant::serial_rates());
  if (chosen == 0)
    throw plant::BoardError(device.path +
                            ": no rate of a serial line carries this robot's telemetry");
  return chosen;
}

}  // namespace

std::string problem_of_place(const std::string& place) {
  const std::string expected =
      "expected simulated, serial:DEVICE, serial:DEVICE@RATE, emulated:FILE or lock-step:FILE";
  const std::string_view text = place;
  if (!is_elsewhere(place)) return "";
  for (const std::string_view kind : {serial, emulated, lock_step})
    if (text.starts_with(kind) && text.size() > kind.size()) {
      if (kind != serial || device_of(text.substr(kind.size())).good) return "";
      return fmt::format("found \"{}\", of which the rate is no number; {}", place, expected);
    }
  return fmt::format("found \"{}\"; {}", place, expected);
}

bool is_elsewhere(const std::string& place) { return !place.empty() && place != simulated; }

struct Place::Serial {
  Serial(const Device& device, const link::Configuration& configuration)
      : line(device.path, rate_for(device, configuration)),
        board(line.line(), 1, configuration.spine.period) {}

  plant::SerialLine line;
  plant::RemoteBoard board;
};

template <class Emulated>
struct Place::AtMachine {
  AtMachine(const std::string& image, const experiment::Experiment& experiment)
      : body(experiment),
        emulator(image, body.wires()),
        board(emulator.line(), 1, only_board(experiment).spine.period) {}

  WiredBody body;
  Emulated emulator;
  plant::RemoteBoard board;
};

Place::Place(const std::string& place, const experiment::Experiment& experiment) : place_(place) {
  if (const std::string wrong = problem_of_place(place); !wrong.empty())
    throw std::invalid_argument(wrong);
  if (!is_elsewhere(place)) return;
  refuse_what_no_board_can(experiment, place);
  configuration_ = configuration_of(experiment);
  if (place.starts_with(serial)) {
    serial_ = std::make_unique<Serial>(device_of(place.substr(serial.size())), configuration_);
    board_ = &serial_->board;
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

void Place::prepare() {
  if (board_ == nullptr) return;
  const link::Identity who = board_->prepare(configuration_);
  who_ = fmt::format("{}, firmware {}, at {}", text_of(who.board), text_of(who.firmware), place_);
}

Place::~Place() = default;

void Place::apply(RunOptions& options) const {
  options.board = board_;
  options.lead = lead_;
  options.board_keeps_time = board_keeps_time();
}

}  // namespace sinew::run
