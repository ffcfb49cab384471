#include "sinew/plant/planar/whole.h"

#include <algorithm>
#include <cmath>

namespace sinew::plant {

using signals::Status;

namespace {

constexpr double blocked_bound = 1e9;  // of a joint that is held [N m]

// Of the fastest rate in the machine times the step: RK4 is stable up to 2.8, and the rate changes
// with the pose.
constexpr double longest_rate = 1.5;

// A step is cut into at most so many pieces. More are asked for only where a chamber has vanished.
constexpr double most_pieces = 1e5;

}  // namespace

WholeWorld::WholeWorld(const Setup& setup)
    : constants_(body_of(setup.robot)),
      robot_(setup.robot),
      cords_(setup.robot),
      plumbing_(setup.muscles, setup.air, setup.supply, setup.cylinder),
      rubs_(constants_, setup.robot),
      step_(setup.steps.body),
      seed_(setup.seed) {
  using Kind = robot::Sensor::Kind;
  for (std::size_t s = 0; s < robot_.sensors.size() && s < source_.size(); ++s) {
    const robot::Sensor& sensor = robot_.sensors[s];
    const bool joint = sensor.kind == Kind::angle || sensor.kind == Kind::velocity;
    source_[s] =
        joint ? robot::find_joint(robot_, sensor.of) : robot::find_muscle(robot_, sensor.of);
  }
  double absolute = 0;
  for (std::size_t j = 0; j < constants_.links; ++j) {
    const robot::Joint& joint = robot_.joints[j];
    rest_[j] = joint.rest_angle;
    damping_[j] = joint.damping + joint.damper;
    dry_[j] = setup.start.blocked[j] ? blocked_bound : joint.dry_friction;
    absolute += setup.start.joint_angle[j];
    state_.motion.at[first_link + j] = absolute;
  }
  state_.motion.at[along_track] = setup.start.trolley;
  state_.motion.at[up] = setup.start.lift;

  Look look{};
  std::array<double, most_links> angle{}, still{};
  for (std::size_t j = 0; j < constants_.links; ++j) angle[j] = setup.start.joint_angle[j];
  cords_.at(angle.data(), still.data(), look.length, look.rate, look.pulls);
  const double rate =
      rubs_.stiffest_rate(Body(constants_, state_.motion), state_.motion, setup.robot);
  if (rate * step_ > longest_rate) step_ /= std::ceil(rate * step_ / longest_rate);
  state_.air = plumbing_.initial(setup.start.pressure, look.length, setup.start.lift);
  prepare();
}

void WholeWorld::set_rates(const std::array<double, most_links>& joint_rates, double x_rate,
                           double y_rate) noexcept {
  double absolute = 0;
  for (std::size_t j = 0; j < constants_.links; ++j)
    state_.motion.rate[first_link + j] = absolute += joint_rates[j];
  state_.motion.rate[along_track] = x_rate;
  state_.motion.rate[up] = y_rate;
  prepare();
}

double WholeWorld::air_mass() const noexcept {
  return plumbing_.total_mass(state_.air, state_.motion.at[up]);
}

double WholeWorld::joint_angle(const Motion& m, std::size_t j) const noexcept {
  return m.at[first_link + j] - (j > 0 ? m.at[first_link + j - 1] : 0.0);
}

double WholeWorld::joint_rate(const Motion& m, std::size_t j) const noexcept {
  return m.rate[first_link + j] - (j > 0 ? m.rate[first_link + j - 1] : 0.0);
}

// Muscles and their air at a state.
void WholeWorld::air(double t, const State& state, Look& look) const noexcept {
  std::array<double, most_links> angle, rate;
  for (std::size_t j = 0; j < constants_.links; ++j) {
    angle[j] = joint_angle(state.motion, j);
    rate[j] = joint_rate(state.motion, j);
  }
  cords_.at(angle.data(), rate.data(), look.length, look.rate, look.pulls);
  plumbing_.evaluate(t, look.length, look.rate, state.motion.at[up], state.motion.rate[up],
                     state.air, look.pull, look.flow);
}

// One-sided at both ends of the stroke.
double WholeWorld::cylinder_stop(const Motion& m) const noexcept {
  const robot::Cylinder& c = robot_.cylinder;
  const double below = -m.at[up], above = m.at[up] - c.stroke;
  if (below > 0) {
    const double push = c.stop_stiffness * below - c.stop_damping * m.rate[up];
    return push > 0 ? push : 0.0;
  }
  if (above > 0) {
    const double push = c.stop_stiffness * above + c.stop_damping * m.rate[up];
    return push > 0 ? -push : 0.0;
  }
  return 0;
}

// Everything that pushes the coordinates but dry friction.
void WholeWorld::forces(const Body& body, const State& state, Look& look) const noexcept {
  const Motion& m = state.motion;
  std::array<double, most_links + 1> torque{};
  for (std::size_t j = 0; j < constants_.links; ++j) {
    const robot::Joint& joint = robot_.joints[j];
    look.passive_torque[j] =
        -damping_[j] * joint_rate(m, j) - joint.spring * (joint_angle(m, j) - joint.spring_angle);
    torque[j] = look.passive_torque[j];
  }
  for (int i = 0; i < cords_.count(); ++i)
    for (int k = 0; k < Cords::most; ++k)
      if (const int j = cords_.joint(i, k); j >= 0)
        torque[static_cast<std::size_t>(j)] +=
            look.pulls[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] *
            look.pull.tension[i];

  look.force = {};
  for (std::size_t j = 0; j < constants_.links; ++j)
    look.force[first_link + j] = torque[j] - torque[j + 1];

  const double beyond = m.at[along_track] - robot_.trolley.track_length;
  if (robot_.trolley.present && beyond > 0) {
    const double push =
        robot_.trolley.stop_stiffness * beyond + robot_.trolley.stop_damping * m.rate[along_track];
    look.force[along_track] -= push > 0 ? push : 0.0;
  }
  if (!constants_.held[up])
    look.force[up] +=
        look.pull.cylinder_force - robot_.cylinder.damping * m.rate[up] + cylinder_stop(m);

  look.normal = {};
  for (int i = 0; i < rubs_.discs(); ++i) {
    const DiscAt disc = rubs_.disc(body, m, i);
    const double push = rubs_.push(disc, i, m);
    look.normal[static_cast<std::size_t>(i)] = push;
    if (push <= 0) continue;
    for (std::size_t c = 0; c < constants_.coordinates(); ++c) look.force[c] += push * disc.rise[c];
  }
}

// One evaluation of the right-hand side, with the frictions f held.
void WholeWorld::look_at(double t, const State& state, const Forces& f, Look& look) const noexcept {
  air(t, state, look);
  const Body body(constants_, state.motion);
  forces(body, state, look);
  Coordinates force = look.force;
  const Coordinates rub = rubs_.generalised(body, state.motion, f);
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) force[c] += rub[c];
  look.acceleration = body.accelerations(force);
}

