// analysis/verdict/band.h - within what ours agrees with what a source says: one rule, by the
// wording.
//
//   measured(30, 1)          a number that was read: half its last digit, or 5 % where that is more
//   percentage(94)           2 points, at most a quarter of it
//   about(90)                10 %
//   negligible(44)           under 5 % of the quantity's range, which is 44
//   noticeable(44)           said to be there, without how much: no less than negligible
//   small(44)                said to be small or slight: not substantial, under 20 % of it
//   substantial(44)          over 20 % of it
//   much_less(44), much_more(44)     by over 20 %
//   range(55, 60)            itself; at_least(60), at_most(5) have one end
//   computed(2.8363, 1e-4)   a number that a program printed: half its last digit
//   identity(15)           the same by definition: rounding, a billionth of the range
//   another(27, 33)          by none of these; whoever writes it says why
//
// A band is made before anybody looks at what ours is; docs/evidence/evidence.md has the rule and
// its reasons. Numbers may be in any unit, the band is in the same one. A reading error is of the
// source's own figure.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "sinew/config/reported.h"

namespace sinew::analysis {

using config::Wording;

// Both ends belong to it; an infinite one stands for none.
struct Band {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  Wording wording = Wording::another;

  bool holds(double value) const { return value >= lowest && value <= highest; }  // NaN: never
};

// Each returns the values that its wording allows, by the rule of rule_of().
Band measured(double value, double last_digit, double reading_error = 0);
Band percentage(double percents, double reading_error = 0);
Band about(double value, double reading_error = 0);
Band negligible(double of);   // of either sign
Band noticeable(double of);   // of > 0
Band small(double of);        // of either sign
Band substantial(double of);  // of > 0
Band much_less(double of);
Band much_more(double of);
Band range(double lowest, double highest);
Band at_least(double lowest);
Band at_most(double highest);
Band computed(double value, double last_digit);
Band identity(double of);
Band another(double lowest, double highest);

// "a measured number: half its last digit, or 5 % of it where that is more"
std::string_view rule_of(Wording wording);

// Spoken holds the numbers of a source's words: "55 to 60 in" gives 55, 60, "in"; "below 0.5" gives
// -inf, 0.5, ""; "0.035" gives 0.035 twice with 0.001 as its last digit. `found` is false without a
// number.
struct Spoken {
  bool found = false;
  double lowest = 0, highest = 0;
  double last_digit = 1;  // of the last number
  std::string unit;       // all that follows it
};
Spoken spoken(std::string_view words);

}  // namespace sinew::analysis
