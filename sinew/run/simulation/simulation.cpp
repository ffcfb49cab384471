#include "sinew/run/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "sinew/config/diagnostics.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/setup/saved_state.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/run.h"
#include "sinew/units/hash.h"

namespace sinew::run {

using signals::Tick;

namespace {

static_assert(std::is_trivially_copyable_v<FaultyPort::State>);
static_assert(std::is_trivially_copyable_v<LoopState>);

// A watch that records nothing.
struct NullWatch {
  void command(Tick) noexcept {}
  void edge(const signals::Edge&) noexcept {}
  void sample(Tick) noexcept {}
  Tick next(Tick) const noexcept { return std::numeric_limits<Tick>::max(); }
};

constexpr SavedKind saved_kind{"sinew.save/1", "Simulation::save", "experiment"};

template <class Part>
void put(std::span<std::byte>& out, const Part& part) {
  std::memcpy(out.data(), &part, sizeof part);
  out = out.subspan(sizeof part);
}

template <class Part>
void take(std::span<const std::byte>& from, Part& part) {
  std::memcpy(&part, from.data(), sizeof part);
  from = from.subspan(sizeof part);
}

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

}  // namespace

template <class Machine>
Simulation::Simulation(const experiment::Experiment& experiment, const Machine& machine,
                       Steering* steering)
    : experiment_(experiment),
      machine_(std::in_place, machine),
      port_(&machine_->port()),
      controllers_(experiment_, steering),
      last_(experiment::last_tick(experiment_)) {
  if (!experiment_.faults.empty()) port_ = &faulty_.emplace(experiment_, *port_);
  list_channels();
}

Simulation::Simulation(const experiment::Experiment& experiment, Steering* steering)
    : Simulation(experiment, machine_setup(experiment), steering) {}

Simulation::Simulation(const experiment::Experiment& experiment, const plant::LegLane& lane)
    : Simulation(experiment, lane, nullptr) {}

Simulation::Simulation(const experiment::Experiment& experiment, signals::Port& body,
                       Steering* steering)
    : experiment_(experiment),
      port_(&body),
      controllers_(experiment_, steering),
      last_(experiment::last_tick(experiment_)) {
  list_channels();
}

Simulation::Simulation(const experiment::Experiment& experiment, plant::RemoteBoard& board,
                       int lead, Steering* steering)
    : experiment_(experiment),
      controllers_(experiment_, steering),
      last_(experiment::last_tick(experiment_)) {
  port_ = &remote_.emplace(controllers_.boards(), board, lead);
  list_channels();
}

bool Simulation::ended() const noexcept {
  return tick_ >= last_ || loop_.status != signals::Status::ok ||
         controllers_.boards().phase() == control::Phase::off;
}

void Simulation::advance_to(Tick tick) noexcept {
  SimulatedClock clock;
  NullWatch watch;
  advance(tick, clock, watch);
}

void Simulation::advance_by(double seconds) noexcept {
  advance_to(tick_ + std::llround(seconds / signals::tick_seconds));
}

// --- reading ---

void Simulation::list_channels() {
  columns_ = run::columns(experiment_);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (!machine_ && columns_[c].is_simulated_only()) continue;
    const signals::Topic& topic = columns_[c].topic;
    for (std::size_t f = 0; f < topic.fields.size(); ++f) {
      const std::string behind = topic.fields.size() > 1 ? "." + topic.fields[f].name : "";
      channels_.push_back({topic.name + behind, topic.fields[f].unit, columns_[c].given});
      column_of_.push_back({c, f});
    }
  }
}

std::size_t Simulation::find(std::string_view channel) const {
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].name == channel) return i;
  refuse("channel: found \"" + std::string(channel) + "\"; expected one of channels(), such as \"" +
         channels_.front().name + "\"");
}

double Simulation::read(std::string_view channel) { return read(find(channel)); }

double Simulation::read(std::size_t channel) noexcept {
  double value = 0;
  read(std::span(&channel, 1), std::span(&value, 1));
  return value;
}

bool Simulation::is_true(std::span<const std::size_t> channels) const noexcept {
  return std::ranges::any_of(
      channels, [&](std::size_t c) { return columns_[column_of_[c].first].is_simulated_only(); });
}

void Simulation::read(std::span<const std::size_t> channels, std::span<double> values) noexcept {
  controllers_.with_snapshot(time(), is_true(channels) ? &truths() : nullptr,
                             [&](const Snapshot& now) {
                               for (std::size_t i = 0; i < channels.size(); ++i) {
                                 const auto [column, field] = column_of_[channels[i]];
                                 double numbers[2] = {};
                                 columns_[column].value(now, numbers);
                                 values[i] = numbers[field];
                               }
                             });
}

