// fmu/slave/variable.h - named values of a model that an importer can access.
#pragma once

#include <string>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::fmu {

// A variable's value reference is its index in the model's list, for all types. Index 0 is the
// time.
struct Variable {
  // Type of the value, and the origin of the value.
  enum class Type { real, integer, boolean };
  enum class Causality { time, parameter, input, output };

  std::string name;  // in the structured convention: "muscle.hip_flexor.tension"
  Type type = Type::real;
  Causality causality = Causality::parameter;
  std::string unit;  // SI, as in field tables; empty or "1": none
  double start = 0;  // start value of parameters and inputs
  double min = -units::unbounded, max = units::unbounded;
  std::string doc;                // one line
  std::vector<int> follows = {};  // outputs: indices of the inputs with direct feedthrough
  bool discrete = false;          // a real number that jumps and must not be interpolated
  int rate = 0;                   // inputs: index of their derivative, also an input; 0: none
};

// Returns the first variable.
inline Variable time_variable() {
  return {
      .name = "time", .causality = Variable::Causality::time, .unit = "s", .doc = "simulated time"};
}

// Return the standard's names: "parameter", "input", "output", "independent".
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

// Returns a name in the structured convention: words joined by dots, in single quotes if they are
// not identifiers. "/joint/hip/angle" becomes joint.hip.angle.
std::string structured(const std::string& channel);

}  // namespace sinew::fmu
