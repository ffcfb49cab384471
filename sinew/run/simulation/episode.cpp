#include "sinew/run/simulation/episode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sinew/units/math.h"

namespace sinew::run {

namespace {

using signals::Tick;

double seconds(Tick ticks) { return static_cast<double>(ticks) * signals::tick_seconds; }

// Returns a time in ticks. Throws std::invalid_argument if it is out of range.
Tick ticks(double time) {
  if (!std::isfinite(time) || time < 0 || time > 1e9)
    throw std::invalid_argument(
        fmt::format("seconds: found {}; expected a time from 0 to 1e9 s", time));
  return static_cast<Tick>(std::llround(time / signals::tick_seconds));
}

void check_above_zero(double value, std::string_view what, const std::string& whose) {
  if (!(value > 1e-300 && value < 1e300))
    throw std::invalid_argument(
        fmt::format("{}: {}: found {}; expected a finite number above 0", whose, what, value));
}

}  // namespace

Episode::Episode(const Task& task, Simulation& example) : Episode(task, std::as_const(example)) {
  record_plan(example);
  if (const std::string cause = example.cause(); !cause.empty()) throw std::runtime_error(cause);
}

Episode::Episode(const Task& task, const Simulation& example)
    : task_(task),
      begin_(ticks(task.begin)),
      step_(ticks(task.period)),
      control_(ticks(example.experiment().plan.high_level_period)) {
  check_times(example, task);
  for (const Task::Action& a : task.actions) {
    check_above_zero(a.factor, "factor", a.setting);
    actions_.push_back({example.find_setting(a.setting), a.offset, units::log(a.factor)});
  }
  for (const Task::Observation& s : task.observations) {
    check_above_zero(s.scale, "scale", s.channel);
    channels_.push_back(example.find(s.channel));
    scalings_.push_back({s.middle, s.scale});
  }
  for (const std::string& name : task.measures) measure(example, name);
  if (channels_.size() > most_channels)
    throw std::invalid_argument(
        fmt::format("channels: found {}; expected {} at most", channels_.size(), most_channels));
}

Episode Episode::of(const Simulation& other) const {
  const experiment::Experiment& e = other.experiment();
  Episode out(task_, other);
  if (actions_.empty()) return out;
  const bool follows_readings = std::ranges::any_of(e.plan.phases, [](const gait::Phase& phase) {
    return !phase.until.measure.empty() || phase.ground_force.given();
  });
  if (follows_readings) {
    Simulation alone(e);
    out.record_plan(alone);
  } else {
    out.plan_alone(e);
  }
  return out;
}

void Episode::check_times(const Simulation& s, const Task& task) const {
  const double control = seconds(control_);
  if (step_ < control_ || step_ % control_ != 0)
    throw std::invalid_argument(
        fmt::format("period: found {} s; expected a multiple of the gait controller's {} s",
                    task.period, control));
  if (begin_ % control_ != 0)
    throw std::invalid_argument(
        fmt::format("begin: found {} s; expected a multiple of the gait controller's {} s",
                    task.begin, control));
  if (begin_ >= s.last())
    throw std::invalid_argument(fmt::format("begin: found {} s; expected less than the plan's {} s",
                                            task.begin, seconds(s.last())));
}

void Episode::measure(const Simulation& s, const std::string& name) {
  constexpr std::string_view of_plan = "plan:";
  if (!name.starts_with(of_plan)) {
    measured_.push_back({false, channels_.size()});
    channels_.push_back(s.find(name));
    return;
  }
  const std::size_t setting = s.find_setting(std::string_view(name).substr(of_plan.size()));
  const auto action = std::ranges::find(actions_, setting, &Action::setting);
  if (action == actions_.end())
    throw std::invalid_argument(
        fmt::format("measures: found {}; expected the setting of one of the task's actions", name));
  measured_.push_back({true, static_cast<std::size_t>(action - actions_.begin())});
}

// Records the settings of each period of the plan, which are set when its first tick has passed.
void Episode::record_plan(Simulation& s) {
  for (Tick t = begin_; t < s.last(); t += control_) {
    s.advance_to(t + 1);
    for (const Action& action : actions_) plan_.push_back(s.value_of(action.setting));
  }
}

// Records the same of a plan that does not depend on readings, without a machine.
void Episode::plan_alone(const experiment::Experiment& e) {
  Controllers controllers(e, nullptr);
  const MachineState state = controllers.boards().state();
  const Tick period = controllers.scan().period, last = experiment::last_tick(e);
  Tick updated = -period;
  for (Tick t = begin_; t < last; t += control_) {
    while (updated + period <= t) (void)controllers.gait()->update(state, updated += period);
    for (const Action& action : actions_)
      plan_.push_back(gait::value_of(controllers.settings()[action.setting],
                                     controllers.gait()->desired().front()));
  }
}

void Episode::step(Simulation& s, std::span<const double> action) const {
  for (Tick passed = 0; passed < step_ && !s.ended(); passed += control_) {
    act(s, action);
    s.advance_to(s.tick() + control_);
  }
}

void Episode::act(Simulation& s, std::span<const double> action) const {
  const auto row = static_cast<std::size_t>((s.tick() - begin_) / control_);
  if (row >= rows()) return;
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    const double a = std::clamp(action[i], -1.0, 1.0);
    const double wanted = (plan_[row * actions_.size() + i] + actions_[i].offset * a) *
                          units::exp(actions_[i].logarithm * a);
    s.change(actions_[i].setting, std::clamp(wanted, 0.0, gait::Setting::most));
  }
}

void Episode::observe(Simulation& s, std::span<double> observed,
                      std::span<double> measured) const noexcept {
  double readings[most_channels];
  s.read(channels_, {readings, channels_.size()});
  for (std::size_t i = 0; i < scalings_.size(); ++i)
    observed[i] = (readings[i] - scalings_[i].middle) / scalings_[i].scale;
  const Tick periods = std::max<Tick>(0, (s.tick() - begin_) / control_ - 1);
  const std::size_t row = std::min(static_cast<std::size_t>(periods), rows() - 1);
  for (std::size_t i = 0; i < measured_.size(); ++i)
    measured[i] = measured_[i].of_plan ? plan_[row * actions_.size() + measured_[i].place]
                                       : readings[measured_[i].place];
}

}  // namespace sinew::run
