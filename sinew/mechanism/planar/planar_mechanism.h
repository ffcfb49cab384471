// mechanism/planar/planar_mechanism.h - parts that all planar mechanisms have in common for
// world/kernel/world.h.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/robot/sensing.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

// A sensor of a planar machine.
struct SensorSource {
  robot::SensorCounts counts;
  robot::Sensor::Kind kind = robot::Sensor::Kind::fixed;
  int of = -1;      // its joint or muscle; -1: none
  double rest = 0;  // rest angle of the joint [rad]
};

// Sensor readings of a planar machine, and its true values, from previews of world.h. Sources is a
// list of its sensors by channel.
template <class Sources>
class PlanarSensesOf {
 public:
  using Truth = plant::Truth;

  // Finds the joint or muscle of each sensor.
  explicit PlanarSensesOf(const Setup& setup)
      : atmosphere_(setup.air.atmosphere), seed_(setup.seed) {
    using Kind = robot::Sensor::Kind;
    const robot::Robot& robot = setup.robot;
    for (const robot::Sensor& sensor : robot.sensors) {
      const bool joint = sensor.kind == Kind::angle || sensor.kind == Kind::velocity;
      const int of =
          joint ? robot::find_joint(robot, sensor.of) : robot::find_muscle(robot, sensor.of);
      const double rest =
          joint && of >= 0 ? robot.joints[static_cast<std::size_t>(of)].rest_angle : 0.0;
      sensors_.push_back({robot::SensorCounts(sensor, robot.converter), sensor.kind, of, rest});
    }
  }

  // Returns the number of sensors.
  std::size_t channels() const noexcept { return sensors_.size(); }

  // Returns the quantity that the sensor measures at t, in SI; 0 for a fixed source.
  template <class World>
  double quantity(World& world, std::size_t index, double t) const noexcept {
    using Kind = robot::Sensor::Kind;
    const auto& [counts, kind, of, rest] = sensors_[index];
    if (kind == Kind::fixed || (of < 0 && kind != Kind::cylinder)) return 0;
    world.advance(t);
    const auto& mechanism = world.mechanism();
    const auto j = static_cast<std::size_t>(of < 0 ? 0 : of);
    if (kind == Kind::angle) return mechanism.joint_angle(world.preview_motion(t), j) - rest;
    if (kind == Kind::velocity) return mechanism.joint_rate(world.preview_motion(t), j);
    if (kind == Kind::cylinder) return mechanism.lift(world.preview_motion(t));
    const auto p = world.preview_muscle(t, of);
    const double gauged = p.evaluation.air.pressure[of] - atmosphere_;
    if (kind == Kind::pressure || !std::isfinite(gauged)) return gauged;  // also if not finite
    return gauge(world, p, of);
  }

  // Returns the counts of the converter for a value.
  std::uint16_t counts(std::size_t index, double value, signals::Tick sampled) const noexcept {
    const robot::SensorCounts& sensor = sensors_[index].counts;
    const auto channel = static_cast<std::uint8_t>(index);
    const double added_noise = sensor.noisy() ? robot::noise(seed_, channel, sampled) : 0.0;
    return sensor.counts(value, added_noise);
  }

  // Writes the true values at t; parts that the machine does not have stay as they are.
  template <class World>
  void truth(World& world, double t, Truth& out) const noexcept {
    const auto& mechanism = world.mechanism();
    const auto& air = world.air();
    const auto p = world.preview(t);

    out.torque = {};
    for (int i = 0; i < mechanism.muscles(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto account = air.account(p.state.air, i);
      out.tension[k] = gauge(world, p, i);
      out.pressure[k] = p.evaluation.air.pressure[i];
      out.length[k] = p.evaluation.ends.length[i];
      out.mass[k] = account.mass;
      out.air_in[k] = account.in;
      out.air_out[k] = account.out;
      out.air_leaked[k] = account.leak;
      mechanism.add_torque(p.evaluation.arms, i, out.tension[k], out.torque);
    }
    const auto supply = air.supply_state(p.state.air, p.evaluation.air);
    out.supply_pressure = supply.line;
    out.tank_pressure = supply.tank;
    out.air_past_tank = supply.past_tank;
    out.air_mass = air.total_mass(p.state.air, p.evaluation.ends.travel);
    for (int c = 0; c < 2; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const auto account = air.cylinder_account(p.state.air, c);
      out.cylinder_pressure[k] = air.cylinder_pressure(p.evaluation.air, c);
      out.cylinder_in[k] = account.in;
      out.cylinder_out[k] = account.out;
    }
    const auto& g = world.step_preview();
    mechanism.write_truth(p.state.motion, g.acceleration, g.held, world.load(), out);
  }

 private:
  // Returns the force on a gauge in the tendon [N]: the muscle's tension and its share of the
  // mesh's friction at its joint.
  template <class World, class Preview>
  double gauge(const World& world, const Preview& p, int muscle) const noexcept {
    const auto& mechanism = world.mechanism();
    const auto j = static_cast<std::size_t>(mechanism.joint(muscle));
    double f = p.evaluation.air.tension[muscle];
    const double friction_bound = world.friction_bound(muscle),
                 bound = world.bound(static_cast<int>(j));
    if (friction_bound > 0 && bound > 0) {
      const double share = world.step_preview().held[j] * friction_bound / bound;
      f += mechanism.arm(world.arms(), muscle) > 0 ? share : -share;
    }
    return f < 0 ? 0.0 : f;  // a NaN stays a NaN
  }

  Sources sensors_;
  double atmosphere_ = 0;  // [Pa]
  std::uint64_t seed_ = 1;
};

using PlanarSenses = PlanarSensesOf<std::vector<SensorSource>>;

// Common parts for at most M muscles.
template <int M>
struct PlanarMechanism {
  static constexpr bool cuts_steps = false;

  using Setup = plant::Setup;
  using Senses = PlanarSenses;
  using Ends = air::Ends<M>;

  // Return the air of a machine, air/network.h, and its state and memory at the start.
  template <class Air>
  static Air make_air(const Setup& s) {
    return Air(s.muscles, s.air, s.supply, s.cylinder, s.faults, s.steps.body);
  }
  template <class Air>
  static auto start_air(const Air& air, const Setup& s, const Ends& ends) {
    return air.initial(s.start.pressure, ends.length, s.start.lift);
  }
  template <class Air>
  static auto start_memory(const Air& air, const Setup& s, const Ends& ends) {
    return air.memory_at_rest(s.start.pressure, ends.length);
  }
};

}  // namespace sinew::plant
