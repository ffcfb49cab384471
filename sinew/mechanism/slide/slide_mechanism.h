// mechanism/slide/slide_mechanism.h - slide of the test stand: a load that hangs on a muscle or an
// air cylinder, or a prescribed length.
//
//   hanging   M L'' = M g + F_ext - F(L, L', P) - F_dry                           [36], [37]
//   driven    L(t) as prescribed: a tensile machine, or a clamp
//
//   L      length of the muscle, grows downwards [m]     F      of the muscle, both ends held [N]
//   M      hanging mass [kg]                             F_dry  dry friction, |F_dry| <= Q k, [33]
//
// With an air cylinder instead of the muscle L is the extension of its rod, and the pressure on the
// rod's side pulls the rod in. Air and prescribed pressure: stand_air.h.
//
// It is a mechanism for world/kernel/world.h and cuts steps at discontinuities:
//
//   the mesh comes to rest or breaks loose    at rest it holds while the load does not exceed
//                                             the bound, a true stick; in motion F_dry is at it
//   L passes L_max or L_min                   [31], [32] are discontinuous there; a stage beyond
//                                             uses the side on which the piece began
//   a schedule has a point
//
// So RK4 keeps its order through friction and end stops; docs/theory/test-stand.md has the
// convergence. With `stick = false` every stage uses the sign of the velocity as appendix A does:
// no cut, first order, and creep at rest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/slide/senses.h"
#include "sinew/mechanism/slide/setup.h"
#include "sinew/mechanism/slide/stand_air.h"
#include "sinew/units/stages.h"

namespace sinew::plant {

class SlideMechanism {
 public:
  static constexpr bool cuts_steps = true;

  using Scalar = double;
  using Setup = StandSetup;
  using Senses = StandSenses;
  using Ends = StandEnds;
  struct Arms {};  // the element is straight

  struct Motion {
    double length = 0, velocity = 0;  // [m], [m/s]
  };
  using Acceleration = double;  // [m/s^2]

  // Direction in which dry friction lets the load move; for a driven one, that of its last motion.
  enum class SlipDirection : signed char { rests = 0, down = 1, up = -1 };
  using Forces = SlipDirection;

  struct Pose {
    double mass = 0, pull = 0;  // M [kg]; M g + F_ext [N]
  };
  struct Load {
    double force = 0;       // force of the element without dry friction [N]
    double bound = 0;       // bound of the dry friction [N]
    double unbalanced = 0;  // M g + F_ext - force [N]
    double mass = 0;        // M [kg]
  };

  // Throws std::invalid_argument for an invalid setup.
  explicit SlideMechanism(const Setup& setup);

  // Return the setup, the motion at the start, and the longest step [s].
  const Setup& constants() const noexcept { return setup_; }
  const Motion& start() const noexcept { return start_; }
  double node_step(const Setup& setup) const noexcept { return setup.step; }
  // Makes the air of the stand, its state and its memory at the start.
  template <class Air>
  Air make_air(const Setup&) const {
    return Air(setup_);
  }
  // Returns the air's state at the start.
  template <class Air>
  typename Air::State start_air(const Air& air, const Setup&, const Ends&) const {
    Ends sealed = ends_at(setup_.start.length, 0.0);  // length of the seal, before the displacement
    return air.initial(setup_.start.pressure, sealed.length, sealed.travel);
  }
  // Returns the air's memory at the start.
  template <class Air>
  typename Air::Memory start_memory(const Air& air, const Setup&, const Ends&) const {
    return air.memory_at_rest(setup_.start.pressure, ends_at(setup_.start.length, 0.0).length);
  }

  // Returns a value that is not finite if the coordinate is not.
  double sum(const Motion& m) const noexcept { return m.length; }

  // Begins a smooth part: sets its prescribed values, and the side of the ends on which it is.
  void begin(double t, Motion& m) noexcept {
    if (!(t >= now_.begin && t < now_.end)) now_ = prescribed(t);
    if (driven_) {
      m.length = now_.length.at(t);
      m.velocity = now_.length.slope;
    }
    const int side = side_of(m.length);
    shortest_ = side == 0 ? -infinite : side == 1 ? ends_[0] : beyond_longest_;
    longest_ = side == 0 ? short_of_shortest_ : side == 1 ? ends_[1] : infinite;
  }
  double corner() const noexcept { return now_.end; }

  // Writes length and rate of the element, and its pressure if that is prescribed.
  void route(double t, const Motion& m, Ends& ends, Arms&) const noexcept {
    const double length = driven_ ? now_.length.at(t) : std::clamp(m.length, shortest_, longest_);
    put(ends, length, driven_ ? now_.length.slope : m.velocity);
    if (regulated_) ends.pressure = now_.pressure.at(t);
  }

  // Returns the moved mass at t, and the force that pulls it down.
  Pose pose(double t, const Motion&) const noexcept {
    const double mass = now_.mass.at(t);
    return {mass, mass * setup_.load.gravity + now_.force.at(t)};
  }

  // Computes the remaining force, and the bound of the dry friction.
  template <class Evaluation>
  void load(const Pose& at, const Motion&, const Arms&, const Evaluation& air,
            Load& out) const noexcept {
    out.force = cylinder_ ? air.cylinder_force : air.clamped[0];
    out.bound = cylinder_ ? 0.0 : air.friction_bound[0];
    out.unbalanced = at.pull - out.force;
    out.mass = at.mass;
  }

