// identify/fit/wish.h - what somebody knows of parameters before the data are asked.
//
//   freeze   p = value                     no parameter any more
//   tie      p = q                         one parameter for both
//   prior    p = value +- deviation        one more residual, s sqrt(i) (p - value)/deviation
//
//   s, i     standard deviation of the residuals and the inflation of its variance
//   (least_squares.h),
//            from a fit without the prior
//
// So a prior weighs what an independent measurement with that standard deviation weighs. A wish for
// "delay" is one for "delay of a.csv" and "delay of b.csv" too, where these have none of their own.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

// Wishes as people write them.
struct WishTexts {
  std::vector<std::string> freeze;  // "viscous=3.5 N s/m"
  std::vector<std::string> prior;   // "viscous=3.5 N s/m ± 0.2 N s/m", or +- for ±
  std::vector<std::string> tie;     // "delay of b.csv=delay of a.csv"
};

// One of them. A value is a quantity in a unit of its own, or "0.3 SI" in the parameter's SI unit.
struct Wish {
  // A wish is a value that stays, one that is likely, or another parameter to be equal to.
  enum class Kind { freeze, prior, tie };
  Kind kind = Kind::freeze;
  std::string text;       // as it was written
  std::string name;       // of the parameter
  std::string value;      // of a tie: the other parameter's name
  std::string deviation;  // of a prior: its standard deviation
};

// What is wished of the parameters of a method, whichever of its laws has them.
class Wishes {
 public:
  Wishes() = default;
  // Throws config::Error for a text that is no wish, and for two of one parameter.
  explicit Wishes(const WishTexts& texts);

  // Throws config::Error where a wish names none of `all`, the parameters of all laws, or where its
  // value has another unit or lies outside the parameter's range.
  void check(std::span<const Parameter> all) const;

  // Returns the wish for the parameter: its own, else that of its kind; null: none.
  const Wish* of(std::string_view parameter) const;

  // Returns the same wishes, and that the parameter is frozen at the value [SI].
  Wishes with_frozen(const std::string& parameter, double value) const;

  bool empty() const { return all_.empty(); }

 private:
  std::vector<Wish> all_;
};

// The same as least_squares() without, where nothing is wished. Estimates, values and covariance
// are those of all parameters; frozen and tied ones have `free` = false. A wish for a parameter
// that is not there counts for nothing.
Solution least_squares(const Residuals& residuals, std::size_t count,
                       std::span<const Parameter> parameters, const Wishes& wishes,
                       const SolverOptions& options = {});

// Returns how many of the estimates were free.
std::size_t free_count(std::span<const Estimate> estimates);

}  // namespace sinew::identify
