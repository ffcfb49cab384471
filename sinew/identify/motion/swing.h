// identify/motion/swing.h - one record of a free decay, prepared for comparison with a trajectory.
//
// The trajectory begins an eighth of a period after the first turn, where the mass certainly moves,
// and ends with the last turn: sticking after it is a discontinuity in the parameters, at which a
// search would stop. These values are fitted to each record: initial length and speed, an offset of
// the lengths, and a factor on the tension that corrects rest and period of the static model.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/motion/free_decay.h"
#include "sinew/identify/motion/turns.h"

namespace sinew::identify {

// A record, with the stand on which it was measured.
struct DecayRecord {
  Measured data;          // time, length, and pressure if measured
  Hanging stand;          // pressure, polytropic_exponent: NaN to use the measured pressure
  bool held_out = false;  // scored, but not fitted
};

// Returns the columns: time, length, and pressure if present.
std::span<const ColumnSpec> decay_columns();

class Swing {
 public:
  static constexpr std::size_t nuisances = 4;
  using Nuisance = std::array<double, nuisances>;

  // Throws Refusal if the record is not a free decay, or not one of this mass on this actuator.
  explicit Swing(const DecayRecord& record);

  // Writes the lengths with these losses; returns false if the trajectory fails.
  bool simulate(const actuator::Loss& loss, std::span<const double> nuisance,
                std::span<double> out) const;

  // Returns the parameters start_length, start_velocity, offset, tension, with start values
  // `start`.
  std::array<Parameter, nuisances> parameters(const Nuisance& start) const;

  // Return the nuisance parameters that fit best with these losses; `near` is a start.
  Nuisance settle(const actuator::Loss& loss) const;
  Nuisance settle(const actuator::Loss& loss, const Nuisance& near) const;

  // Returns the number of samples before `share` of the time from the start to the last turn.
  std::size_t samples_until(double share) const;

  // Returns the stiffness of the sealed muscle at rest [N/m].
  double stiffness() const;
  // Returns the largest dry friction at rest with these losses [N].
  double friction(const actuator::Loss& loss) const;

  std::string file;
  Hanging stand;
  Oscillation oscillation;
  double rest = 0;       // measured, or center of the turns if the record ends before [m]
  double amplitude = 0;  // amplitude of the first half swing [m]
  double pressure_delay =
      std::numeric_limits<double>::quiet_NaN();  // pressure behind length [s]; NaN: not used
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