// A new node: valves, the first stage, and what friction can do about it.
void WholeWorld::prepare() noexcept {
  glanced_ = false;
  plumbing_.node(time_);
  air(time_, state_, first_);
  look_for_failure();
  plumbing_.remember(first_.pull, state_.air);
  const Body body(constants_, state_.motion);
  forces(body, state_, first_);
  first_.acceleration = body.accelerations(first_.force);

  // Bounds. The mesh's own friction acts through the cams and is part of the joint's.
  Forces bound{};
  for (std::size_t j = 0; j < constants_.links; ++j) bound[j] = dry_[j];
  for (int i = 0; i < cords_.count(); ++i)
    for (int k = 0; k < Cords::most; ++k)
      if (const int j = cords_.joint(i, k); j >= 0)
        bound[static_cast<std::size_t>(j)] +=
            std::abs(first_.pulls[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]) *
            first_.pull.mesh[i];
  if (!constants_.held[along_track])
    bound[Rubs::trolley] =
        robot_.trolley.friction(held_[Rubs::trolley], rubs_.bound(Rubs::trolley));
  bound[Rubs::lift] = constants_.held[up] ? 0.0 : robot_.cylinder.friction;
  for (std::size_t i = 0; i < most_discs; ++i)
    bound[Rubs::first_disc + i] = robot_.foot.friction * first_.normal[i];
  rubs_.prepare(body, state_.motion, first_.acceleration, bound, first_.normal);
}

