// fmu/muscle/muscle.h - a braided muscle with its valves, hose, leak and supply: length, rate and
// currents of the valves in, tension out. It is air::DrivenMuscle; the same steps give its bits.
//
// In a step the length runs straight from where it is to length + rate x step; a master that knows
// only where the muscle is now leaves the rate at 0, and the muscle follows a step late. Valves
// move at their own instants within the step, delays included.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fmu/slave/sheet.h"
#include "sinew/world/driven/driven_muscle.h"

namespace sinew::fmu {

// Says where a muscle starts.
struct MuscleStart {
  double length = 0;    // [m]
  double pressure = 0;  // of its air, absolute [Pa]
};

// Places of a muscle's valves among the inputs; 0: it has no such input.
struct ValvePlaces {
  std::size_t inlet = 0, exhaust = 0, set_point = 0;
};
// Adds the inputs that the valves of the muscle ask for; `prefix` is "" or "hip_flexor.".
ValvePlaces add_valves(Sheet& sheet, const air::Muscle& muscle, const std::string& prefix);

// Returns the kind of a muscle's inlet in a list of its parameters: it says which keys there are.
gas::Valve::Kind inlet_kind(const std::vector<Parameter>& list, const std::string& prefix);

// Remembers what was commanded last, so that a valve is told only of changes.
struct Commanded {
  double inlet = 0, exhaust = 0, set_point = 0;
};
// Tells the valves what the inputs say now, where that is new.
void command(air::DrivenMuscle& muscle, const Sheet& sheet, const ValvePlaces& at,
             Commanded& commanded) noexcept;

class Muscle {
 public:
  static constexpr std::string_view kind = "muscle";

  // Takes the model that the description tells of. Throws std::exception for what is wrong with it.
  explicit Muscle(const Description& description);
  // Returns what the exporter writes of a muscle.
  static Description describe(const air::Muscle& muscle, const gas::Air& air,
                              const gas::Supply& supply, const MuscleStart& start);

  // The variables, with the values of those that are set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  // Throws std::exception for parameters that do not go together, and for a length that it cannot
  // have.
  void begin();
  double output(std::size_t place) const;
  std::string wrong(double step) const;
  const char* advance(double end, double step) noexcept;
  double last() const noexcept { return units::unbounded; }

  // The model's own state as bytes, and back.
  std::vector<std::byte> save() const;
  void restore(std::span<const std::byte> saved);

 private:
  void place_variables(const std::vector<Parameter>& list, const MuscleStart& start);
  double length_after(double step) const {
    return sheet_.value(at_.length) + sheet_.value(at_.rate) * step;
  }

  struct Places {
    std::size_t length, rate, initial_pressure, tension, friction, pressure, gauge, mass, used;
    ValvePlaces valves;
  };

  Sheet sheet_;
  Places at_{};
  air::Muscle muscle_;
  gas::Air air_;
  gas::Supply supply_;
  std::optional<air::DrivenMuscle> driven_;
  Commanded commanded_;
};

}  // namespace sinew::fmu
