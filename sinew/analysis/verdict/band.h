// analysis/verdict/band.h - band of values that agree with a source's statement, by its wording.
//
//   measured(30, 1)          a number that was read: half its last digit, or 5 % if that is more
//   percentage(94)           2 points, at most a quarter of the value
//   about(90)                10 %
//   negligible(44)           under 5 % of the quantity's range, which is 44
//   noticeable(44)           present, without an amount: no less than negligible
//   small(44)                small or slight: not substantial, under 20 % of the range
//   substantial(44)          over 20 % of the range
//   much_less(44), much_more(44)     by over 20 %
//   range(55, 60)            itself; at_least(60), at_most(5) have one end
//   computed(2.8363, 1e-4)   a number that a program printed: half its last digit
//   identity(15)             the same by definition: rounding, a billionth of the range
//   another(27, 33)          by none of these rules; its author gives the reason
//
// A band is fixed before the result of the run is known; docs/evidence/evidence.md has the rule and
// its reasons. Numbers may be in any unit, the band is in the same one. A reading error is the
// uncertainty of a figure read from the source.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "sinew/config/reported.h"

namespace sinew::analysis {

using config::Wording;

// Both ends belong to the band; a missing one is infinite.
struct Band {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  Wording wording = Wording::another;

  bool holds(double value) const { return value >= lowest && value <= highest; }  // NaN: never
};

// Return the band of a wording, by the rule of rule_of().
Band measured(double value, double last_digit, double reading_error = 0);
Band percentage(double percents, double reading_error = 0);
Band about(double value, double reading_error = 0);
Band negligible(double of);   // any sign
Band noticeable(double of);   // requires of > 0
Band small(double of);        // any sign
Band substantial(double of);  // requires of > 0
Band much_less(double of);
Band much_more(double of);
Band range(double lowest, double highest);
Band at_least(double lowest);
Band at_most(double highest);
Band computed(double value, double last_digit);
Band identity(double of);
Band another(double lowest, double highest);

// Returns the rule in words, for example "a percentage: 2 points, at most a quarter of the number".
std::string_view rule_of(Wording wording);

// The numbers of a source's text: "55 to 60 in" gives 55, 60, "in"; "below 0.5" gives -inf, 0.5,
// ""; "0.035" gives 0.035 twice with 0.001 as its last digit. `found` is false without a number.
struct QuotedNumber {
  bool found = false;
  double lowest = 0, highest = 0;
  double last_digit = 1;  // place value of the last number's last digit
  std::string unit;       // text after the last number
};
QuotedNumber quoted_number(std::string_view words);

}  // namespace sinew::analysis
