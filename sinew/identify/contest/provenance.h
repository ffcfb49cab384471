// identify/contest/provenance.h - identified values as parameter files, each with its source and
// uncertainty as the origins that config::Writer prints.
#pragma once

#include <string>
#include <string_view>

#include "sinew/actuator/actuator.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/identify/contest/least_squares.h"

namespace sinew::identify {

class Provenance {
 public:
  Provenance() = default;
  // Starts from the origins of `file`, which remain for values that are not identified.
  Provenance(config::Origins start, std::string_view file);

  // Records a fitted value at `path`. Its uncertainty is half the 95 % interval, in its own unit;
  // the source of an unidentifiable value states that.
  void fitted(std::string_view path, const Estimate& estimate, std::string_view source);
  // Records a fitted value, or one that is `given` if the law does not have it (null).
  void fitted(std::string_view path, const Estimate* estimate, std::string_view source,
              std::string_view given);
  // Records a value with an uncertainty that was not fitted alone; NaN: unknown uncertainty.
  void fitted(std::string_view path, std::string_view unit, double uncertainty,
              std::string_view source);
  // Record a value that was taken from elsewhere, or guessed.
  void given(std::string_view path, std::string_view source);
  void guessed(std::string_view path, std::string_view source);

  // Returns the origin of each value, as a file states it.
  const config::Origins& origins() const { return origins_; }
  // Returns the source of keys without an origin.
  const std::string& elsewhere() const { return elsewhere_; }

 private:
  config::Origin& put(std::string_view path);

  config::Origins origins_;
  std::string elsewhere_ = "keys without a source of their own: not identified, without effect";
};

// Returns the actuator with ten digits of identified values and four of prediction errors.
// Measurements do not justify more, and a file would print the rest in whichever unit has a digit
// fewer (units/quantity.h).
actuator::Actuator without_idle_digits(actuator::Actuator actuator);

// Gives the actuator ends, which no measurement at rest shows: as stiff as in the thesis. `reason`
// is that of the length of the long end [m].
void guess_ends(double long_end, std::string_view reason, actuator::Actuator& actuator,
                Provenance& provenance);

// Returns a file of format sinew.actuator/1; paths begin with "actuator.<name>.".
std::string actuator_file(actuator::Actuator actuator, const Provenance& provenance);

// --- parameter files that are part of a robot ---

// Returns the beginning of a robot's file at `out` that extends the one at `base`, if not empty.
// Throws config::Error if both are the same file.
config::Node robot_over(const std::string& base, const std::string& out);

}  // namespace sinew::identify
