// mechanism/slide/slide_mechanism.h - the test stand's slide: what hangs on a muscle or an air
// cylinder, or is moved by a machine.
//
//   hanging   M L'' = M g + F_ext - F(L, L', P) - F_dry                           [36], [37]
//   driven    L(t) as prescribed: a tensile machine, or a clamp
//
//   L      length of the muscle, grows downwards [m]     F      of the muscle, both ends held [N]
//   M      hanging mass [kg]                             F_dry  dry friction, |F_dry| <= Q k, [33]
//
// With an air cylinder in the muscle's place L is how far its rod is out, and it pulls as the
// pressure on the rod's side pushes it in. The air, and what prescribes its pressure: stand_air.h.
//
// One of the mechanisms of world/kernel/world.h; it cuts steps where something breaks off:
//
//   the mesh comes to rest or breaks loose    at rest it holds while the load asks for no more than
//                                             the bound, a real stick; in motion F_dry is at it
//   L passes L_max or L_min                   [31], [32] break off there; a stage that oversteps
//                                             goes by the side on which the piece began
//   a schedule has a point
//
// So the order of RK4 is kept through friction and end stops; docs/theory/test-stand.md has how far
// it has converged. With `stick = false` the sign of the speed is taken in every stage as appendix
// A does: no cut, first order, and creep at rest.
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
  struct Arms {};  // the element pulls straight

  struct Motion {
    double length = 0, velocity = 0;  // [m], [m/s]
  };
  using Acceleration = double;  // [m/s^2]

  // Which way dry friction lets the load move; of a driven one, its last motion.
  enum class Way : signed char { rests = 0, down = 1, up = -1 };
  using Forces = Way;

  struct Pose {
    double mass = 0, pull = 0;  // M [kg]; M g + F_ext [N]
  };
  struct Load {
    double force = 0;  // of the element, dry friction apart [N]
    double bound = 0;  // of the dry friction [N]
    double asks = 0;   // M g + F_ext - force [N]
    double mass = 0;   // M [kg]
  };

  // Throws std::invalid_argument for a set-up that is no stand.
  explicit SlideMechanism(const Setup& setup);

  // Returns what it was made from, how it starts, and the longest step  [s].
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
    Ends sealed = ends_at(setup_.start.length, 0.0);  // there, and displaced afterwards
    return air.initial(setup_.start.pressure, sealed.length, sealed.travel);
  }
  // Returns the air's memory at the start.
  template <class Air>
  typename Air::Memory start_memory(const Air& air, const Setup&, const Ends&) const {
    return air.memory_at_rest(setup_.start.pressure, ends_at(setup_.start.length, 0.0).length);
  }

  // A number that is none where the coordinate is none.
  double sum(const Motion& m) const noexcept { return m.length; }

  // A smooth part begins: what is prescribed for it, and the side of the ends on which it is.
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

  // Says how long the element is, and how fast that changes; and its pressure where that is
  // prescribed.
  void route(double t, const Motion& m, Ends& ends, Arms&) const noexcept {
    const double length = driven_ ? now_.length.at(t) : std::clamp(m.length, shortest_, longest_);
    put(ends, length, driven_ ? now_.length.slope : m.velocity);
    if (regulated_) ends.pressure = now_.pressure.at(t);
  }

  // Returns the mass that is moved at t, and what pulls it down.
  Pose pose(double t, const Motion&) const noexcept {
    const double mass = now_.mass.at(t);
    return {mass, mass * setup_.load.gravity + now_.force.at(t)};
  }

  // Works out the force that is left, and the bound of the dry friction.
  template <class Answer>
  void load(const Pose& at, const Motion&, const Arms&, const Answer& air,
            Load& out) const noexcept {
    out.force = cylinder_ ? air.cylinder_force : air.clamped[0];
    out.bound = cylinder_ ? 0.0 : air.friction_bound[0];
    out.asks = at.pull - out.force;
    out.mass = at.mass;
  }

  // In motion friction is at its bound; a mass at rest is held, or begins to move.
  Way hold(const Motion& m, const Load& load, Way last) const noexcept {
    if (driven_) return m.velocity > 0 ? Way::down : m.velocity < 0 ? Way::up : last;
    if (!rubs_ || last != Way::rests) return last;
    if (m.velocity != 0) return m.velocity > 0 ? Way::down : Way::up;  // let go in motion
    if (!(std::fabs(load.asks) > load.bound)) return Way::rests;
    return load.asks > 0 ? Way::down : Way::up;
  }
  bool rests(Way held) const noexcept { return rubs_ && !driven_ && held == Way::rests; }
  double dry(const Load& load, Way held) const noexcept {  // friction on the load [N]
    return rests(held) ? std::clamp(load.asks, -load.bound, load.bound)
                       : static_cast<double>(held) * load.bound;
  }

  // Returns the acceleration under the load and the friction that is held  [m/s^2].
  Acceleration accelerate(const Pose&, const Motion&, const Load& load, Way held) const noexcept {
    if (driven_ || rests(held)) return 0;
    return (load.asks - static_cast<double>(held) * load.bound) / load.mass;
  }

  // Is the element moved by a machine?
  bool driven() const noexcept { return driven_; }

  // At rest the load is what may break it.
  bool watches(Way held) const noexcept { return rests(held); }

  // Returns how far `after` is beyond what a smooth piece from `before` can hold: above 0 where an
  // end was passed [m], where the speed turned against the friction [m/s], or where the load asks
  // for more than the friction holds [N].
  double gap(const Motion& before, const Motion& after, Way held, const Load& load) const noexcept {
    if (driven_) return -infinite;
    const int side = side_of(before.length);
    const double beyond = side == 0   ? after.length - ends_[0]
                          : side == 2 ? ends_[1] - after.length
                                      : std::max(after.length - ends_[1], ends_[0] - after.length);
    if (!rubs_) return beyond;
    const double broken = held == Way::rests ? std::fabs(load.asks) - load.bound
                                             : -after.velocity * static_cast<double>(held);
    return std::max(beyond, broken);
  }
  double cut_within() const noexcept { return cut_within_; }

  // Lets what has turned back against its friction rest.
  void stop(Motion& m, Way& held) const noexcept {
    if (driven_ || !rubs_ || !(m.velocity * static_cast<double>(held) < 0)) return;
    m.velocity = 0;
    held = Way::rests;
  }

  // Returns the longest step that suits the swing of load and air there  [s].
  template <class Answer>
  double longest_piece(const Motion& m, const Load& load, const Answer& air) const noexcept {
    if (driven_) return infinite;
    const double pressure = cylinder_ ? air.cylinder_pressure[air::up] : air.pressure[0];
    return longest_swing_ / swinging_rate(m.length, pressure, load.mass);
  }

  // `from`, h along the given rates and accelerations.
  void move(Motion& out, const Motion& from, double h, const Motion& rates,
            Acceleration a) const noexcept {
    out.length = from.length + h * rates.velocity;
    out.velocity = from.velocity + h * a;
  }

  // RK4's weighted mean of four stages.
  void finish(Motion& now, double h, const Motion* const (&stage)[4],
              const Acceleration (&a)[4]) const noexcept {
    const units::StageMean mean(h);
    now.length += mean([&](int s) { return stage[s]->velocity; });
    now.velocity += mean([&](int s) { return a[s]; });
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  // Holds what is prescribed, from one point of a schedule to the next.
  struct Prescribed {
    Schedule::Piece mass, force, length, pressure;
    double begin = 0, end = -infinite;  // [s]
  };

  Prescribed prescribed(double t) const noexcept;
  double swinging_rate(double length, double pressure, double mass) const noexcept;

  // 0 short of L_min, 1 between the ends, 2 beyond L_max.
  int side_of(double length) const noexcept {
    return length < ends_[0] ? 0 : length > ends_[1] ? 2 : 1;
  }
  void put(Ends& ends, double length, double rate) const noexcept {
    // In whole lanes: a wide load would have to wait for narrow stores.
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
  bool rubs_ = false;                                  // dry friction with a real stick
  std::array<double, 2> ends_{};                       // L_min, L_max; an air cylinder has none [m]
  double short_of_shortest_ = 0, beyond_longest_ = 0;  // the next numbers beyond them [m]
  double end_stiffness_ = 0, end_damping_ = 0;         // of the stiffer end [N/m], [N s/m]
  double exponent_ = 0;                                // of air that is shut in [-]
  double longest_swing_ = 0;                           // of a piece [rad]
  double cut_within_ = 0;                              // [s]
  Motion start_;

  // Scratch: of the smooth part at hand.
  Prescribed now_;
  double shortest_ = 0, longest_ = 0;  // lengths whose law holds on it [m]
};

// Static length at which the load hangs, valves holding the start's pressure, without friction [m].
// Throws std::invalid_argument where there is none.
double hanging_length(const StandSetup& setup);

}  // namespace sinew::plant
