#include "sinew/plant/rig/stand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/actuator/stiffness.h"
#include "sinew/plant/rig/cut.h"
#include "sinew/robot/sensing.h"

namespace sinew::plant {

using signals::Status;

namespace {

// Rates times the length of a piece. RK4's error per radian of a swing is the fourth power/120.
constexpr double longest_swing = 0.08, longest_settling = 0.3;
constexpr double shortest_piece = 1e-7;  // [s]
constexpr double cut_within = 1e-11;     // of what breaks off [s]
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

double Stand::travel(double length) const noexcept {
  return setup_.cylinder ? setup_.cylinder->stroke - length : 0.0;
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
void Stand::evaluate(double t, double length, double rate, const muscle::AirState& air,
                     Look& out) const noexcept {
  muscle::Lanes lengths{}, rates{};
  lengths[0] = length;
  rates[0] = rate;
  plumbing_.evaluate(t, lengths, rates, travel(length), -rate, air, state_.valves, out.pull,
                     out.flow);
  const muscle::AirPull& p = out.pull;
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
    out.leak = p.leak[0];
  }
}

// Everything that one look at a state yields.
void Stand::look(double t, const Order& o, const Moving& s, Look& out) const noexcept {
  const double length = driven_ ? o.length.at(t) : std::clamp(s.length, o.shortest, o.longest);
  const double rate = driven_ ? o.length.slope : s.velocity;
  if (regulated_) {
    muscle::Lanes lengths{};
    lengths[0] = length;
    muscle::AirState held = s.air;
    plumbing_.hold(o.pressure.at(t), lengths, travel(length), held);
    evaluate(t, length, rate, held, out);
    out.in = out.out = out.leak = 0;
    for (int i = 0; i < plumbing_.held_states(); ++i) out.flow[i] = 0;
  } else {
    evaluate(t, length, rate, s.air, out);
  }
  const double mass = o.mass.at(t);
  out.asks = mass * setup_.load.gravity + o.force.at(t) - out.force;
  const bool held = driven_ || (rubs_ && s.rub == Rub::rests);
  const double dry = static_cast<double>(s.rub) * out.bound;
  out.velocity = rate;
  out.acceleration = held ? 0.0 : (out.asks - dry) / mass;
}

void Stand::shift(Moving& out, const Moving& from, double h, const Look& by) const noexcept {
  out.length = from.length + h * by.velocity;
  out.velocity = from.velocity + h * by.acceleration;
  for (int i = 0; i < plumbing_.states(); ++i) out.air[i] = from.air[i] + h * by.flow[i];
  out.air.reference = from.air.reference;
  out.in = from.in + h * by.in;
  out.out = from.out + h * by.out;
  out.leak = from.leak + h * by.leak;
  out.rub = from.rub;
}

void Stand::rk4(double t, double h, const Order& o, const Moving& s, const Look& first,
                Moving& out) const noexcept {
  Look second, third, fourth;
  Moving stage;
  shift(stage, s, 0.5 * h, first);
  look(t + 0.5 * h, o, stage, second);
  shift(stage, s, 0.5 * h, second);
  look(t + 0.5 * h, o, stage, third);
  shift(stage, s, h, third);
  look(t + h, o, stage, fourth);
  shift(out, s, h / 6.0, first);
  shift(out, out, h / 3.0, second);
  shift(out, out, h / 3.0, third);
  shift(out, out, h / 6.0, fourth);
}

// 0 short of L_min, 1 between the ends, 2 beyond L_max.
int Stand::region(double length) const noexcept {
  return length < ends_[0] ? 0 : length > ends_[1] ? 2 : 1;
}

// Returns how far `after` is beyond what a smooth piece from `before` can hold: above 0 where an
// end was passed [m], where the speed turned against the friction [m/s], or where the load asks for
// more than the friction holds [N].
double Stand::gap(double t, const Order& o, const Moving& before,
                  const Moving& after) const noexcept {
  if (driven_) return -infinite;
  const int side = region(before.length);
  double beyond = -infinite;
  if (side != 1) beyond = side == 0 ? after.length - ends_[0] : ends_[1] - after.length;
  if (side == 1) beyond = std::max(after.length - ends_[1], ends_[0] - after.length);
  if (!rubs_) return beyond;
  if (before.rub != Rub::rests)
    return std::max(beyond, -after.velocity * static_cast<double>(before.rub));
  Look l;
  look(t, o, after, l);
  return std::max(beyond, std::fabs(l.asks) - l.bound);
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
  muscle::Lanes lengths{};
  lengths[0] = s.length;
  const double before = s.air[0];
  plumbing_.hold(o.pressure.at(t), lengths, travel(s.length), s.air);
  const double gained = s.air[0] - before;
  (gained > 0 ? s.in : s.out) += std::fabs(gained);
}

// Of a chamber that settles at the pressure behind an open valve: the flow's slope is steep there
// [1/s].
double Stand::settling_rate(double exponent, const Moving& s, const Look& at) const noexcept {
  const muscle::AirPull& p = at.pull;
  const bool cylinder = setup_.cylinder.has_value();
  const double behind = cylinder ? p.cylinder_pressure[muscle::up] : p.manifold[0];
  const double in = std::fabs(at.in / (p.supply_pressure - behind));
  const double out = std::fabs(at.out / (behind - setup_.air.atmosphere));
  const double slope = (std::isfinite(in) ? in : 0.0) + (std::isfinite(out) ? out : 0.0);
  return exponent * behind * slope / s.air[0];
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
  if (!plumbing_.quiet(state_.valves)) {
    muscle::Lanes lengths{};
    lengths[0] = s.length;
    longest = std::min({longest, plumbing_.longest_step(lengths, travel(s.length), state_.valves),
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
  plumbing_.remember(first.pull, s.air);

  const double target = std::min(end, o.corner), whole = target - t;
  const double pieces = std::ceil(whole / longest_piece(o, s, first) - 1e-9);
  double h = pieces > 1 ? whole / pieces : whole;
  double reached = pieces > 1 ? t + h : target;
  Moving after, there;
  rk4(t, h, o, s, first, after);
  const double broken = gap(reached, o, s, after);
  if (broken > 0) {
    // The end of the piece is put where it breaks, on the far side of it.
    h = cut(h, gap(t, o, s, s), broken, cut_within, [&](double part) {
      rk4(t, part, o, s, first, there);
      const double g = gap(t + part, o, s, there);
      if (g > 0) after = there;
      return g;
    });
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
  plumbing_.node(state_.time, state_.first.pull, state_.valves);
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
  return plumbing_.total_mass(state_.now.air, travel(state_.now.length));
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
          .air = s.air[0],
          .air_in = s.in,
          .air_out = s.out,
          .air_leaked = s.leak,
          .inlet = plumbing_.open_share(0, t, state_.valves),
          .exhaust = plumbing_.open_share(1, t, state_.valves),
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
  plumbing_.electrical(edge.valve.index, t, edge.open, state_.first.pull, state_.valves);
  plumbing_.level(edge.valve.index, t, static_cast<double>(edge.level) / signals::max_level,
                  state_.valves);
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
