#include "bench/peers/mujoco_leg.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "bench/peers/pow_muscle.h"
#include "sinew/gas/delay.h"
#include "sinew/mechanism/planar/layout.h"
#include "sinew/robot/sensing.h"

namespace sinew::bench {

using signals::Status;
using signals::Tick;

namespace {

constexpr int trolley = 0, hip = 1, knee = 2;  // coordinates

// --- the model ----------------------------------------------------------------------------------

// Time constant of soft constraints [s]: four steps, and about that of the table's spring under the
// leg's weight.
constexpr double settling = 4e-3;

struct Solid {
  double mass = 0, center = 0, inertia = 0;  // [kg], along the link [m], about the centre [kg m2]
};

// Returns the inertia of a link with a point mass at its end.
Solid loaded(const robot::Link& link, double at_end) {
  Solid s{.mass = link.mass + at_end};
  s.center = (link.mass * link.center_of_mass + at_end * link.length) / s.mass;
  const double to_link = link.center_of_mass - s.center, to_end = link.length - s.center;
  s.inertia = link.inertia + link.mass * to_link * to_link + at_end * to_end * to_end;
  return s;
}

std::string inertial(const Solid& s) {
  return fmt::format(R"(<inertial pos="{} 0 0" mass="{}" diaginertia="{} {} {}"/>)", s.center,
                     s.mass, s.inertia, s.inertia, s.inertia);
}

std::string hinge(const robot::Joint& j) {
  return fmt::format(R"(<joint name="{}" type="hinge" axis="0 -1 0" damping="{}" frictionloss="{}")"
                     R"( stiffness="{}" springref="{}"/>)",
                     j.name, j.damping + j.damper, j.dry_friction, j.spring, j.spring_angle);
}

std::string contact(double friction) {
  return fmt::format(R"(condim="3" friction="{} 0 0" solref="{} 1")", friction, settling);
}

// Returns the leg's numbers as MJCF text, with time step `step` [s]: x forward, z up; angles from x
// to z, the knee's measured from the femur.
std::string mjcf(const plant::Setup& setup, double step, Integrator integrator) {
  const robot::Robot& r = setup.robot;
  const robot::Link &femur = r.links.at(0), &tibia = r.links.at(1);
  const Solid upper = loaded(femur, 0), lower = loaded(tibia, r.foot.mass);
  const double carried = r.trolley.moving_mass() - robot::leg_mass(r);
  const double surface = r.ground.height - r.foot.radius;
  return fmt::format(
      R"(<mujoco model="leg"><compiler angle="radian"/>
<option timestep="{step}" integrator="{integrator}" cone="elliptic" gravity="0 0 {gravity}"/>
<worldbody>
<geom name="table" type="plane" pos="0 0 {surface}" size="10 10 1" {contact}/>
<body name="trolley">{carried}
<joint name="trolley" type="slide" axis="1 0 0" frictionloss="{drag}" limited="true"
 range="-10 {track}"/>
<body name="femur">{upper}{hip}
<body name="tibia" pos="{femur} 0 0">{lower}{knee}
<geom name="foot" type="sphere" pos="{tibia} 0 0" size="{radius}" {contact}/>
</body></body></body></worldbody></mujoco>
)",
      fmt::arg("step", step),
      fmt::arg("integrator", integrator == Integrator::rk4 ? "RK4" : "Euler"),
      fmt::arg("gravity", -r.gravity), fmt::arg("surface", surface),
      fmt::arg("contact", contact(r.foot.friction)),
      fmt::arg("carried", inertial({.mass = carried, .inertia = 1.0})),
      fmt::arg("drag", r.trolley.drag), fmt::arg("track", r.trolley.track_length),
      fmt::arg("upper", inertial(upper)), fmt::arg("lower", inertial(lower)),
      fmt::arg("hip", hinge(r.joints.at(0))), fmt::arg("knee", hinge(r.joints.at(1))),
      fmt::arg("femur", femur.length), fmt::arg("tibia", tibia.length),
      fmt::arg("radius", r.foot.radius));
}

// Loads the model from a file, which works with all versions.
mjModel* load(const std::string& xml) {
  const auto file =
      std::filesystem::temp_directory_path() / ("sinew_bench_" + std::to_string(getpid()) + ".xml");
  std::ofstream(file) << xml;
  char error[1000] = "";
  mjModel* model = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
  std::filesystem::remove(file);
  if (!model) throw std::runtime_error(std::string("MuJoCo refuses the leg: ") + error);
  return model;
}

}  // namespace

