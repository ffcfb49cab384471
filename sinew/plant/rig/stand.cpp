#include "sinew/plant/rig/stand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/actuator/stiffness.h"
#include "sinew/robot/sensing.h"

namespace sinew::plant {

using signals::Status;

namespace {

// Rates times the length of a piece. RK4's error per radian of a swing is the fourth power/120.
constexpr double longest_swing = 0.08, longest_settling = 0.3;
constexpr double shortest_piece = 1e-7;  // [s]
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

double Stand::travel(double length) const noexcept {
  return setup_.cylinder ? setup_.cylinder->stroke - length : 0.0;
}

double Stand::air_in(const Air::State& s) const noexcept {
  return setup_.cylinder ? air_.cylinder_mass(s, muscle::up) : s.mass[0];
}

auto Stand::order(double t) const noexcept -> Order {
  const Schedule* of[] = {&setup_.load.mass, &setup_.load.force, &setup_.load.length,
                          &setup_.charge.pressure};
  Order o{of[0]->piece(t), of[1]->piece(t), of[2]->piece(t), of[3]->piece(t), of[0]->corner(t)};
  for (const Schedule* s : of) o.corner = std::min(o.corner, s->corner(t));
  o.shortest = -infinite;
  o.longest = infinite;
  return o;
}

// The same for a piece that begins at a length.
auto Stand::order_from(double t, double length) const noexcept -> Order {
  Order o = order(t);
  const int side = region(length);
  if (side == 0) o.longest = std::nextafter(ends_[0], -infinite);
  if (side == 1) o.shortest = ends_[0], o.longest = ends_[1];
  if (side == 2) o.shortest = std::nextafter(ends_[1], infinite);
  return o;
}

// Element and air at a length.
void Stand::evaluate(double t, double length, double rate, const Air::State& air,
                     const Air::Memory& memory, Look& out) const noexcept {
  Air::Ends ends{.travel = travel(length), .travel_rate = -rate};
  ends.length.of.fill(length);
  ends.rate.of.fill(rate);
  air_.evaluate(t, ends, air, state_.valves, memory, out.pull);
  const Air::Answer& p = out.pull;
  if (setup_.cylinder) {
    out.force = p.cylinder_force;
    out.bound = 0;
    out.in = p.cylinder_inflow[muscle::up];
    out.out = p.cylinder_outflow[muscle::up];
    out.leak = 0;
  } else {
    out.force = p.clamped[0];
    out.bound = p.mesh[0];
    out.in = p.inflow[0];
    out.out = p.outflow[0];
    out.leak = air_.leak(p, 0, state_.valves);
  }
}

// Everything that one look at a state yields.
void Stand::look(double t, const Order& o, const Moving& s, Look& out) const noexcept {
  const double length = driven_ ? o.length.at(t) : std::clamp(s.length, o.shortest, o.longest);
  const double rate = driven_ ? o.length.slope : s.velocity;
  if (regulated_) {
    Air::Lanes lengths;
    lengths.of.fill(length);
    Air::State held = s.air;
    air_.hold(o.pressure.at(t), lengths, travel(length), held);
    evaluate(t, length, rate, held, s.memory, out);
    out.in = out.out = out.leak = 0;
    air_.hold_still(out.pull);
  } else {
    evaluate(t, length, rate, s.air, s.memory, out);
  }
  const double mass = o.mass.at(t);
  out.asks = mass * setup_.load.gravity + o.force.at(t) - out.force;
  const bool held = driven_ || (rubs_ && s.rub == Rub::rests);
  const double dry = static_cast<double>(s.rub) * out.bound;
  out.velocity = rate;
  out.acceleration = held ? 0.0 : (out.asks - dry) / mass;
}

auto Stand::shifted(const Moving& from, double h, const Look& by) const noexcept -> Moving {
  Moving s = from;
  s.length += h * by.velocity;
  s.velocity += h * by.acceleration;
  air_.move(s.air, from.air, h, by.pull, state_.valves);
  s.in += h * by.in;
  s.out += h * by.out;
  s.leak += h * by.leak;
  return s;
}

auto Stand::rk4(double t, double h, const Order& o, const Moving& s,
                const Look& first) const noexcept -> Moving {
  Look second, third, fourth;
  look(t + 0.5 * h, o, shifted(s, 0.5 * h, first), second);
  look(t + 0.5 * h, o, shifted(s, 0.5 * h, second), third);
  look(t + h, o, shifted(s, h, third), fourth);
  Moving sum = shifted(s, h / 6.0, first);
  sum = shifted(sum, h / 3.0, second);
  sum = shifted(sum, h / 3.0, third);
  return shifted(sum, h / 6.0, fourth);
}

// 0 short of L_min, 1 between the ends, 2 beyond L_max.
int Stand::region(double length) const noexcept {
  return length < ends_[0] ? 0 : length > ends_[1] ? 2 : 1;
}

// Is there something between the two states that no smooth piece can hold?
bool Stand::breaks(double t, const Order& o, const Moving& before,
                   const Moving& after) const noexcept {
  if (driven_) return false;
  if (region(after.length) != region(before.length)) return true;
  if (!rubs_) return false;
  if (before.rub != Rub::rests) return after.velocity * static_cast<double>(before.rub) < 0;
  Look l;
  look(t, o, after, l);
  return std::fabs(l.asks) > l.bound;
}

// What turned back stops; what stands holds, or sets off.
void Stand::settle(double t, const Order& o, Moving& s) const noexcept {
  if (driven_ || !rubs_) return;
  const bool turned = s.velocity * static_cast<double>(s.rub) < 0;
  if (s.rub != Rub::rests && !turned) return;
  s.velocity = 0;
  s.rub = Rub::rests;
  Look l;
  look(t, o, s, l);
  if (std::fabs(l.asks) > l.bound) s.rub = l.asks > 0 ? Rub::down : Rub::up;
}

// What is prescribed at t goes into the state.
void Stand::place(double t, const Order& o, Moving& s) const noexcept {
  if (driven_) {
    s.length = o.length.at(t);
    s.velocity = o.length.slope;
    if (s.velocity != 0) s.rub = s.velocity > 0 ? Rub::down : Rub::up;
  }
  if (!regulated_) return;
  Air::Lanes lengths;
  lengths.of.fill(s.length);
  const double before = air_in(s.air);
  air_.hold(o.pressure.at(t), lengths, travel(s.length), s.air);
  const double gained = air_in(s.air) - before;
  (gained > 0 ? s.in : s.out) += std::fabs(gained);
}

// Of a chamber that settles at the pressure behind an open valve: the flow's slope is steep there
// [1/s].
double Stand::settling_rate(double exponent, const Moving& s, const Look& at) const noexcept {
  const Air::Answer& p = at.pull;
  const bool cylinder = setup_.cylinder.has_value();
  const double behind =
      cylinder ? p.cylinder_pressure[muscle::up] : air_.manifold(p, 0, state_.valves);
  const double in = std::fabs(at.in / (p.supply_pressure - behind));
  const double out = std::fabs(at.out / (behind - setup_.air.atmosphere));
  const double slope = (std::isfinite(in) ? in : 0.0) + (std::isfinite(out) ? out : 0.0);
  return exponent * behind * slope / air_in(s.air);
}

// Of the load on its spring, air shut in; of the ends where they act  [1/s].
double Stand::swinging_rate(double exponent, double mass, const Moving& s,
                            const Look& at) const noexcept {
  double stiffness = 0, damping = 0;
  if (setup_.cylinder) {
    const muscle::Cylinder& c = *setup_.cylinder;
    const double area = muscle::area(c, muscle::up);
    stiffness = exponent * at.pull.cylinder_pressure[muscle::up] * area * area /
                muscle::volume(c, muscle::up, travel(s.length));
  } else {
    const muscle::Muscle& m = setup_.muscle;
    stiffness = m.count * actuator::stiffness_sealed(m.actuator, s.length, at.pull.pressure[0],
                                                     setup_.air.atmosphere,
                                                     m.external_volume / m.count, exponent);
    damping = m.count * m.actuator.loss.viscous;
  }
  if (region(s.length) != 1) {
    stiffness = std::fabs(stiffness) + end_stiffness_;
    damping = actuator::empirical_loss * damping + end_damping_;
  }
  return std::sqrt(std::fabs(stiffness) / mass) + damping / mass;
}

// That a piece may have  [s].
double Stand::longest_piece(const Order& o, const Moving& s, const Look& at) const noexcept {
  const double n =
      setup_.air.wall_time > 0 ? gas::heat_capacity_ratio : setup_.air.polytropic_exponent;
  double longest = setup_.step;
  if (air_.flowing(state_.valves)) {
    Air::Ends ends{.travel = travel(s.length)};
    ends.length.of.fill(s.length);
    longest = std::min({longest, air_.longest_step(ends, state_.valves),
                        longest_settling / settling_rate(n, s, at)});
  }
  if (!driven_) longest = std::min(longest, longest_swing / swinging_rate(n, o.mass.value, s, at));
  return std::max(longest, shortest_piece);
}

// One smooth piece from t on, at most to `end`; answers where it ends.
double Stand::piece(double t, double end, Moving& s) const noexcept {
  Order o = order(t);
  place(t, o, s);
  o = order_from(t, s.length);
  if (s.rub == Rub::rests) settle(t, o, s);
  Look first;
  look(t, o, s, first);
  air_.remember(first.pull, s.air, s.memory);

  const double target = std::min(end, o.corner), whole = target - t;
  const double pieces = std::ceil(whole / longest_piece(o, s, first) - 1e-9);
  double h = pieces > 1 ? whole / pieces : whole;
  double reached = pieces > 1 ? t + h : target;
  Moving after = rk4(t, h, o, s, first);
  if (breaks(reached, o, s, after)) {
    // The end of the piece is put where it breaks, on the far side of it.
    double before = 0;
    for (int i = 0; i < 44; ++i) {
      const double middle = 0.5 * (before + h);
      const Moving there = rk4(t, middle, o, s, first);
      if (breaks(t + middle, o, s, there)) {
        h = middle;
        after = there;
      } else {
        before = middle;
      }
    }
    reached = t + h;
    settle(reached, o, after);
  }
  s = after;
  return reached;
}

// From one instant to another, in a copy.
auto Stand::moved(Moving s, double from, double to) const noexcept -> Moving {
  for (double t = from; t < to;) t = piece(t, to, s);
  place(to, order(to), s);
  return s;
}

void Stand::prepare() noexcept {
  air_.move_valves(state_.time, state_.first.pull, state_.valves);
  const Order o = order(state_.time);
  place(state_.time, o, state_.now);
  settle(state_.time, o, state_.now);
  look(state_.time, o, state_.now, state_.first);
  look_for_failure();
}

// Is anything of the look at a node no number?
void Stand::look_for_failure() noexcept {
  if (state_.failure) return;
  using Of = muscle::Failure::Of;
  const bool cylinder = setup_.cylinder.has_value();
  const double p =
      cylinder ? state_.first.pull.cylinder_pressure[muscle::up] : state_.first.pull.pressure[0];
  if (!muscle::is_pressure(p))
    state_.failure = {
        .of = cylinder ? Of::cylinder : Of::air, .length = state_.now.length, .time = state_.time};
  else if (!muscle::is_place(state_.now.length))
    state_.failure = {.of = Of::motion, .length = state_.now.length, .time = state_.time};
}

// The next multiple of the step, or the next change of a valve.
double Stand::next_node() const noexcept {
  const double multiple = static_cast<double>(state_.multiple + 1) * setup_.step;
  return std::min(multiple, state_.valves.next_change);
}

void Stand::advance(double t) noexcept {
  while (!state_.failure && next_node() <= t) commit();
}

void Stand::commit() noexcept {
  const double next = next_node();
  if (next > state_.time) state_.now = moved(state_.now, state_.time, next);
  state_.time = std::max(next, state_.time);
  if (next >= static_cast<double>(state_.multiple + 1) * setup_.step) ++state_.multiple;
  ++state_.nodes;
  prepare();
}

double Stand::air_mass() const noexcept {
  return air_.total_mass(state_.now.air, travel(state_.now.length));
}

StandTruth Stand::truth(double t) noexcept { return seen(std::max(t, state_.time)); }

StandTruth Stand::seen(double t) noexcept {
  advance(t);
  const Moving s = state_.failure ? state_.now : moved(state_.now, state_.time, t);
  const Order o = order(t);
  Look l;
  look(t, o, s, l);
  const bool rests = rubs_ && !driven_ && s.rub == Rub::rests;
  const double dry =
      rests ? std::clamp(l.asks, -l.bound, l.bound) : static_cast<double>(s.rub) * l.bound;
  const bool cylinder = setup_.cylinder.has_value();
  return {.length = s.length,
          .velocity = s.velocity,
          .acceleration = l.acceleration,
          .force = l.force + dry,
          .friction = dry,
          .sticks = rests,
          .load = driven_ ? 0.0 : o.mass.at(t),
          .pressure = cylinder ? l.pull.cylinder_pressure[muscle::up] : l.pull.pressure[0],
          .air = air_in(s.air),
          .air_in = s.in,
          .air_out = s.out,
          .air_leaked = s.leak,
          .inlet = air_.open_share(0, t, state_.valves),
          .exhaust = air_.open_share(1, t, state_.valves),
          .supply_pressure = l.pull.supply_pressure,
          .tank_pressure = l.pull.tank_pressure};
}

Status Stand::start(const signals::Scan& scan) noexcept {
  for (const signals::Conversion& c : scan.conversions) {
    if (c.channel.index >= setup_.transducers.size()) return Status::invalid;
    lag_[c.channel.index] = c.read - c.start;
  }
  return Status::ok;
}

Status Stand::drive(signals::Edge edge) noexcept {
  if (state_.ended) return Status::ended;
  if (state_.failure) return Status::fault;
  if (setup_.charge.mode != Charge::Mode::valves || edge.valve.index > 1) return Status::invalid;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (t < state_.time) return Status::invalid;  // that node is final
  while (!state_.failure && next_node() < t)
    commit();  // later edges act at t or after: these nodes are final
  air_.command(edge, t, state_.first.pull, state_.valves);
  return Status::ok;
}

// What the transducer stands before at t.
double Stand::quantity(const Transducer& t, double at) noexcept {
  using Of = Transducer::Of;
  const StandTruth now = seen(at);
  switch (t.of) {
    case Of::length:
      return now.length;
    case Of::force:
      return now.force;
    case Of::pressure:
      return now.pressure - setup_.air.atmosphere;
    case Of::acceleration:
      return now.acceleration;
  }
  return 0;
}

signals::Reading Stand::read(signals::Channel channel, signals::Tick now) noexcept {
  if (channel.index >= setup_.transducers.size()) return {0, Status::invalid};
  const Transducer& t = setup_.transducers[channel.index];
  const signals::Tick sampled = now - lag_[channel.index];
  const double value = quantity(t, static_cast<double>(sampled) * signals::tick_seconds);
  // A state that ran away never comes back: every later reading says so too.
  if (state_.failure || !std::isfinite(value)) return {0, Status::fault};
  const double hiss = t.noise > 0 ? robot::noise(setup_.seed, channel.index, sampled) : 0.0;
  return {counts(t, value, hiss), state_.ended ? Status::ended : Status::ok};
}

Status Stand::stop(signals::Tick) noexcept {
  state_.ended = true;  // nothing moves a simulated body after its last tick
  return state_.failure ? Status::fault : Status::ok;
}

}  // namespace sinew::plant
