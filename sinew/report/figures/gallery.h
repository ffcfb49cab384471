// report/figures/gallery.h - page of figures with the source's statements about them: index.html
// and index.json.
//
// The page is in the folder of the pictures and needs neither a network nor a program. It works
// without its script, which only filters the figures. The same figures give the same bytes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sinew/analysis/verdict/band.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/json/json.h"
#include "sinew/report/figures/figure.h"

namespace sinew::report {

// Statements of a source about a figure, and whether the computed figure agrees with them.
//
//   judge(StatementClass::put_in,
//         {.where = "4.3", .says = "the shutter opens in about half a millisecond",
//          .theirs = "0.5 ms", .quantity = "first dip of the current", .ours = 0.47, .unit = "ms",
//          .accept = analysis::about(0.5)})
//
// A verdict is always computed, from the drawn curves or from a run's summary. A statement that no
// number can decide has no verdict and a reason. Its class is the strength of the evidence, its
// band follows from the wording (analysis/verdict/band.h); docs/evidence/evidence.md defines both.

using Agreement = analysis::Verdict::Agreement;

using analysis::Band;
using config::StatementClass;

// A statement that a number decides.
struct Measured {
  std::string where;     // section or equation of the source
  std::string says;      // the statement, paraphrased
  std::string reported;  // the source's number with its unit; empty if the source has only words
  std::string quantity;  // quantity taken from the computed figure
  double computed = 0;
  std::string unit;  // unit of `computed` and `accept`; empty: a pure number
  Band accept;
  std::string why;      // reason of a band that follows no rule, or a remark
  std::string because;  // reason of a known difference; empty if it should agree
};

// A statement with its verdict as text, as in the index.
struct Claim {
  std::string where, says, reported, quantity;
  std::string computed;  // "0.47 ms"; empty if nothing is compared
  std::string accept;    // "0.4 to 0.6 ms", "at most 2 %"
  std::string why;       // reason of the band, of a known difference, or of the missing comparison
  Agreement verdict = Agreement::not_applicable;
  StatementClass statement_class = StatementClass::none;  // none if nothing is compared
  analysis::Wording wording = analysis::Wording::another;
};

// Judges a statement; NaN differs. Throws std::logic_error for a band that follows no rule and has
// no reason.
Claim judge(StatementClass statement_class, const Measured& measured);

// Returns a statement that a number cannot decide, with the reason.
Claim not_applicable(std::string where, std::string says, std::string reported, std::string why);

// Converts the verdict on a key of a summary (analysis/verdict/reported.h).
Claim claim(const analysis::Verdict& verdict);

// Counts of statements by class and verdict.
class Tally {
 public:
  // Counts one statement.
  void add(StatementClass statement_class, Agreement verdict) {
    ++count_[row(statement_class)][row(verdict)];
  }
  // Return the number of statements of a class and verdict, of either alone, or in total.
  int of(StatementClass statement_class, Agreement verdict) const {
    return count_[row(statement_class)][row(verdict)];
  }
  int of(Agreement verdict) const;
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

// Classes and verdicts in the order of tables.
inline constexpr std::array<StatementClass, 6> all_classes = {StatementClass::predicted,
                                                              StatementClass::fitted,
                                                              StatementClass::put_in,
                                                              StatementClass::by_construction,
                                                              StatementClass::code_against_code,
                                                              StatementClass::none};
inline constexpr std::array<Agreement, 5> all_verdicts = {
    Agreement::agrees, Agreement::differs, Agreement::differs_as_known,
    Agreement::agrees_unexpectedly, Agreement::not_applicable};

// A figure and the statements about it.
struct Exhibit {
  Figure figure;
  std::vector<Claim> claims;
};

struct Gallery {
  std::string title;   // "Figures of Colbrunn (2000)"
  std::string lead;    // one paragraph below the title
  std::string prefix;  // before a figure's name: "Figure "
  std::vector<Exhibit> exhibits;
  std::vector<std::string> pictures = {};  // endings of the files that were drawn, the first is
                                           // shown: "svg", "png"; empty: links to the data alone
  bool scripts = false;                    // <figure>.gp exist
};

// Returns the page with all figures.
std::string index_html(const Gallery& gallery);

// Returns "sinew.figures/1": figures with their curves, files and missing parts, claims with class
// and verdict, and the number of each.
std::string index_json(const Gallery& gallery);

// Returns a table of such figures: name, title and number of curves.
std::string text_of_figures(const Json& figures);

// Counts the statements of all figures.
Tally tally(const Gallery& gallery);

}  // namespace sinew::report
