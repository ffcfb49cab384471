// fmu/muscle/tube.h - FMU model of a braided muscle whose pressure is an input: length, rate and
// gauge pressure in, tension out. It has no state; outputs depend directly on the inputs.
//
//   F = tension of actuator/tension.h, [31] and [33] without dry friction, times the actuators in
//       parallel; a tendon cannot push, so that F >= 0
//   friction = bound of the dry friction, [33], [34]: the integrator decides whether it sticks
//   stiffness = dF/dL at constant pressure with that of ends and bladder, [26]
//
// The range of validity is in docs/theory/actuator.md; outputs at impossible lengths
// (muscle_fields.h) are refused.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fmu/slave/sheet.h"
#include "sinew/actuator/actuator.h"
#include "sinew/gas/air.h"

namespace sinew::fmu {

class Tube {
 public:
  static constexpr std::string_view kind = "tube";

  // Builds the model of a description. Throws std::exception if the description is invalid.
  explicit Tube(const Description& description);
  // Returns the description of an actuator.
  static Description describe(const actuator::Actuator& actuator, const gas::Air& air, int count,
                              double external_volume);

  // Return the variables, with the values that were set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  void begin();
  // Returns an output. Throws Discarded for an impossible length.
  double output(std::size_t place) const;
  // A tube is static: each step succeeds.
  std::string refusal(double) const { return {}; }
  const char* advance(double, double) noexcept { return nullptr; }
  double last() const noexcept { return units::unbounded; }

  // A tube has no state of its own.
  std::vector<std::byte> save() const { return {}; }
  void restore(std::span<const std::byte>) {}

 private:
  void place_variables(const std::vector<Parameter>& list);

  struct Places {
    std::size_t length, rate, pressure, tension, friction, stiffness, volume;
  };

  Sheet sheet_;
  Places at_{};
  actuator::Actuator actuator_;
  gas::Air air_;
  int count_ = 1;
  double external_volume_ = 0;  // volume per bundle [m3]
};

}  // namespace sinew::fmu
