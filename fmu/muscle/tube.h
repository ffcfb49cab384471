// fmu/muscle/tube.h - a braided muscle whose pressure somebody else knows: length, rate and gauge
// pressure in, tension out. It has no state; outputs follow the inputs at once.
//
//   F = tension of actuator/tension.h, [31] and [33] without dry friction, times the actuators in
//       parallel; a cord never pushes, so that F >= 0
//   friction = bound of the dry friction, [33], [34]: whoever integrates decides whether it sticks
//   stiffness = dF/dL at constant pressure with that of ends and bladder, [26]
//
// Valid where docs/theory/actuator.md says so; beyond possible lengths (muscle_fields.h) nothing is
// answered.
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

  // Takes the model that the description tells of. Throws std::exception for what is wrong with it.
  explicit Tube(const Description& description);
  // Returns what the exporter writes of an actuator.
  static Description describe(const actuator::Actuator& actuator, const gas::Air& air, int count,
                              double external_volume);

  // The variables, with the values of those that are set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  void begin();
  // Returns an output. Throws Discarded for a length that the actuator cannot have.
  double output(std::size_t place) const;
  // Nothing moves by itself.
  std::string wrong(double) const { return {}; }
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
  double external_volume_ = 0;  // per bundle [m3]
};

}  // namespace sinew::fmu
