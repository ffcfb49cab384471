// identify/fit/fit.h - what an identification found: every model that was tried, how well it fits
// what it saw and what it did not see, and which one was chosen by which rule.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/fit/evidence.h"
#include "sinew/identify/fit/least_squares.h"
#include "sinew/identify/fit/profile.h"
#include "sinew/identify/fit/score.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// A fit that can be made again with a parameter at another value.
struct Refit {
  FitProblem problem;
  Solution solution;
};

struct Fit {
  std::string model;   // its name, as the setting model takes it
  std::string law;     // "F = Eff(p) p b^2/(4 pi n^2) (3 L^2/b^2 - 1)"
  std::string source;  // of the law
  std::vector<Estimate> parameters;
  Score fit;
  std::optional<Score> held_out;
  // Parts of what was fitted, predicted by the rest; a method's own way, told in `notes`.
  std::optional<Score> cross_validated;
  // Errors of each kind of parts: pressures, lengths, muscles [%]; none: there is one kind. Each
  // kind has a scatter of its own in every law (a length that is a little off, say), so the choice
  // goes by their geometric mean, as the likelihood of unknown scatters does.
  std::vector<double> kinds;
  // The ends of the data, predicted by what lies between them. It has no part in the choice: a
  // law that ends badly may be the best one where it is used.
  std::optional<Score> extrapolated;
  // Half-widths about the model at every row; absent: not told, or by Report::curves.
  std::optional<Band> band;
  std::vector<double> residuals;       // predicted - measured, of Report::rows; empty: unknown
  std::vector<std::string> notes;      // remarks about this fit
  std::string refused;                 // why this model cannot be had from the data; empty: it can
  std::string not_chosen;              // why it is shown and not chosen: a parameter at its bound
  std::shared_ptr<const Refit> again;  // until the choice; empty: it has no profiles
};

// What was measured, for a picture of it: the report's quantity at another one.
struct Rows {
  std::string x, x_unit;             // "pressure", "Pa gauge"
  std::string unit;                  // of what was measured; empty: Report::unit
  std::vector<double> at, measured;  // [x_unit], [unit]
  std::vector<std::string> group;    // of each row: "205 mm"; empty: all are one
  std::vector<int> order;            // of each row its group's place; empty: as they come
  std::vector<bool> held_out;        // of each row; empty: none is
  std::vector<bool> venting;         // of each row, drawn as a triangle; empty: none is

  // More than x and the group changes from row to row: no curve leads through them.
  bool scattered = false;

  std::size_t size() const { return at.size(); }
};

// Models of one quantity beside each other, and which one was chosen.
struct Report {
  std::string subject;        // "static model of DMSP-10-250"
  std::string title;          // of its page, in words; empty: the subject
  std::string quantity;       // what the residuals are: "force"
  std::string unit;           // and their SI unit
  double full_scale = 0;      // what 100 % is, in `unit`
  std::string full_scale_is;  // "the largest force measured"
  std::string held_out_is;    // "every second pressure"; empty where nothing was held out
  std::vector<Fit> fits;
  std::size_t chosen = 0;
  std::string rule;  // by which it was chosen, with the numbers that decided
  Rows rows;
  std::vector<PredictedCurve> curves;  // of the chosen one; empty: its intervals are not known
  std::vector<Omitted> left_out;       // by reason
  std::vector<ErrorBy> errors;         // of the chosen one, over all rows
  std::vector<Further> further;        // of each muscle that a plan can be made for
  std::vector<std::string> notes, warnings;
  std::vector<std::string> unseen;  // what such data cannot show: "how fast the valve switches"

  // Returns the chosen one.
  const Fit& best() const { return fits[chosen]; }
};

// The simplest model (fewest free parameters) whose cross-validated error - without one the
// held-out error, without that its fit - is within `tolerance` (relative) of the smallest, or
// within `negligible` [%]: errors below it say nothing, for instance the converter's steps. Where
// there are kinds of parts, it is within the tolerance of that model in each of them as well: what
// is simpler must not cost one kind what it gains in another. Refused
// models do not count, those with a reason not to be chosen only where no other is left, which is
// warned of. Writes `chosen` and `rule`, which tells how close the next ones are. Throws Refusal
// where every model was refused.
void choose(Report& report, double tolerance = 0.1, double negligible = 0);

// Chooses, and adds what every method reports of its choice: profiles of the parameters, and errors
// by group where the rows have groups and the method has no errors of its own.
void conclude(Report& report, double tolerance = 0.1, double negligible = 0);

// Returns the parameters of the chosen law that the data do not pin, by name.
std::vector<std::string> not_pinned(const Report& report);

// Returns what the report does not show, as a list: the method's own, then what follows from the
// profiles, from what was left out, from the rows and from the other laws.
std::vector<std::string> does_not_show(const Report& report);

// Writes into `not_chosen` which of the fit's parameters stand at the bounds of their ranges, but
// for those that are named: there the law is not the one that its name says, or the data know
// nothing of it.
void keep_off_bounds(Fit& fit, std::span<const std::string_view> but_for = {});

// Throws Refusal if the chosen model leaves a larger error than that where it was fitted: then the
// data are of something else, or not what their columns say.
void refuse_unexplained(const Report& report, double percent, const std::string& try_this);

// --- a report for programs ---

// Returns format sinew.identification/1: the report with its models, and the chosen one once more
// where a program looks first. Values are in the units that stand beside them; what is not known,
// as the interval of a value at its bound, is null.
Json to_json(const Report& report);

// Returns the value, or null where it is not finite: JSON has no infinity.
Json finite_or_null(double value);

}  // namespace sinew::identify
