#include "sinew/mechanism/slide/slide_mechanism.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/stiffness.h"

namespace sinew::plant {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("test stand: " + what);
}

void refuse_schedule(const Schedule& s, const char* name, double least) {
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    if (!(s.points[i].value > least) || !std::isfinite(s.points[i].value))
      refuse(std::string(name) + (least == 0 ? " must be above 0" : " must be finite"));
    if (i > 0 && s.points[i].at < s.points[i - 1].at)
      refuse(std::string(name) + " goes back in time");
  }
}

double least(const Schedule& s) {
  double out = s.at(0);
  for (const Schedule::Point& p : s.points) out = std::fmin(out, p.value);
  return out;
}

// Refuses a load that is less than the tension just above the shortest length: below that length
// the tension is zero, and the load would cross it without end.
void refuse_endless_switching(const StandSetup& s) {
  const actuator::Actuator& a = s.muscle.actuator;
  if (a.short_end.law != actuator::ShortEnd::Law::zero || !(a.braid.turns > 0)) return;
  const double above = std::nextafter(actuator::shortest_length(a), infinite);
  const double holds = s.muscle.count * actuator::clamped_tension(a, above, 0, 0, s.air.atmosphere);
  const double load = least(s.load.mass) * s.load.gravity + least(s.load.force);
  if (holds > load)
    refuse("by short_end.law = \"zero\" the tension jumps from " + std::to_string(holds) +
           " N to 0 at the shortest length, and the load of " + std::to_string(load) +
           " N would switch there without end: give the law \"stop\" or \"empirical\", or more "
           "load");
}

void refuse_contradictions(const StandSetup& s) {
  const bool driven = s.load.mode == Load::Mode::driven;
  if (!(s.step > 0)) refuse("its step must be above 0");
  if (!(s.accuracy > 0)) refuse("its accuracy must be above 0");
  if (driven && s.load.length.empty()) refuse("a driven load has a length over time");
  if (!driven && s.load.mass.empty()) refuse("a hanging load has a mass");
  refuse_schedule(s.load.mass, "the mass", 0);
  refuse_schedule(s.load.length, "the length", 0);
  refuse_schedule(s.load.force, "the force", -infinite);
  refuse_schedule(s.charge.pressure, "the regulated pressure", 0);
  if (s.charge.mode == Charge::Mode::regulated && s.charge.pressure.empty())
    refuse("a regulated stand has a pressure over time");
  if (s.charge.mode == Charge::Mode::regulated && !s.faults.empty())
    refuse("nothing that breaks changes a prescribed pressure");
  if (!(s.start.pressure > 0)) refuse("the pressure at the start must be above 0");
  if (driven && (s.start.displacement != 0 || s.start.length != 0))
    refuse("a driven load starts at its prescribed length");
  if (s.cylinder && s.cylinder->mode != air::Cylinder::Mode::single_acting)
    refuse("its cylinder is single-acting");
  if (!s.cylinder && !(s.muscle.actuator.braid.turns > 0)) refuse("its muscle has no braid");
  if (!driven && !s.cylinder) refuse_endless_switching(s);
  for (const Transducer& t : s.transducers)
    if (!(t.high > t.low)) refuse("transducer " + t.name + " has no range");
}

// Removes valves that are shut or replaced by a regulator: a 3-way valve would let the air out.
StandSetup with_valves(StandSetup s) {
  refuse_contradictions(s);
  if (s.charge.mode == Charge::Mode::valves) return s;
  s.muscle.inlet = s.muscle.exhaust = gas::Valve{};
  if (s.cylinder) s.cylinder->inlet[air::up] = s.cylinder->exhaust[air::up] = gas::Valve{};
  return s;
}

// Lengths at which a muscle may hang or start.
struct Reach {
  double low, high;  // [m]
};
Reach reach(const StandSetup& s) {
  const actuator::Braid& braid = s.muscle.actuator.braid;
  return {0.5 * actuator::shortest_length(braid), 1.5 * braid.thread_length};
}

// With straight threads a muscle has no volume, and without hose and fittings no room for its air:
// its pressure would not be finite.
void refuse_without_air(const StandSetup& s, double length) {
  const double room =
      s.muscle.count * actuator::volume(s.muscle.actuator, length) + s.muscle.external_volume;
  if (s.cylinder || room > 0) return;
  refuse("at a length of " + std::to_string(length) +
         " m its muscle has no room for air: give an external_volume above 0, or stay shorter");
}

}  // namespace

