// identify/contest/constraint.h - constraints and priors of parameters that are known before the
// fit.
//
//   freeze   p = value                     not a free parameter
//   tie      p = q                         one parameter for both
//   prior    p = value +- deviation        one more residual, s sqrt(i) (p - value)/deviation
//
//   s, i     standard deviation of the residuals and the inflation of its variance
//            (least_squares.h), from a fit without the prior
//
// So a prior weighs as much as an independent measurement with that standard deviation. A
// constraint on "delay" also applies to "delay of a.csv" and "delay of b.csv", unless these have
// their own.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/contest/least_squares.h"

namespace sinew::identify {

// Constraints as users write them.
struct ConstraintTexts {
  std::vector<std::string> freeze;  // "viscous=3.5 N s/m"
  std::vector<std::string> prior;   // "viscous=3.5 N s/m ± 0.2 N s/m", or +- for ±
  std::vector<std::string> tie;     // "delay of b.csv=delay of a.csv"
};

// One constraint. A value is a quantity with its unit, or "0.3 SI" in the parameter's SI unit.
struct Constraint {
  // A fixed value, a prior, or equality with another parameter.
  enum class Kind { freeze, prior, tie };
  Kind kind = Kind::freeze;
  std::string text;       // original text
  std::string name;       // name of the parameter
  std::string value;      // for a tie: the other parameter's name
  std::string deviation;  // for a prior: its standard deviation
  bool at_bound = false;  // for a freeze: the data push against this value (bounds.h)
};

// Constraints on the parameters of a method, for all of its laws.
class Constraints {
 public:
  Constraints() = default;
  // Throws config::Error for a text that is not a constraint, and for two of one parameter.
  explicit Constraints(const ConstraintTexts& texts);

  // Throws config::Error if a constraint names none of `all`, the parameters of all laws, or if its
  // value has another unit or is outside the parameter's range.
  void check(std::span<const Parameter> all) const;

  // Returns the constraint on the parameter: its own, else that of its kind; null: none.
  const Constraint* of(std::string_view parameter) const;

  // Returns the same constraints with the parameter frozen at the value [SI]; `at_bound`: as the
  // data push against it.
  Constraints with_frozen(const std::string& parameter, double value, bool at_bound = false) const;

  bool empty() const { return all_.empty(); }

 private:
  std::vector<Constraint> all_;
};

// Minimises the residuals under constraints. Estimates, values and covariance are those of all
// parameters; frozen and tied ones have `free` = false. A constraint on a parameter that does not
// exist is ignored.
Solution least_squares(const Residuals& residuals, std::size_t count,
                       std::span<const Parameter> parameters, const Constraints& constraints,
                       const SolverOptions& options = {});

// Returns the number of free estimates.
std::size_t free_count(std::span<const Estimate> estimates);

}  // namespace sinew::identify
