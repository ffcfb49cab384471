// identify/fit/provenance.h - identified values as parameter files: each with its source and how
// far it can be trusted, as the origins that config::Writer prints.
#pragma once

#include <string>
#include <string_view>

#include "sinew/actuator/actuator.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

class Provenance {
 public:
  Provenance() = default;
  // What is not identified keeps the origin that it has in `file`.
  Provenance(config::Origins start, std::string_view file);

  // The value at `path` was fitted. Its uncertainty is half the 95 % interval, in its own unit; one
  // that is not identifiable says so in its source.
  void fitted(std::string_view path, const Estimate& estimate, std::string_view source);
  // One that has an uncertainty but was not fitted alone; NaN: none is known.
  void fitted(std::string_view path, std::string_view unit, double uncertainty,
              std::string_view source);
  // Taken over, assumed or guessed.
  void given(std::string_view path, std::string_view source);
  void guessed(std::string_view path, std::string_view source);

  // Returns where each value came from, as a file tells it.
  const config::Origins& origins() const { return origins_; }
  // Of keys that no origin names.
  const std::string& elsewhere() const { return elsewhere_; }

 private:
  config::Origin& put(std::string_view path);

  config::Origins origins_;
  std::string elsewhere_ = "where none stands: not identified, does nothing";
};

// Returns the number with so many significant digits at most: of an infinite one or none itself.
double with_digits(double number, int digits);

// Returns the actuator with ten digits of what an identification makes of it and four of how far
// forces lie from it. No measurement tells more, and a file would show the rest in whatever unit
// has a digit fewer (config/quantity.h).
actuator::Actuator without_idle_digits(actuator::Actuator actuator);

// A file of format sinew.actuator/1; paths begin with "actuator.<name>.".
std::string actuator_file(actuator::Actuator actuator, const Provenance& provenance);

// --- parameter files that are a part of a robot ---

// Returns the beginning of a robot's file at `out` that adds to the one at `base`; empty: to none.
// Throws config::Error where both are the same file.
config::Node robot_over(const std::string& base, const std::string& out);

}  // namespace sinew::identify