double hanging_length(const StandSetup& setup) {
  if (setup.cylinder) refuse("an air cylinder at one pressure hangs nowhere: give start.length");
  StandSetup s = setup;
  s.muscle.actuator.loss.stick = true;  // otherwise a zero velocity has a friction force
  // At constant pressure the volume has no effect, but beyond the threads it must be positive.
  if (!(s.muscle.external_volume > 0)) s.muscle.external_volume = 1e-6;
  using Air = air::AirNetwork<4>;
  const Air network = air_of(s);
  const Air::Valves valves = network.valves_at_rest();
  const double weight = s.load.mass.at(0) * s.load.gravity + s.load.force.at(0);
  const auto surplus = [&](double length) {
    Air::Ends ends{};
    ends.length.of.fill(length);
    const Air::State air = network.initial(s.start.pressure, ends.length, 0);
    const Air::Memory memory = network.memory_at_rest(s.start.pressure, ends.length);
    Air::Evaluation pull;
    network.evaluate(0, ends, air, valves, memory, pull);
    return pull.clamped[0] - weight;
  };
  auto [low, high] = reach(s);
  if (!(surplus(low) < 0 && surplus(high) > 0))
    refuse("its load hangs nowhere between half the shortest length and 1.5 threads");
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (surplus(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

namespace {

// Returns the setup with the length at which the stand starts, and without valves if the air does
// not pass them. Throws std::invalid_argument for an invalid setup.
StandSetup prepared(const StandSetup& setup) {
  StandSetup s = with_valves(setup);
  const bool driven = s.load.mode == Load::Mode::driven;
  StandStart& start = s.start;
  if (s.charge.mode == Charge::Mode::regulated) start.pressure = s.charge.pressure.at(0);
  if (driven)
    start.length = s.load.length.at(0);
  else if (!(start.length > 0))
    start.length = hanging_length(s);
  if (s.cylinder) s.cylinder->initial_pressure[air::up] = start.pressure;

  const double first = start.length + start.displacement;
  refuse_without_air(s, start.length);
  refuse_without_air(s, first);
  const Reach r = reach(s);
  for (const Schedule::Point& p : s.load.length.points) {
    refuse_without_air(s, p.value);
    if (!s.cylinder && (p.value < r.low || p.value > r.high))
      refuse("a driven length of " + std::to_string(p.value) +
             " m is beyond half the shortest length and 1.5 threads of its muscle");
  }
  if (!s.cylinder && !driven && !(first >= r.low && first <= r.high))
    refuse("it starts beyond half the shortest length and 1.5 threads");
  return s;
}

}  // namespace

SlideMechanism::SlideMechanism(const Setup& setup)
    : setup_(prepared(setup)),
      driven_(setup.load.mode == robot::Stand::Load::Mode::driven),
      regulated_(setup.charge.mode == Charge::Mode::regulated),
      cylinder_(setup.cylinder.has_value()) {
  const actuator::Actuator& a = setup_.muscle.actuator;
  ends_ = {-infinite, infinite};
  if (!cylinder_) {
    const int count = setup_.muscle.count;
    has_dry_friction_ = a.loss.stick && a.loss.coulomb_length > 0;
    ends_ = {actuator::shortest_length(a), a.long_end.length};
    end_stiffness_ = count * std::fmax(a.long_end.stiffness, a.short_end.stiffness);
    end_damping_ = count * std::fmax(a.long_end.damping, a.short_end.damping);
  }
  short_of_shortest_ = std::nextafter(ends_[0], -infinite);
  beyond_longest_ = std::nextafter(ends_[1], infinite);
  exponent_ = setup_.air.wall_time > 0 ? gas::heat_capacity_ratio : setup_.air.polytropic_exponent;
  longest_swing_ = longest_swing(setup_.accuracy);
  cut_within_ = std::fmax(3e-5 * setup_.accuracy, 1e-15);
  start_.length = setup_.start.length + setup_.start.displacement;
  begin(0, start_);
}

auto SlideMechanism::prescribed(double t) const noexcept -> Prescribed {
  const Schedule* of[] = {&setup_.load.mass, &setup_.load.force, &setup_.load.length,
                          &setup_.charge.pressure};
  Prescribed p{of[0]->piece(t), of[1]->piece(t), of[2]->piece(t), of[3]->piece(t), t, infinite};
  for (const Schedule* s : of) p.end = std::min(p.end, s->corner(t));
  return p;
}

// Returns the natural frequency of the load on its spring, with sealed air; or the rate of an
// end that acts [1/s].
double SlideMechanism::swinging_rate(double length, double pressure, double mass) const noexcept {
  double stiffness = 0, damping = 0;
  if (cylinder_) {
    const air::Cylinder& c = *setup_.cylinder;
    const double area = air::area(c, air::up);
    stiffness = exponent_ * pressure * area * area / air::volume(c, air::up, c.stroke - length);
  } else {
    const air::Muscle& m = setup_.muscle;
    stiffness =
        m.count * actuator::stiffness_sealed(m.actuator, length, pressure, setup_.air.atmosphere,
                                             m.external_volume / m.count, exponent_);
    damping = m.count * m.actuator.loss.viscous;
  }
  if (side_of(length) != 1) {
    stiffness = std::fabs(stiffness) + end_stiffness_;
    damping = actuator::empirical_loss * damping + end_damping_;
  }
  return std::sqrt(std::fabs(stiffness) / mass) + damping / mass;
}

}  // namespace sinew::plant