// Air and what has passed, h along the rates of a look.
void WholeWorld::push_air(State& out, const State& from, double h,
                          const Look& look) const noexcept {
  for (int i = 0; i < plumbing_.states(); ++i) out.air[i] = from.air[i] + h * look.flow[i];
  const auto n = static_cast<std::size_t>(cords_.count());
  for (std::size_t i = 0; i < n; ++i) {
    const int m = static_cast<int>(i);
    out.tally.in[i] = from.tally.in[i] + h * look.pull.inflow[m];
    out.tally.out[i] = from.tally.out[i] + h * look.pull.outflow[m];
    out.tally.leak[i] = from.tally.leak[i] + h * look.pull.leak[m];
  }
  for (std::size_t c = 0; c < 2; ++c) {
    out.tally.in[n + c] = from.tally.in[n + c] + h * look.pull.cylinder_inflow[c];
    out.tally.out[n + c] = from.tally.out[n + c] + h * look.pull.cylinder_outflow[c];
  }
}

// `from`, h along the rates that a look at `at` found.
void WholeWorld::shift(State& out, const State& from, double h, const State& at,
                       const Look& look) const noexcept {
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    out.motion.at[c] = from.motion.at[c] + h * at.motion.rate[c];
    out.motion.rate[c] = from.motion.rate[c] + h * look.acceleration[c];
  }
  push_air(out, from, h, look);
}

// Hoses, walls and lags can be quicker than the body: a step is then made of several pieces, under
// the friction of the whole.
void WholeWorld::step(double h) noexcept {
  held_ = rubs_.hold(h, held_);
  first_.acceleration = rubs_.accelerations(first_.acceleration, held_);
  const double pieces = pieces_of(h, first_);
  inner_ = time_;
  for (double k = 0; k < pieces; ++k) {
    if (k > 0) {
      look_at(inner_, state_, held_, first_);
      plumbing_.remember(first_.pull, state_.air);
    }
    piece(h / pieces);
  }
}

// While nothing flows there is nothing to be quick.
double WholeWorld::pieces_of(double h, const Look& look) const noexcept {
  const double longest = plumbing_.longest_step(look.length);
  const double pieces = h > longest && !plumbing_.quiet() ? std::ceil(h / longest) : 1.0;
  return std::min(pieces, most_pieces);
}

double WholeWorld::shortest_step() const noexcept {
  return std::min(step_, plumbing_.longest_step(first_.length));
}

void WholeWorld::piece(double h) noexcept {
  // The first stage is the look at hand; two to four stand at 1/2, 1/2 and 1.
  Look later[3];
  const Look* look[4] = {&first_, &later[0], &later[1], &later[2]};
  State stage[3];
  const State* state[4] = {&state_, &stage[0], &stage[1], &stage[2]};
  for (int s = 0; s < 3; ++s) {
    const double part = s == 2 ? h : 0.5 * h;
    shift(stage[s], state_, part, *state[s], *look[s]);
    look_at(inner_ + part, stage[s], held_, later[s]);
  }

  // Their weighted mean, one after the other.
  const double weight[4] = {h / 6.0, h / 3.0, h / 3.0, h / 6.0};
  State sum = state_;
  for (int s = 0; s < 4; ++s) shift(sum, State(sum), weight[s], *state[s], *look[s]);
  state_ = sum;
  inner_ += h;
}

// The next multiple of the body step, or the next change of a valve.
double WholeWorld::next_node() const noexcept {
  const double multiple = static_cast<double>(multiple_ + 1) * step_;
  const double change = plumbing_.next_change();
  return change < multiple ? change : multiple;
}

void WholeWorld::advance(double t) noexcept {
  while (!failure_ && next_node() <= t) commit();
}

void WholeWorld::commit() noexcept {
  const double next = next_node(), h = next - time_;
  if (h > 0) step(h);
  time_ = next > time_ ? next : time_;
  if (next >= static_cast<double>(multiple_ + 1) * step_) ++multiple_;
  ++nodes_;
  prepare();
}

// The friction that a whole body step from the last node would have: what a peek goes by, however
// far it looks, so that it depends on the node alone.
auto WholeWorld::glance() noexcept -> const Glance& {
  if (glanced_) return glance_;
  glanced_ = true;
  glance_.held = rubs_.hold(step_, held_);
  glance_.acceleration = rubs_.accelerations(first_.acceleration, glance_.held);
  return glance_;
}

Motion WholeWorld::peek_motion(const Glance& g, double t) const noexcept {
  const double dt = t - time_;
  Motion m = state_.motion;
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    m.at[c] += dt * (m.rate[c] + 0.5 * dt * g.acceleration[c]);
    m.rate[c] += dt * g.acceleration[c];
  }
  return m;
}

