#include "sinew/air/driven_muscle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace sinew::air {
namespace {

using Kind = gas::Valve::Kind;

constexpr double longest = 1e-3;  // step, for what no valve and no rate asks to be shorter [s]

// Throws for a command that another kind of valve takes.
[[noreturn]] void refuse(const char* command, Kind kind) {
  std::string has = "on-off valves; expected inlet() or exhaust()";
  if (kind == Kind::three_way) has = "a 3-way valve, which has one coil; expected inlet()";
  if (kind == Kind::regulator) has = "a pressure regulator; expected set_point()";
  throw std::invalid_argument(std::string(command) + ": found a muscle with " + has);
}

}  // namespace

static_assert(std::is_trivially_copyable_v<DrivenMuscle::State>);

DrivenMuscle::DrivenMuscle(const Muscle& muscle, const gas::Air& air, const gas::Supply& supply,
                           double length, double pressure)
    : kind_(muscle.inlet.kind), air_(std::array{muscle}, air, supply) {
  if (!(air_.volume(0, length) > 0))
    throw std::invalid_argument("at a length of " + std::to_string(length) +
                                " m the muscle has no room for air: give it an external volume, or "
                                "another length");
  state_.length = length;
  const Air::Ends at = ends(0);
  state_.air = air_.initial(pressure, at.length, 0);
  state_.valves = air_.valves_at_rest();
  state_.memory = air_.memory_at_rest(pressure, at.length);
  look(0, state_.air, state_.look);
  node();
}

// The muscle's motion in the step at hand.
auto DrivenMuscle::ends(double t) const noexcept -> Air::Ends {
  Air::Ends at{};
  at.length.of.fill(state_.length + (t - state_.time) * state_.rate);
  at.rate.of.fill(state_.rate);
  return at;
}

void DrivenMuscle::look(double t, const Air::State& air, Air::Answer& out) const noexcept {
  air_.evaluate(t, ends(t), air, state_.valves, state_.memory, out);
}

void DrivenMuscle::command(int valve, bool on, std::uint16_t level) noexcept {
  air_.command({.valve = {static_cast<std::uint8_t>(valve)}, .open = on, .level = level},
               state_.time, state_.look, state_.valves);
  node();
}

void DrivenMuscle::inlet(bool on) {
  if (kind_ == Kind::regulator) refuse("inlet", kind_);
  command(0, on, 0);
}

void DrivenMuscle::exhaust(bool on) {
  if (kind_ != Kind::two_way) refuse("exhaust", kind_);
  command(1, on, 0);
}

void DrivenMuscle::set_point(double share) {
  if (kind_ != Kind::regulator) refuse("set_point", kind_);
  const double level = std::clamp(share, 0.0, 1.0) * signals::max_level;
  command(0, share > 0, static_cast<std::uint16_t>(level + 0.5));
}

// A node: valves move on, and the series take their references.
void DrivenMuscle::node() noexcept {
  air_.move_valves(state_.time, state_.look, state_.valves);
  look(state_.time, state_.air, state_.look);
  state_.failed =
      state_.failed || static_cast<bool>(air_.remember(state_.look, state_.air, state_.memory));
}

void DrivenMuscle::step(double h) noexcept {
  Air::Course course;
  air_.plan(state_.time, h, ends(state_.time), state_.air, state_.valves, state_.memory, course);
  Air::Answer later[3];
  const Air::Answer* looks[4] = {&state_.look, &later[0], &later[1], &later[2]};
  Air::State stage;
  for (int s = 0; s < 3; ++s) {
    const double part = s == 2 ? h : 0.5 * h;
    air_.move(stage, state_.air, part, *looks[s], state_.valves, course);
    look(state_.time + part, stage, later[s]);
  }
  air_.finish(state_.air, h, looks, state_.valves, course);
}

void DrivenMuscle::advance(double step_length, double length) noexcept {
  if (state_.failed || !(step_length > 0)) return;
  const double from = state_.length, start = state_.time, end = start + step_length;
  const double rate = (length - from) / step_length;
  state_.rate = rate;
  while (state_.time < end && !state_.failed) {
    double next =
        std::min({end, state_.time + longest, std::max(state_.valves.next_change, start)});
    const double stable = air_.longest_step_of_rest(ends(state_.time), state_.valves);
    next = std::min(next, state_.time + stable);
    if (next > state_.time) step(next - state_.time);
    state_.time = next;
    state_.length = next < end ? from + (next - start) * rate : length;
    node();
  }
}

}  // namespace sinew::air
