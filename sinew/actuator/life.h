// actuator/life.h - number of cycles until an actuator fails, as a range.
//
//   N(Delta) = f N_ref (Delta/Delta_ref)^-m                  Basquin's power law
//   D = sum n_i/N(Delta_i)                                   Palmgren and Miner's sum
//   S = exp(-k sum n_i/N(Delta_i)) = exp(-k D)               failures at a constant rate
//
//   N      mean number of cycles until one actuator fails [-]
//   Delta  range of contraction within a cycle, of the length L_max [-]
//   m      exponent [-]     f  factor of another bladder [-]     n_i  number of cycles [-]
//   D      failures to be expected of one actuator [-]     S  probability that none of k fails [-]
//
// N_ref, m and f are known as ranges, and so is every result: a lower bound that is unknown is 0,
// an upper one infinite, and neither takes part in a number. The numbers are those of the
// actuator's file; no m is published for such muscles. docs/theory/actuator.md has the evidence.
//
// Assumed: cycles of different sizes do harm independently of their order (Palmgren and Miner);
// actuators fail independently of each other and of their age (the rate is constant), so that wear,
// after which many fail together, is not modelled. No law of the pressure is published: a higher
// pressure than the reference's is taken to shorten life, and a lower one to extend it, by an
// unknown amount.
#pragma once

#include <cmath>
#include <limits>

#include "sinew/actuator/actuator.h"

namespace sinew::actuator {

// A range of a positive number; 0 and infinity where a bound is unknown.
struct Bounds {
  double least = 0, most = std::numeric_limits<double>::infinity();
};

// Returns whether the actuator's life is known in any way.
constexpr bool has_life(const Life& life) { return life.cycles_over > 0 || life.cycles_under > 0; }

// Returns N for cycles of this range of contraction with this largest gauge pressure [-]; without a
// pressure, for the reference's. Cycles without contraction do no harm.
inline Bounds cycles_of_life(const Life& life, double contraction,
                             double gauge_pressure = std::numeric_limits<double>::quiet_NaN()) {
  Bounds out;
  if (!has_life(life)) return out;
  if (!(contraction > 0)) return {.least = out.most, .most = out.most};
  const double share = contraction / life.contraction;
  const double steep = std::pow(share, -life.exponent_most);
  const double flat = std::pow(share, -life.exponent_least);
  const bool larger = share > 1;
  out.least = life.factor_least * life.cycles_over * (larger ? steep : flat);
  if (life.cycles_under > 0)
    out.most = life.factor_most * life.cycles_under * (larger ? flat : steep);
  const bool scaled = std::abs(share - 1) > 1e-9;
  if (scaled && !(life.exponent_most > 0))
    (larger ? out.least : out.most) = larger ? 0 : Bounds().most;
  if (life.pressure > 0 && gauge_pressure > life.pressure) out.least = 0;
  if (life.pressure > 0 && gauge_pressure < life.pressure) out.most = Bounds().most;
  return out;
}

// Adds the damage of cycles of this life to D; it begins with {0, 0}.
inline void add_damage(Bounds& damage, const Bounds& life, double cycles) {
  if (!(cycles > 0)) return;
  damage.least += cycles / life.most;
  damage.most += cycles / life.least;
}

// Returns the time until the mean number of cycles is reached [s]: a share `duty` of the time there
// are `frequency` cycles per second [1/s].
constexpr Bounds time_of_life(const Bounds& life, double frequency, double duty = 1) {
  return {life.least / (frequency * duty), life.most / (frequency * duty)};
}

// Returns the probability that none of `actuators` fails within `cycles` of each [-].
inline Bounds survival(const Bounds& life, double actuators, double cycles) {
  Bounds damage{0, 0};
  add_damage(damage, life, actuators * cycles);
  return {std::exp(-damage.most), std::exp(-damage.least)};
}

// Returns N from failures that were counted over `cycles` of all actuators together [-], each
// replaced: the interval that contains the true mean with at least this probability, exact for
// failures at a constant rate (Garwood 1936). Without a failure there is no upper bound.
Bounds life_from_failures(int failures, double cycles, double probability = 0.95);

}  // namespace sinew::actuator
