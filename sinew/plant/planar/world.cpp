#include "sinew/plant/planar/world.h"

#include "sinew/plant/planar/rollers.h"

namespace sinew::plant {

using signals::Status;

namespace {

constexpr double blocked_bound = 1e9;  // of a joint that is held [N m]

// Shift a pose by h along the given rates.
template <int N>
void move(Pose<N>& out, const Pose<N>& from, double h, const Pose<N>& rate,
          const Generalised<N>& acceleration) {
  out.x = from.x + h * rate.x_rate;
  out.x_rate = from.x_rate + h * acceleration.x;
  for (int i = 0; i < N; ++i) {
    out.angle[i] = from.angle[i] + h * rate.rate[i];
    out.rate[i] = from.rate[i] + h * acceleration.angle[i];
  }
}

}  // namespace

template <int N>
World<N>::World(const Setup& setup)
    : chain_(chain_of<N>(setup.robot)),
      strings_(strings_of(setup.robot)),
      bank_(setup.muscles, setup.air, setup.supply),
      contacts_(chain_, setup.robot),
      robot_(setup.robot),
      step_(setup.steps.body),
      seed_(setup.seed) {
  for (std::size_t s = 0; s < robot_.sensors.size() && s < source_.size(); ++s) {
    const robot::Sensor& sensor = robot_.sensors[s];
    source_[s] = sensor.kind == robot::Sensor::Kind::angle ? robot::find_joint(robot_, sensor.of)
                                                           : robot::find_muscle(robot_, sensor.of);
  }
  double absolute = 0;
  for (int j = 0; j < N; ++j) {
    const robot::Joint& joint = robot_.joints[static_cast<std::size_t>(j)];
    rest_[j] = joint.rest_angle;
    damping_[j] = joint.damping;
    dry_[j] = setup.start.blocked[static_cast<std::size_t>(j)] ? blocked_bound : joint.dry_friction;
    absolute += setup.start.joint_angle[static_cast<std::size_t>(j)];
    state_.pose.angle[j] = absolute;
  }
  state_.pose.x = setup.start.trolley;

  Look look{};
  strings(state_.pose, look);
  for (int i = 0; i < strings_.count; ++i)
    state_.mass[i] = bank_.mass_at(i, setup.start.pressure, look.length[i]);
  for (int i = strings_.count; i < strings_.padded; ++i)
    state_.mass[i] = state_.mass[strings_.count - 1];
  prepare();
}

template <int N>
void World<N>::set_rates(const std::array<double, N>& joint_rates, double x_rate) noexcept {
  double absolute = 0;
  for (int j = 0; j < N; ++j) state_.pose.rate[j] = absolute += joint_rates[j];
  state_.pose.x_rate = x_rate;
  prepare();
}

// Lengths of the muscles and their rates, from the joints' angles.
template <int N>
void World<N>::strings(const Pose<N>& pose, Look& look) const noexcept {
  std::array<double, N> travel, rate;
  for (int j = 0; j < N; ++j) {
    travel[j] = pose.angle[j] - (j > 0 ? pose.angle[j - 1] : 0.0) - rest_[j];
    rate[j] = pose.rate[j] - (j > 0 ? pose.rate[j - 1] : 0.0);
  }
  // In whole lanes from the start: a wide load would have to wait for narrow stores.
  for (int i = 0; i < strings_.padded; i += muscle::lanes) {
    const int* j = &strings_.joint[i];
    const muscle::Four pull = strings_.pull.four(i);
    const muscle::Four turn = {travel[j[0]], travel[j[1]], travel[j[2]], travel[j[3]]};
    const muscle::Four speed = {rate[j[0]], rate[j[1]], rate[j[2]], rate[j[3]]};
    look.length.four(i) = strings_.mount.four(i) - pull * turn;
    look.rate.four(i) = -pull * speed;
  }
}

// Everything that pushes the coordinates but dry friction.
template <int N>
void World<N>::forces(const Chain<N>& chain, const Pose<N>& pose, Look& look) const noexcept {
  std::array<double, N + 1> torque{};
  for (int i = 0; i < strings_.count; ++i)
    torque[strings_.joint[i]] += strings_.pull[i] * look.pull.tension[i];
  for (int j = 0; j < N; ++j)
    torque[j] -= damping_[j] * (pose.rate[j] - (j > 0 ? pose.rate[j - 1] : 0.0));

  look.force.x = 0;
  for (int j = 0; j < N; ++j) look.force.angle[j] = torque[j] - torque[j + 1];

  // The track's stop: one-sided, and never pulling.
  const double beyond = pose.x - robot_.trolley.track_length;
  if (robot_.trolley.present && beyond > 0) {
    const double push =
        robot_.trolley.stop_stiffness * beyond + robot_.trolley.stop_damping * pose.x_rate;
    look.force.x -= push > 0 ? push : 0.0;
  }
  contact(chain, pose, look);
}

// The foot: a disc about the ankle that belongs to the last link. Compliant normal force only; the
// tangential force is one of the step's dry frictions.
template <int N>
void World<N>::contact(const Chain<N>& chain, const Pose<N>& pose, Look& look) const noexcept {
  look.ankle_x = look.ankle_y = look.normal = 0;
  double rate_y = 0;
  for (int i = 0; i < N; ++i) {
    look.ankle_x += chain_.length[i] * chain.cos(i);
    look.ankle_y += chain_.length[i] * chain.sin(i);
    rate_y += chain_.length[i] * chain.cos(i) * pose.rate[i];
  }
  if (!robot_.ground.present || !robot_.foot.present) return;
  const double depth = robot_.ground.height - look.ankle_y;
  if (depth <= 0) return;
  const double push =
      robot_.ground.normal_stiffness * depth - robot_.ground.normal_damping * rate_y;
  look.normal = push > 0 ? push : 0.0;
  for (int i = 0; i < N; ++i) look.force.angle[i] += look.normal * chain_.length[i] * chain.cos(i);
}

// One evaluation of the right-hand side, with the frictions f held.
template <int N>
void World<N>::look_at(double t, const State& state, const Forces& f, Look& look) const noexcept {
  strings(state.pose, look);
  bank_.evaluate(t, look.length, look.rate, state.mass, look.pull);
  const Chain<N> chain(chain_, state.pose);
  forces(chain, state.pose, look);
  Generalised<N> force = look.force;
  const Generalised<N> rub = contacts_.generalised(chain, f);
  force.x += rub.x;
  for (int i = 0; i < N; ++i) force.angle[i] += rub.angle[i];
  look.acceleration = chain.accelerations(force);
}

// A new node: valves and references, the first stage, and what friction can do about it.
template <int N>
void World<N>::prepare() noexcept {
  glanced_ = false;
  strings(state_.pose, first_);
  bank_.node(time_);
  bank_.evaluate(time_, first_.length, first_.rate, state_.mass, first_.pull);
  look_for_failure(bank_.follow(first_.pull.drift));
  const Chain<N> chain(chain_, state_.pose);
  forces(chain, state_.pose, first_);
  first_.acceleration = chain.accelerations(first_.force);

  // Bounds. The mesh's own friction acts through the cams and is part of the joint's.
  Forces bound;
  for (int j = 0; j < N; ++j) bound[j] = dry_[j];
  for (int i = 0; i < strings_.count; ++i)
    bound[strings_.joint[i]] += std::abs(strings_.pull[i]) * first_.pull.mesh[i];
  bound[N] = robot_.trolley.friction(held_[N], contacts_.bound(N));  // Contacts<N>::trolley
  bound[Contacts<N>::foot] = robot_.foot.friction * first_.normal;
  contacts_.prepare(chain, state_.pose, first_.acceleration, bound, first_.normal);
}

template <int N>
void World<N>::step(double h) noexcept {
  held_ = contacts_.hold(h, held_);
  const bool flowing = bank_.any_open();
  // The first stage is the look at the node; two to four stand at 1/2, 1/2 and 1.
  Look later[3];
  const Look* look[4] = {&first_, &later[0], &later[1], &later[2]};
  Generalised<N> a[4] = {contacts_.accelerations(first_.acceleration, held_)};
  State stage[3];
  const Pose<N>* pose[4] = {&state_.pose, &stage[0].pose, &stage[1].pose, &stage[2].pose};
  for (int s = 0; s < 3; ++s) {
    const double part = s == 2 ? h : 0.5 * h;
    move(stage[s].pose, state_.pose, part, *pose[s], a[s]);
    const muscle::Pull& before = look[s]->pull;
    for (int i = 0; i < strings_.padded; i += muscle::lanes) {
      muscle::Four mass = state_.mass.four(i);
      if (flowing) mass += part * (before.inflow.four(i) - before.outflow.four(i));
      stage[s].mass.four(i) = mass;
    }
    look_at(time_ + part, stage[s], held_, later[s]);
    a[s + 1] = later[s].acceleration;
  }

  const double sixth = h / 6.0;
  // Their weighted mean.
  const auto mean = [&](auto&& of) { return sixth * (of(0) + 2.0 * of(1) + 2.0 * of(2) + of(3)); };
  Pose<N>& now = state_.pose;
  const Pose<N> rates = now;  // of the first stage: `now` moves
  pose[0] = &rates;
  now.x += mean([&](int s) { return pose[s]->x_rate; });
  now.x_rate += mean([&](int s) { return a[s].x; });
  for (int i = 0; i < N; ++i) {
    now.angle[i] += mean([&](int s) { return pose[s]->rate[i]; });
    now.rate[i] += mean([&](int s) { return a[s].angle[i]; });
  }

  for (int i = 0; flowing && i < strings_.count; ++i) {
    const double in = mean([&](int s) { return look[s]->pull.inflow[i]; });
    const double out = mean([&](int s) { return look[s]->pull.outflow[i]; });
    air_in_[i] += in;
    air_out_[i] += out;
    state_.mass[i] += in - out;
  }
}

// The next multiple of the body step, or the next change of a valve.
template <int N>
double World<N>::next_node() const noexcept {
  const double multiple = static_cast<double>(multiple_ + 1) * step_;
  const double change = bank_.next_change();
  return change < multiple ? change : multiple;
}

template <int N>
void World<N>::advance(double t) noexcept {
  while (!failure_ && next_node() <= t) commit();
}

template <int N>
void World<N>::commit() noexcept {
  const double next = next_node(), h = next - time_;
  if (h > 0) step(h);
  time_ = next > time_ ? next : time_;
  if (next >= static_cast<double>(multiple_ + 1) * step_) ++multiple_;
  ++nodes_;
  prepare();
}

// The friction that a whole body step from the last node would have: what a peek goes by, however
// far it looks, so that it depends on the node alone.
template <int N>
auto World<N>::glance() noexcept -> const Glance& {
  if (glanced_) return glance_;
  glanced_ = true;
  glance_.held = contacts_.hold(step_, held_);
  glance_.acceleration = contacts_.accelerations(first_.acceleration, glance_.held);
  return glance_;
}

// From the last node to t in a copy: the body by its acceleration ...
template <int N>
Pose<N> World<N>::peek_pose(const Glance& g, double t) const noexcept {
  const double dt = t - time_;
  Pose<N> pose = state_.pose;
  move(pose, state_.pose, dt, state_.pose, g.acceleration);
  pose.x += 0.5 * dt * dt * g.acceleration.x;
  for (int i = 0; i < N; ++i) pose.angle[i] += 0.5 * dt * dt * g.acceleration.angle[i];
  return pose;
}

// ... and the air by Heun's rule where some valve is open.
template <int N>
auto World<N>::peek(const Glance& g, double t) const noexcept -> Peek {
  const double dt = t - time_;
  Peek p{.state = state_, .look = first_, .air_in = air_in_, .air_out = air_out_};
  if (dt <= 0) return p;
  p.state.pose = peek_pose(g, t);
  const muscle::Pull& before = first_.pull;
  for (int pass = 0; pass < 2; ++pass) {
    strings(p.state.pose, p.look);
    bank_.evaluate(t, p.look.length, p.look.rate, p.state.mass, p.look.pull);
    if (!bank_.any_open() || pass == 1) break;
    for (int i = 0; i < strings_.count; ++i) {
      const double in = 0.5 * dt * (before.inflow[i] + p.look.pull.inflow[i]);
      const double out = 0.5 * dt * (before.outflow[i] + p.look.pull.outflow[i]);
      p.air_in[i] = air_in_[i] + in;
      p.air_out[i] = air_out_[i] + out;
      p.state.mass[i] = state_.mass[i] + (in - out);
    }
  }
  return p;
}

// What a gauge in the cord sees: the pull and its share of the mesh's friction.
template <int N>
double World<N>::gauge(const Glance& g, const Peek& p, int muscle) const noexcept {
  const int j = strings_.joint[muscle];
  double f = p.look.pull.tension[muscle];
  const double mesh = first_.pull.mesh[muscle];
  if (mesh > 0) {
    const double share = g.held[j] * mesh / contacts_.bound(j);
    f += strings_.pull[muscle] > 0 ? share : -share;
  }
  return f < 0 ? 0.0 : f;  // not a number stays what it is
}

template <int N>
Status World<N>::start(const signals::Scan& scan) noexcept {
  for (const signals::Conversion& c : scan.conversions) {
    if (c.channel.index >= robot_.sensors.size()) return Status::invalid;
    lag_[c.channel.index] = c.read - c.start;
  }
  return Status::ok;
}

template <int N>
Status World<N>::drive(signals::Edge edge) noexcept {
  if (ended_) return Status::ended;
  if (failure_) return Status::fault;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (edge.valve.index >= 2 * strings_.count || t < time_) return Status::invalid;
  while (!failure_ && next_node() < t)
    commit();  // later edges act at t or after: these nodes are final
  bank_.electrical(edge.valve.index, t, edge.open);
  return Status::ok;
}

template <int N>
signals::Reading World<N>::read(signals::Channel channel, signals::Tick now) noexcept {
  const robot::Sensor& sensor = robot_.sensors[channel.index];
  const signals::Tick sampled = now - lag_[channel.index];
  const double t = static_cast<double>(sampled) * signals::tick_seconds;
  double quantity = 0;
  const int of = source_[channel.index];
  if (of >= 0) {  // else it is of something that stands still
    advance(t);
    const Glance& g = glance();
    if (sensor.kind == robot::Sensor::Kind::angle) {
      const Pose<N> pose = peek_pose(g, t);
      const auto j = static_cast<std::size_t>(of);
      quantity = pose.angle[j] - (of > 0 ? pose.angle[j - 1] : 0.0) - rest_[j];
    } else {
      quantity = gauge(g, peek(g, t), of);
    }
  }
  // A state that ran away never comes back: every later reading says so too.
  if (failure_ || !std::isfinite(quantity)) return {0, Status::fault};
  const double hiss = sensor.noise > 0 ? robot::noise(seed_, channel.index, sampled) : 0.0;
  return {counts(sensor, robot_.converter, quantity, hiss), ended_ ? Status::ended : Status::ok};
}

template <int N>
Status World<N>::stop(signals::Tick) noexcept {
  ended_ = true;  // nothing moves a simulated body after its last tick
  return failure_ ? Status::fault : Status::ok;
}

template <int N>
Truth World<N>::truth(double t) noexcept {
  advance(t);
  const Glance& g = glance();
  const Peek p = peek(g, t);
  const Pose<N>& pose = p.state.pose;

  Truth out;
  out.x = pose.x;
  out.x_rate = pose.x_rate;
  for (int j = 0; j < N; ++j) {
    const auto k = static_cast<std::size_t>(j);
    out.angle[k] = pose.angle[j] - (j > 0 ? pose.angle[j - 1] : 0.0);
    out.rate[k] = pose.rate[j] - (j > 0 ? pose.rate[j - 1] : 0.0);
  }
  for (int i = 0; i < strings_.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.tension[k] = gauge(g, p, i);
    out.pressure[k] = p.look.pull.pressure[i];
    out.length[k] = p.look.length[i];
    out.mass[k] = p.state.mass[i];
    out.air_in[k] = p.air_in[i];
    out.air_out[k] = p.air_out[i];
    out.torque[static_cast<std::size_t>(strings_.joint[i])] += strings_.pull[i] * out.tension[k];
  }

  Look look = p.look;
  const Chain<N> chain(chain_, pose);
  contact(chain, pose, look);
  out.foot_x = look.ankle_x;
  out.foot_y = look.ankle_y;
  out.force_x = look.normal > 0 ? g.held[Contacts<N>::foot] : 0.0;
  out.force_y = look.normal;
  if (robot_.rollers.present) rollers(g, chain, pose, out);
  return out;
}

// The force on what hangs from the trolley is what its momentum asks for, less the ground's.
template <int N>
void World<N>::rollers(const Glance& g, const Chain<N>& chain, const Pose<N>& pose,
                       Truth& out) const noexcept {
  const Generalised<N>& a = g.acceleration;
  const double hung = robot::leg_mass(robot_) + robot_.cylinder.body_mass;
  Hanging h{.acceleration = a.x};
  h.force_x = hung * a.x - out.force_x;
  h.force_y = hung * chain_.gravity - out.force_y;
  for (int i = 0; i < N; ++i)
    h.add(chain_.first_moment[i], chain.sin(i), chain.cos(i), pose.rate[i], a.angle[i]);
  h.torque = out.torque[0] - damping_[0] * pose.rate[0] + g.held[0];
  const RollerLoads loads = roller_loads(robot_, h);
  out.roller_front = loads.front;
  out.roller_rear = loads.rear;
}

template class World<1>;
template class World<2>;

}  // namespace sinew::plant
