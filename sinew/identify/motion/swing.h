// identify/motion/swing.h - one record of a free decay made ready to be compared with a trajectory.
//
// The trajectory begins an eighth of a period after the first turn, where the mass surely moves,
// and ends with the last one: where the mass sticks after it is an edge in the trajectory's
// parameters, at which a search stops short. What differs from record to record is fitted to each:
// length and speed at the beginning, an offset of the lengths, and a factor on the tension, by
// which the static model misses rest and period.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/least_squares.h"
#include "sinew/identify/motion/free_decay.h"
#include "sinew/identify/motion/turns.h"

namespace sinew::identify {

// A record and the stand that it comes from.
struct DecayRecord {
  Measured data;  // time, length, perhaps pressure
  Hanging stand;  // pressure, polytropic_exponent: NaN where the measured pressure gives them
  bool held_out = false;  // scored, but not fitted
};

// time, length, and pressure if there is one.
std::span<const Wanted> decay_columns();

class Swing {
 public:
  static constexpr std::size_t nuisances = 4;
  using Nuisance = std::array<double, nuisances>;

  // Throws Refusal where the record is no free decay, or not one of this mass on this actuator.
  explicit Swing(const DecayRecord& record);

  // Lengths under these losses; false where there are none.
  bool simulate(const actuator::Loss& loss, std::span<const double> nuisance,
                std::span<double> out) const;

  // start_length, start_velocity, offset, tension; `start` is where a fit begins.
  std::array<Parameter, nuisances> parameters(const Nuisance& start) const;

  // The nuisance with which these losses come nearest to the samples; from nowhere, or from near.
  Nuisance settle(const actuator::Loss& loss) const;
  Nuisance settle(const actuator::Loss& loss, const Nuisance& near) const;

  // Samples before `share` of the way from the beginning to the last turn.
  std::size_t samples_until(double share) const;

  // Of the sealed muscle at rest  [N/m].
  double stiffness() const;
  // Largest dry friction at rest under these losses  [N].
  double friction(const actuator::Loss& loss) const;

  std::string file;
  Hanging stand;
  Oscillation oscillation;
  double rest = 0;       // measured, or the center of the turns where the record ends before [m]
  double amplitude = 0;  // of the first half swing [m]
  double pressure_delay =
      std::numeric_limits<double>::quiet_NaN();  // of the measured pressure behind the length [s];
                                                 // NaN: none was used
  std::vector<double> time, length;
  std::vector<std::string> notes;

 private:
  void take_pressure(const Measured& data);
  void refuse_another_muscle() const;
  double tension_of_period() const;
  Nuisance first_guess() const;
  Nuisance nearest(const actuator::Loss& loss, const Nuisance& start, std::size_t count) const;
  Hanging scaled(double tension) const;
};

}  // namespace sinew::identify