// From the last node to t in a copy: the body by its acceleration, the air by Heun's rule in as
// many pieces as a step would take.
auto WholeWorld::peek(const Glance& g, double t) const noexcept -> Peek {
  Peek p{.state = state_, .look = first_};
  const double dt = t - time_;
  if (dt <= 0 || failure_) return p;
  const double pieces = pieces_of(dt, first_);
  const double h = dt / pieces;
  for (double k = 1; k <= pieces; ++k) {
    const double to = time_ + k * h;
    const State from = p.state;
    const Look before = p.look;
    p.state.motion = peek_motion(g, to);
    if (!plumbing_.quiet()) {
      push_air(p.state, from, h, before);
      air(to, p.state, p.look);
      push_air(p.state, from, 0.5 * h, before);
      push_air(p.state, State(p.state), 0.5 * h, p.look);
    }
    air(to, p.state, p.look);
  }
  return p;
}

// What a gauge in the cord sees: the pull and its share of the mesh's friction, by the joint that
// the muscle belongs to.
double WholeWorld::gauge(const Glance& g, const Peek& p, int muscle) const noexcept {
  const auto j = static_cast<std::size_t>(cords_.joint(muscle, 0));
  double f = p.look.pull.tension[muscle];
  const double mesh = first_.pull.mesh[muscle], bound = rubs_.bound(static_cast<int>(j));
  if (mesh > 0 && bound > 0) {
    const double share = g.held[j] * mesh / bound;
    f += first_.pulls[static_cast<std::size_t>(muscle)][0] > 0 ? share : -share;
  }
  return f < 0 ? 0.0 : f;  // not a number stays what it is
}

Status WholeWorld::start(const signals::Scan& scan) noexcept {
  for (const signals::Conversion& c : scan.conversions) {
    if (c.channel.index >= robot_.sensors.size()) return Status::invalid;
    lag_[c.channel.index] = c.read - c.start;
  }
  return Status::ok;
}

Status WholeWorld::drive(signals::Edge edge) noexcept {
  if (ended_) return Status::ended;
  if (failure_) return Status::fault;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (edge.valve.index >= plumbing_.valves() || t < time_) return Status::invalid;
  while (!failure_ && next_node() < t)
    commit();  // later edges act at t or after: these nodes are final
  plumbing_.electrical(edge.valve.index, t, edge.open, first_.pull);
  plumbing_.level(edge.valve.index, t, static_cast<double>(edge.level) / signals::max_level);
  return Status::ok;
}

// What the sensor stands before at t.
double WholeWorld::quantity(std::size_t index, double t) noexcept {
  using Kind = robot::Sensor::Kind;
  const Kind kind = robot_.sensors[index].kind;
  if (kind == Kind::fixed) return 0;
  advance(t);
  const Glance& g = glance();
  const int of = source_[index];
  const auto j = static_cast<std::size_t>(of < 0 ? 0 : of);
  if (kind == Kind::angle) return joint_angle(peek_motion(g, t), j) - rest_[j];
  if (kind == Kind::velocity) return joint_rate(peek_motion(g, t), j);
  if (kind == Kind::cylinder) return peek_motion(g, t).at[up];
  const Peek p = peek(g, t);
  const double gauged = p.look.pull.pressure[of] - plumbing_.atmosphere();
  if (kind == Kind::pressure || !std::isfinite(gauged)) return gauged;  // air that ran away too
  return gauge(g, p, of);
}

signals::Reading WholeWorld::read(signals::Channel channel, signals::Tick now) noexcept {
  const robot::Sensor& sensor = robot_.sensors[channel.index];
  const signals::Tick sampled = now - lag_[channel.index];
  const double value =
      quantity(channel.index, static_cast<double>(sampled) * signals::tick_seconds);
  // A state that ran away never comes back: every later reading says so too.
  if (failure_ || !std::isfinite(value)) return {0, Status::fault};
  const double hiss = sensor.noise > 0 ? robot::noise(seed_, channel.index, sampled) : 0.0;
  return {counts(sensor, robot_.converter, value, hiss), ended_ ? Status::ended : Status::ok};
}

Status WholeWorld::stop(signals::Tick) noexcept {
  ended_ = true;  // nothing moves a simulated body after its last tick
  return failure_ ? Status::fault : Status::ok;
}

}  // namespace sinew::plant