  // Returns the state of the friction: at its bound in motion; at rest it holds, or lets the load
  // move.
  SlipDirection hold(const Motion& m, const Load& load, SlipDirection last) const noexcept {
    if (driven_)
      return m.velocity > 0 ? SlipDirection::down : m.velocity < 0 ? SlipDirection::up : last;
    if (!has_dry_friction_ || last != SlipDirection::rests) return last;
    if (m.velocity != 0)
      return m.velocity > 0 ? SlipDirection::down : SlipDirection::up;  // started in motion
    if (!(std::fabs(load.unbalanced) > load.bound)) return SlipDirection::rests;
    return load.unbalanced > 0 ? SlipDirection::down : SlipDirection::up;
  }
  bool rests(SlipDirection held) const noexcept {
    return has_dry_friction_ && !driven_ && held == SlipDirection::rests;
  }
  double dry(const Load& load, SlipDirection held) const noexcept {  // friction on the load [N]
    return rests(held) ? std::clamp(load.unbalanced, -load.bound, load.bound)
                       : static_cast<double>(held) * load.bound;
  }

  // Returns the acceleration under the load and the friction [m/s^2].
  Acceleration accelerate(const Pose&, const Motion&, const Load& load,
                          SlipDirection held) const noexcept {
    if (driven_ || rests(held)) return 0;
    return (load.unbalanced - static_cast<double>(held) * load.bound) / load.mass;
  }

  // Returns whether the length is prescribed.
  bool driven() const noexcept { return driven_; }

  // Returns whether gap() has to be checked because of friction: at rest the load may break it
  // loose.
  bool needs_gap(SlipDirection held) const noexcept { return rests(held); }

  // Returns the distance of `after` beyond the limit of a smooth piece that starts at `before`:
  // above 0 if an end was passed [m], if the velocity reversed against the friction [m/s], or if
  // the load exceeds the friction [N].
  double gap(const Motion& before, const Motion& after, SlipDirection held,
             const Load& load) const noexcept {
    if (driven_) return -infinite;
    const int side = side_of(before.length);
    const double beyond = side == 0   ? after.length - ends_[0]
                          : side == 2 ? ends_[1] - after.length
                                      : std::max(after.length - ends_[1], ends_[0] - after.length);
    if (!has_dry_friction_) return beyond;
    const double broken = held == SlipDirection::rests
                              ? std::fabs(load.unbalanced) - load.bound
                              : -after.velocity * static_cast<double>(held);
    return std::max(beyond, broken);
  }
  double cut_within() const noexcept { return cut_within_; }

  // Brings the load to rest if it has reversed against its friction.
  void stop(Motion& m, SlipDirection& held) const noexcept {
    if (driven_ || !has_dry_friction_ || !(m.velocity * static_cast<double>(held) < 0)) return;
    m.velocity = 0;
    held = SlipDirection::rests;
  }

  // Returns the longest step for the oscillation of load and air [s].
  template <class Evaluation>
  double longest_piece(const Motion& m, const Load& load, const Evaluation& air) const noexcept {
    if (driven_) return infinite;
    const double pressure = cylinder_ ? air.cylinder_pressure[air::up] : air.pressure[0];
    return longest_swing_ / swinging_rate(m.length, pressure, load.mass);
  }

  // Writes `from` moved by h along the given rates and accelerations.
  void move(Motion& out, const Motion& from, double h, const Motion& rates,
            Acceleration a) const noexcept {
    out.length = from.length + h * rates.velocity;
    out.velocity = from.velocity + h * a;
  }

  // Applies RK4's weighted mean of four stages.
  void finish(Motion& now, double h, const Motion* const (&stage)[4],
              const Acceleration (&a)[4]) const noexcept {
    const units::StageMean mean(h);
    now.length += mean([&](int s) { return stage[s]->velocity; });
    now.velocity += mean([&](int s) { return a[s]; });
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  // Prescribed values, from one point of a schedule to the next.
  struct Prescribed {
    Schedule::Piece mass, force, length, pressure;
    double begin = 0, end = -infinite;  // [s]
  };

  Prescribed prescribed(double t) const noexcept;
  double swinging_rate(double length, double pressure, double mass) const noexcept;

  // Returns 0 below L_min, 1 between the ends, 2 beyond L_max.
  int side_of(double length) const noexcept {
    return length < ends_[0] ? 0 : length > ends_[1] ? 2 : 1;
  }
  void put(Ends& ends, double length, double rate) const noexcept {
    // In whole lanes: a wide load after narrow stores would stall.
    ends.length.four(0) = air::Four{length, length, length, length};
    ends.rate.four(0) = air::Four{rate, rate, rate, rate};
    if (!cylinder_) return;
    ends.travel = setup_.cylinder->stroke - length;
    ends.travel_rate = -rate;
  }
  Ends ends_at(double length, double rate) const noexcept {
    Ends ends;
    put(ends, length, rate);
    return ends;
  }

  StandSetup setup_;
  bool driven_ = false, regulated_ = false, cylinder_ = false;
  bool has_dry_friction_ = false;                      // dry friction with a real stick
  std::array<double, 2> ends_{};                       // L_min, L_max; infinite for a cylinder [m]
  double short_of_shortest_ = 0, beyond_longest_ = 0;  // the next numbers beyond them [m]
  double end_stiffness_ = 0, end_damping_ = 0;         // stiffer end [N/m], [N s/m]
  double exponent_ = 0;                                // exponent of sealed air [-]
  double longest_swing_ = 0;                           // longest angle of a piece [rad]
  double cut_within_ = 0;                              // [s]
  Motion start_;

  // Scratch for the current smooth part.
  Prescribed now_;
  double shortest_ = 0, longest_ = 0;  // lengths for which its law holds [m]
};

// Returns the static length at which the load hangs, with valves holding the start's pressure,
// without friction [m]. Throws std::invalid_argument if there is no such length.
double hanging_length(const StandSetup& setup);

}  // namespace sinew::plant