std::string mujoco_version() { return mj_versionString(); }

struct MujocoLeg::State {
  plant::Setup setup;
  LegSteps steps;
  plant::ChainRouting routes;
  mjModel* model = nullptr;
  mjData* data = nullptr;

  std::vector<PowMuscle> muscles;
  std::vector<gas::Shutter> shutters;  // 2 x muscle + (0 inlet | 1 exhaust)
  std::array<Tick, 256> lag{};
  std::vector<int> source;  // of each channel, its joint or muscle

  Tick at = 0;                           // time of muscles and valves
  std::array<double, 3> begin{}, end{};  // coordinates over the current body step
  std::array<double, 3> end_rate{};

  State(const plant::Setup& s, const LegSteps& n, Integrator integrator)
      : setup(s), steps(n), routes(plant::chain_routing_of(s.robot)) {
    model = load(mjcf(s, steps.body * signals::tick_seconds, integrator));
    data = mj_makeData(model);
    data->qpos[trolley] = s.start.trolley;
    data->qpos[hip] = s.start.joint_angle.at(0);
    data->qpos[knee] = s.start.joint_angle.at(1);
    mj_forward(model, data);
    take_over();
    begin = end;
    for (std::size_t i = 0; i < s.muscles.size(); ++i) {
      const air::Muscle& m = s.muscles[i];
      muscles.emplace_back(m, s.air, s.supply);
      muscles.back().fill(s.start.pressure, length(static_cast<int>(i), 0));
      shutters.emplace_back(m.inlet);
      shutters.emplace_back(m.exhaust);
    }
    find_sources();
  }
  ~State() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void find_sources() {
    using Kind = robot::Sensor::Kind;
    for (const robot::Sensor& s : setup.robot.sensors)
      source.push_back(s.kind == Kind::angle     ? robot::find_joint(setup.robot, s.of)
                       : s.kind == Kind::tension ? robot::find_muscle(setup.robot, s.of)
                                                 : -1);
  }

  void take_over() {
    for (std::size_t c = 0; c < 3; ++c) {
      end[c] = data->qpos[c];
      end_rate[c] = data->qvel[c];
    }
  }

  // Returns the coordinates at a share of the body step, by linear interpolation.
  double coordinate(std::size_t c, double share) const {
    return begin[c] + share * (end[c] - begin[c]);
  }
  double share_at(double tick) const {
    return (tick - static_cast<double>(at - at % steps.body)) / steps.body;
  }
  // Returns length [m] and rate [m/s] of muscle i at a share of the body step.
  double length(int i, double share) const {
    const auto joint = static_cast<std::size_t>(routes.joint[static_cast<std::size_t>(i)]);
    const double travel = coordinate(joint + 1, share) - setup.robot.joints[joint].rest_angle;
    return routes.mount[i] - routes.moment_arm[i] * travel;
  }
  double rate(int i) const {
    const auto joint = static_cast<std::size_t>(routes.joint[static_cast<std::size_t>(i)]);
    return -routes.moment_arm[i] * end_rate[joint + 1];
  }
  PowMuscle::Pull pull(int i, double share) const {
    const PowMuscle& m = muscles[static_cast<std::size_t>(i)];
    const double l = length(i, share);
    return m.pull(l, rate(i), m.pressure(l));
  }

  // Advances the body by one step with the current tensions of the muscles.
  void move_body() {
    begin = end;
    std::array<double, 3> torque{}, friction{};
    for (int j = 0; j < 2; ++j)
      friction[static_cast<std::size_t>(j) + 1] =
          setup.robot.joints[static_cast<std::size_t>(j)].dry_friction;
    for (int i = 0; i < routes.count; ++i) {
      const auto joint = static_cast<std::size_t>(routes.joint[static_cast<std::size_t>(i)]) + 1;
      const PowMuscle::Pull p = pull(i, 0);
      torque[joint] += routes.moment_arm[i] * p.tension;
      friction[joint] += std::fabs(routes.moment_arm[i]) * p.friction_bound;
    }
    for (const std::size_t c : {std::size_t{hip}, std::size_t{knee}}) {
      data->qfrc_applied[c] = torque[c];
      model->dof_frictionloss[c] = friction[c];
    }
    mj_step(model, data);
    take_over();
  }

