// fmu/slave/sheet.h - list of a model's variables with their current values.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "fmu/slave/parameters.h"
#include "fmu/slave/variable.h"

namespace sinew::fmu {

class Sheet {
 public:
  // Starts with the time.
  Sheet() { add(time_variable()); }

  // Adds a variable and returns its index.
  std::size_t add(Variable variable) {
    values_.push_back(variable.start);
    variables_.push_back(std::move(variable));
    return variables_.size() - 1;
  }

  // Adds all numbers of the list as parameters, except those for which `hidden` returns true; words
  // keep their values.
  void add(const std::vector<Parameter>& list,
           const std::function<bool(const Parameter&)>& hidden = {}) {
    for (const Parameter& p : list) {
      parameters_.push_back({p, 0});
      if (p.kind == Parameter::Kind::word || (hidden && hidden(p))) continue;
      const bool whole = p.kind == Parameter::Kind::integer;
      parameters_.back().place =
          add({.name = p.name,
               .type = whole ? Variable::Type::integer : Variable::Type::real,
               .causality = Variable::Causality::parameter,
               .unit = p.unit,
               .start = p.number,
               .min = p.number < p.min ? p.number : p.min,  // a default of the code itself
               .max = p.number > p.max ? p.number : p.max,
               .doc = p.doc});
    }
  }

  // Returns the parameters with their current values.
  std::vector<Parameter> parameters() const {
    std::vector<Parameter> out;
    for (const Placed& p : parameters_) {
      out.push_back(p.parameter);
      if (p.place > 0) out.back().number = values_[p.place];
    }
    return out;
  }

  // Return the variables and the value at an index, as a number or as a boolean; set() changes it.
  const std::vector<Variable>& variables() const { return variables_; }
  double value(std::size_t place) const { return values_[place]; }
  bool on(std::size_t place) const { return values_[place] != 0; }
  void set(std::size_t place, double value) { values_[place] = value; }

  // Return all values by index; to_start() resets them to the start values.
  std::span<const double> values() const { return values_; }
  std::span<double> values() { return values_; }
  void to_start() {
    for (std::size_t k = 0; k < variables_.size(); ++k) values_[k] = variables_[k].start;
  }

 private:
  struct Placed {
    Parameter parameter;
    std::size_t place = 0;  // 0: not a variable
  };

  std::vector<Variable> variables_;
  std::vector<double> values_;
  std::vector<Placed> parameters_;
};

}  // namespace sinew::fmu