const plant::Truths& Simulation::truths() noexcept {
  if (machine_) machine_->truth(time(), truths_);
  return truths_;
}

air::Failure Simulation::failure() const noexcept {
  return machine_ ? machine_->failure() : air::Failure{};
}

std::string Simulation::cause() const {
  Outcome so_far;
  so_far.status = loop_.status;
  so_far.failure = failure();
  so_far.controller = controllers_.boards().controller_totals();
  so_far.supervised = controllers_.boards().supervised_totals();
  so_far.duration = time();
  return so_far.ended_early() ? cause_of(experiment_, so_far) : "";
}

// --- changing ---

std::size_t Simulation::find_setting(std::string_view key) const {
  const int found = gait::find_setting(settings(), key);
  if (found >= 0) return static_cast<std::size_t>(found);
  if (settings().empty())
    refuse("setting: found \"" + std::string(key) +
           "\"; expected none: a test stand has nothing that is changed on the way");
  std::string all;
  for (const gait::Setting& s : settings()) all += (all.empty() ? "" : ", ") + s.key;
  refuse("setting: found \"" + std::string(key) + "\"; expected one of " + all);
}

int Simulation::leg_number(std::string_view leg) const {
  if (leg.empty()) return -1;
  const std::vector<robot::LegParts> legs = robot::legs_of(experiment_.robot);
  const auto found = std::ranges::find(legs, leg, &robot::LegParts::name);
  if (found != legs.end()) return static_cast<int>(found - legs.begin());
  refuse("leg: found \"" + std::string(leg) + "\"; expected " +
         (experiment_.robot.legs.empty() ? "none, as the robot has one leg alone"
                                         : config::either(config::names_of(legs))));
}

void Simulation::request_change(std::size_t setting, double value, int leg) {
  if (!(value >= 0 && value <= gait::Setting::most))
    refuse(settings()[setting].key + ": found " + std::to_string(value) + "; expected 0 to 1e6 " +
           std::string(settings()[setting].unit));
  (void)controllers_.gait()->request_change({setting, value, false, leg});
}

void Simulation::change(std::string_view key, double value, std::string_view leg) {
  request_change(find_setting(key), value, leg_number(leg));
}

void Simulation::change(std::size_t setting, double value) { request_change(setting, value, -1); }

void Simulation::release(std::string_view key, std::string_view leg) {
  const std::size_t setting = find_setting(key);
  (void)controllers_.gait()->request_change({setting, 0, true, leg_number(leg)});
}

// --- saving ---

// Hashes the values alone, since comments and sources of a file do not affect the machine.
std::uint64_t Simulation::model() {
  if (model_) return *model_;
  const std::string values = config::to_toml(
      experiment::values_in_si({"experiment", experiment::without_files(experiment_)}));
  const std::size_t sizes[] = {save_size()};
  model_ =
      units::hash(std::as_bytes(std::span(sizes)), units::hash(values, units::hash(SINEW_VERSION)));
  return *model_;
}

std::size_t Simulation::save_size() const noexcept {
  return saved_header_size + (machine_ ? machine_->state_size() : 0) + controllers_.state_size() +
         sizeof(FaultyPort::State) + sizeof loop_ + sizeof tick_;
}

std::vector<std::byte> Simulation::save() {
  if (!machine_) refuse("save: a body that is not simulated has no state to be saved");
  std::vector<std::byte> state(save_size() - saved_header_size);
  std::span<std::byte> rest(state);
  machine_->save(rest.first(machine_->state_size()));
  rest = rest.subspan(machine_->state_size());
  controllers_.save(rest.first(controllers_.state_size()));
  rest = rest.subspan(controllers_.state_size());
  put(rest, faulty_ ? faulty_->state() : FaultyPort::State{});
  put(rest, loop_);
  put(rest, tick_);
  return sealed(saved_kind, model(), state);
}

void Simulation::restore(std::span<const std::byte> saved) {
  if (!machine_) refuse("restore: a body that is not simulated takes no state");
  std::span<const std::byte> rest =
      unsealed(saved_kind, model(), save_size() - saved_header_size, saved);
  machine_->restore(rest.first(machine_->state_size()));
  rest = rest.subspan(machine_->state_size());
  controllers_.restore(rest.first(controllers_.state_size()));
  rest = rest.subspan(controllers_.state_size());
  FaultyPort::State faulty;
  take(rest, faulty);
  if (faulty_) faulty_->restore(faulty);
  take(rest, loop_);
  take(rest, tick_);
  // A new machine has to be given the scan.
  if (loop_.started) (void)port_->start(controllers_.scan());
}

}  // namespace sinew::run
