// report/claim.h - what a source says of a figure, and whether ours shows it.
//
//   judge({.where = "4.3", .says = "the shutter opens in about half a millisecond",
//          .theirs = "0.5 ms", .quantity = "first dip of the current", .ours = 0.47, .unit = "ms",
//          .accept = {0.4, 0.6}, .why = "read from an oscilloscope, \"about\""})
//
// A verdict is always computed, from the curves as they are drawn or from a run's summary. What no
// number can settle says so and why. What ours was made with is met, and no evidence: such a claim
// is counted apart.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/reported.h"

namespace sinew::report {

using Is = analysis::Verdict::Is;

// Both ends belong to it; an infinite one stands for none.
struct Band {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

// A claim that a number answers.
struct Measured {
  std::string where;     // section or equation of the source
  std::string says;      // what it says, in our words
  std::string theirs;    // its number with the unit; empty where it gives none
  std::string quantity;  // what was taken from ours
  double ours = 0;
  std::string unit;  // of `ours` and `accept`; empty: a pure number
  Band accept;
  std::string why;      // the band is as it is
  std::string because;  // ours is known to differ; empty: it should agree
  bool put_in = false;  // ours was made with it, or fitted to it
};

// For people, and as it stands in the index.
struct Claim {
  std::string where, says, theirs, quantity;
  std::string ours;    // "0.47 ms"; empty where nothing is compared
  std::string accept;  // "0.4 to 0.6 ms", "at most 2 %"
  std::string why;     // the band, a difference that is known, or why nothing is compared
  Is verdict = Is::not_applicable;
  bool put_in = false;
};

// NaN differs.
Claim judge(const Measured& measured);

// What a number cannot settle, and why.
Claim not_comparable(std::string where, std::string says, std::string theirs, std::string why);

// A key of a summary that its experiment has judged (analysis/reported.h).
Claim claim(const analysis::Verdict& verdict);

// "agrees", "as put in", "differs", "differs, as known", "agrees after all", "not comparable".
std::string_view word(const Claim& claim);

struct Tally {
  int agree = 0, as_put_in = 0, differ = 0, differ_as_known = 0, not_comparable = 0;
};
int total(const Tally& tally);
void count(Tally& tally, const std::vector<Claim>& claims);

}  // namespace sinew::report