  void move_muscles() {
    const double t = static_cast<double>(at) * signals::tick_seconds;
    std::array<double, 2 * robot::max_muscles> open{};
    for (std::size_t v = 0; v < shutters.size(); ++v) {
      shutters[v].advance(t + 0.5 * signals::tick_seconds);
      open[v] = shutters[v].fraction(t + 0.5 * signals::tick_seconds);
    }
    const double part = 1.0 / steps.muscle, h = part * signals::tick_seconds;
    for (int k = 0; k < steps.muscle; ++k) {
      const double from = static_cast<double>(at) + part * k;
      for (int i = 0; i < routes.count; ++i) {
        const auto v = static_cast<std::size_t>(2 * i);
        if (!(open[v] > 0) && !(open[v + 1] > 0)) continue;  // sealed: its mass is constant
        const PowMuscle::Lengths l{length(i, share_at(from)),
                                   length(i, share_at(from + 0.5 * part)),
                                   length(i, share_at(from + part))};
        muscles[v / 2].step(h, l, open[v], open[v + 1]);
      }
    }
  }

  // Advances through all ticks before `to`, and begins a body step there.
  void advance(Tick to) {
    for (;;) {
      if (at % steps.body == 0 && at != stepped) {
        move_body();
        stepped = at;
      }
      if (at >= to) return;
      move_muscles();
      ++at;
    }
  }
  Tick stepped = -1;  // beginning of the last body step
};

MujocoLeg::MujocoLeg(const plant::Setup& setup, const LegSteps& steps, Integrator integrator)
    : state_(std::make_unique<State>(setup, steps, integrator)) {}
MujocoLeg::~MujocoLeg() = default;

Status MujocoLeg::start(const signals::Scan& scan) noexcept {
  for (const signals::Conversion& c : scan.conversions)
    state_->lag[c.channel.index] = c.read - c.start;
  return Status::ok;
}

Status MujocoLeg::drive(signals::Edge edge) noexcept {
  State& s = *state_;
  const std::size_t v = edge.valve.index;
  if (v >= s.shutters.size()) return Status::invalid;
  s.advance(edge.at);
  const int i = static_cast<int>(v / 2);
  const air::Muscle& m = s.setup.muscles[v / 2];
  const double p = s.muscles[v / 2].pressure(s.length(i, s.share_at(static_cast<double>(s.at))));
  const double difference = v % 2 == 0 ? s.setup.supply.pressure - p : p - s.setup.air.atmosphere;
  s.shutters[v].electrical(static_cast<double>(edge.at) * signals::tick_seconds, edge.open,
                           gas::delay_at(v % 2 == 0 ? m.inlet : m.exhaust, edge.open, difference));
  return Status::ok;
}

signals::Reading MujocoLeg::read(signals::Channel channel, Tick now) noexcept {
  State& s = *state_;
  if (channel.index >= s.source.size()) return {0, Status::invalid};
  const Tick sampled = now - s.lag[channel.index];
  s.advance(sampled);
  const robot::Sensor& sensor = s.setup.robot.sensors[channel.index];
  const int of = s.source[channel.index];
  const double share = s.share_at(static_cast<double>(s.at));
  double value = 0;
  if (of >= 0 && sensor.kind == robot::Sensor::Kind::angle)
    value = s.coordinate(static_cast<std::size_t>(of) + 1, share) -
            s.setup.robot.joints[static_cast<std::size_t>(of)].rest_angle;
  else if (of >= 0)
    value = s.pull(of, share).tension;
  const double noise = sensor.noise > 0 ? robot::noise(s.setup.seed, channel.index, sampled) : 0.0;
  return {robot::counts(sensor, s.setup.robot.converter, value, noise), Status::ok};
}

Status MujocoLeg::stop(Tick) noexcept { return Status::ok; }

void MujocoLeg::place(const LegMotion& m) noexcept {
  mj_resetData(state_->model, state_->data);
  mjData& d = *state_->data;
  d.qpos[trolley] = m.x, d.qpos[hip] = m.hip, d.qpos[knee] = m.knee;
  d.qvel[trolley] = m.x_rate, d.qvel[hip] = m.hip_rate, d.qvel[knee] = m.knee_rate;
}
void MujocoLeg::step_body() noexcept { mj_step(state_->model, state_->data); }

LegMotion MujocoLeg::motion() const noexcept {
  const mjData& d = *state_->data;
  return {d.qpos[trolley], d.qvel[trolley], d.qpos[hip], d.qvel[hip], d.qpos[knee], d.qvel[knee]};
}
bool MujocoLeg::touches() const noexcept { return state_->data->ncon > 0; }

}  // namespace sinew::bench
