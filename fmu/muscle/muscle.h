// fmu/muscle/muscle.h - FMU model of a braided muscle with its valves, hose, leak and supply:
// length, rate and currents of the valves in, tension out. It uses air::DrivenMuscle; equal steps
// give results equal to the bit.
//
// During a step the length changes linearly to length + rate x step; a master that has only the
// present length leaves the rate at 0, and the muscle lags by a step. Valves switch at their own
// instants within the step, including their delays.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fmu/slave/sheet.h"
#include "sinew/world/driven/driven_muscle.h"

namespace sinew::fmu {

// Initial state of a muscle.
struct MuscleStart {
  double length = 0;    // [m]
  double pressure = 0;  // pressure of its air, absolute [Pa]
};

// Indices of the inputs of a muscle's valves; 0: no such input.
struct ValvePlaces {
  std::size_t inlet = 0, exhaust = 0, set_point = 0;
};
// Adds the inputs of the muscle's valves; `prefix` is "" or "hip_flexor.".
ValvePlaces add_valves(Sheet& sheet, const air::Muscle& muscle, const std::string& prefix);

// Returns the kind of a muscle's inlet in a list of its parameters, which determines its keys.
gas::Valve::Kind inlet_kind(const std::vector<Parameter>& list, const std::string& prefix);

// Last commands, so that only changes are passed to a valve.
struct Commanded {
  double inlet = 0, exhaust = 0, set_point = 0;
};
// Passes the inputs to the valves if they have changed.
void command(air::DrivenMuscle& muscle, const Sheet& sheet, const ValvePlaces& at,
             Commanded& commanded) noexcept;

class Muscle {
 public:
  static constexpr std::string_view kind = "muscle";

  // Builds the model of a description. Throws std::exception if the description is invalid.
  explicit Muscle(const Description& description);
  // Returns the description of a muscle.
  static Description describe(const air::Muscle& muscle, const gas::Air& air,
                              const gas::Supply& supply, const MuscleStart& start);

  // Return the variables, with the values that were set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  // Starts the model. Throws std::exception for parameters that contradict each other, and for an
  // impossible length.
  void begin();
  double output(std::size_t place) const;
  std::string refusal(double step) const;
  const char* advance(double end, double step) noexcept;
  double last() const noexcept { return units::unbounded; }

  // Save and restore the model's own state as bytes.
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
