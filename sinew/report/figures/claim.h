// report/figures/claim.h - what a source says of a figure, and whether ours shows it.
//
//   judge(StatementClass::put_in,
//         {.where = "4.3", .says = "the shutter opens in about half a millisecond",
//          .theirs = "0.5 ms", .quantity = "first dip of the current", .ours = 0.47, .unit = "ms",
//          .accept = analysis::about(0.5)})
//
// A verdict is always computed, from the curves as they are drawn or from a run's summary. What no
// number can settle says so and why. Its class says what agreement is worth, its band follows from
// the wording (analysis/verdict/band.h); docs/evidence/evidence.md defines both.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/verdict/band.h"
#include "sinew/analysis/verdict/reported.h"

namespace sinew::report {

using Is = analysis::Verdict::Is;

using analysis::Band;
using config::StatementClass;

// A claim that a number answers.
struct Measured {
  std::string where;     // section or equation of the source
  std::string says;      // what it says, in our words
  std::string theirs;    // its number with the unit; empty where it gives none
  std::string quantity;  // what was taken from ours
  double ours = 0;
  std::string unit;  // of `ours` and `accept`; empty: a pure number
  Band accept;
  std::string why;      // a band by no rule is as it is; else what is to be known of the comparison
  std::string because;  // ours is known to differ; empty: it should agree
};

// For people, and as it stands in the index.
struct Claim {
  std::string where, says, theirs, quantity;
  std::string ours;    // "0.47 ms"; empty where nothing is compared
  std::string accept;  // "0.4 to 0.6 ms", "at most 2 %"
  std::string why;     // the band, a difference that is known, or why nothing is compared
  Is verdict = Is::not_applicable;
  StatementClass statement_class = StatementClass::none;  // none: nothing is compared
  analysis::Wording wording = analysis::Wording::another;
};

// NaN differs. Throws std::logic_error for a band by no rule without its reason.
Claim judge(StatementClass statement_class, const Measured& measured);

// What a number cannot settle, and why.
Claim not_applicable(std::string where, std::string says, std::string theirs, std::string why);

// A key of a summary that its experiment has judged (analysis/verdict/reported.h).
Claim claim(const analysis::Verdict& verdict);

// Statements by class and verdict.
class Tally {
 public:
  // Counts one statement.
  void add(StatementClass statement_class, Is verdict) {
    ++count_[row(statement_class)][row(verdict)];
  }
  // Returns how many there are of that class and verdict, of either alone, or at all.
  int of(StatementClass statement_class, Is verdict) const {
    return count_[row(statement_class)][row(verdict)];
  }
  int of(Is verdict) const;
  int of(StatementClass statement_class) const;
  int total() const;

 private:
  template <class Enum>
  static std::size_t row(Enum value) {
    return static_cast<std::size_t>(value);
  }
  std::array<std::array<int, 5>, 6> count_{};
};
// Counts the statements of claims.
void count(Tally& tally, const std::vector<Claim>& claims);

// In the order of tables, `none` last among the classes.
inline constexpr std::array<StatementClass, 6> all_classes = {StatementClass::predicted,
                                                              StatementClass::fitted,
                                                              StatementClass::put_in,
                                                              StatementClass::by_construction,
                                                              StatementClass::code_against_code,
                                                              StatementClass::none};
inline constexpr std::array<Is, 5> all_verdicts = {Is::agrees, Is::differs, Is::differs_as_known,
                                                   Is::agrees_after_all, Is::not_applicable};

}  // namespace sinew::report
