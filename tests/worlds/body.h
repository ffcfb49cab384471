// tests/worlds/body.h - the interface between the worlds and the laws of this folder. A new world
// needs an adapter like those of planar.cpp and stand.cpp, no new law.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sinew/air/failure.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"

namespace sinew::worlds {

// A number of the truth, by kind: laws state their tolerances for these kinds.
enum class Kind { angle, place, rate, tension, pressure, mass, other };
struct Quantity {
  std::string name;
  Kind kind = Kind::other;
};

inline constexpr std::size_t most_quantities = 640;

// One closed balance of air: held(t) - held(0) = entered - left - leaked  [kg].
struct Account {
  std::string of;
  double held = 0, entered = 0, left = 0, leaked = 0;
};

class Body {
 public:
  virtual ~Body() = default;

  virtual signals::Port& port() = 0;
  virtual std::size_t channels() const = 0;

  virtual void advance(double t) = 0;  // commits every node up to t
  virtual double time() const = 0;     // of the last node [s]
  virtual std::int64_t nodes() const = 0;
  virtual air::Failure failure() const = 0;

  // The state at the last node and the commands since, as bytes; and a body that continues from it.
  virtual std::vector<std::byte> save() const = 0;
  virtual void restore(std::span<const std::byte> saved) = 0;

  // Names the quantities of the truth, and gives them at t. Takes no memory.
  virtual const std::vector<Quantity>& quantities() const = 0;
  virtual void truth(double t, std::span<double> out) = 0;

  // At a node.
  virtual std::vector<Account> air(double t) = 0;

  // Returns the energy of all moving parts, of springs and gravity, of the air and of the room air
  // that it displaces  [J].
  virtual double energy(double t) = 0;
};

// The changes that a law makes to a subject before it is made.
struct Variant {
  double step = 0;         // between nodes; 0: the subject's own [s]
  double pressure = 0;     // at the start, absolute; 0: the subject's own [Pa]
  bool displaced = false;  // starts away from its rest position
  bool smooth = false;     // no friction, no contact with the ground
  bool lossless = false;   // smooth; no damping; the braid does the virtual work of its pressure
};

// A valve or regulator that the random pattern drives.
struct Tap {
  std::uint8_t valve = 0;
  bool regulator = false;
};

// The limits for a subject. The defaults are those of a planar world; every other value is set
// where its subject is made, with the reason and the measured figure.
struct Limits {
  // A state extrapolated over a whole step against the node there, valves at random: the motion at
  // constant acceleration and Heun's rule for the air, both of the third order within the step.
  // Measured of legs: 1.9e-5 rad, 1.9e-6 m, 0.11 N, 520 Pa, 0.086 mg.
  double preview_angle = 2.2e-5;  // [rad]
  double preview_place = 2.2e-6;  // [m]
  double preview_tension = 0.13;  // [N]
  double preview_pressure = 600;  // [Pa]
  double preview_mass = 1e-7;     // [kg]

  // These apply with friction: the foot may touch the ground, or a joint come to rest, within the
  // step, and the gauge's share of the mesh's friction jumps at the node. Measured of legs: 5.2e-4
  // rad, 5.5e-5 m, 1.4 N.
  double rubbing_angle = 7e-4;   // [rad]
  double rubbing_place = 7e-5;   // [m]
  double rubbing_tension = 1.7;  // [N]

  // Mean of two halvings from 1 ms on, and the error there [rad] or [m]: sealed, then valves at
  // random. Valves reduce the order where a flow changes its law within a step: choked or not, and
  // linear at small differences. Measured: 4.0 to 4.3 and 9e-9; 2.4 to 4.5 and 4e-8.
  double order = 3.8, error = 1e-7;
  double driven_order = 2, driven_error = 1e-6;

  // Drift in a second over all energy  [-]. Measured: 4e-9.
  double energy = 1e-8;
};

struct Subject {
  std::string name;
  std::function<std::unique_ptr<Body>(const Variant&)> make;
  std::vector<Tap> taps;
  double step = 0;  // between nodes [s]

  // Closed loop with the real controller: every tick visited, extra observations per event. Empty:
  // there is no experiment of it.
  std::function<signals::Table(bool every_tick, int extra_readers)> run;

  bool conserves = false;  // sealed and without losses, its energy is constant
  Limits limits;
};

// Both kinds together.
const std::vector<Subject>& subjects();
std::vector<Subject> planar_subjects();
Limits planar_limits(const std::string& subject);
std::vector<Subject> stand_subjects();

}  // namespace sinew::worlds
