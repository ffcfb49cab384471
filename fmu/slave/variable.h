// fmu/slave/variable.h - what an importer sees of a model: its named values.
#pragma once

#include <string>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::fmu {

// A variable's place in the model's list is its value reference, whatever its type. Place 0 is the
// time.
struct Variable {
  // The type of its value, and who gives it one.
  enum class Type { real, integer, boolean };
  enum class Causality { time, parameter, input, output };

  std::string name;  // in the structured convention: "muscle.hip_flexor.tension"
  Type type = Type::real;
  Causality causality = Causality::parameter;
  std::string unit;  // SI, as field tables write it; empty or "1": none
  double start = 0;  // of parameters and inputs
  double min = -units::unbounded, max = units::unbounded;
  std::string doc;                // one line
  std::vector<int> follows = {};  // outputs: the inputs that they follow at once, by place
  bool discrete = false;          // a real number that jumps: nobody should interpolate it
  int rate = 0;                   // inputs: the place of their derivative, also an input; 0: none
};

// Returns the variable that stands first.
inline Variable time_variable() {
  return {
      .name = "time", .causality = Variable::Causality::time, .unit = "s", .doc = "simulated time"};
}

// Returns what the standard calls it: "parameter", "input", "output", "independent".
inline const char* word(Variable::Causality causality) {
  using C = Variable::Causality;
  if (causality == C::time) return "independent";
  if (causality == C::parameter) return "parameter";
  return causality == C::input ? "input" : "output";
}
inline const char* word(Variable::Type type) {
  using T = Variable::Type;
  return type == T::real ? "real" : type == T::integer ? "integer" : "boolean";
}

// Returns a name in the structured convention: words joined by dots, with what is no identifier in
// single quotes. "/joint/hip/angle" is joint.hip.angle.
std::string structured(const std::string& channel);

}  // namespace sinew::fmu
