// identify/contest/fit.h - result of an identification: every model that was tried, its errors on
// fitted and on left-out data, the choice with its rule, and additional parts of the report.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/contest/profile.h"
#include "sinew/identify/contest/score.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// A fit that can be repeated with a parameter held at another value.
struct Refit {
  FitProblem problem;
  Solution solution;
};

struct Fit {
  std::string model;   // name, as in the setting `model`
  std::string law;     // "F = Eff(p) p b^2/(4 pi n^2) (3 L^2/b^2 - 1)"
  std::string source;  // source of the law
  std::vector<Estimate> parameters;
  Score fit;
  std::optional<Score> held_out;
  // Error of parts of the fitted data, each predicted from the rest; `notes` describe the parts.
  std::optional<Score> cross_validated;
  // Errors of each kind of parts: pressures, lengths, muscles [%]; empty: one kind. Each kind has
  // its own scatter in every law (a small length error, for instance), so the choice uses the
  // geometric mean, which corresponds to the likelihood with unknown scatters.
  std::vector<double> kinds;
  // Error at the ends of the data, predicted from what lies between. It does not affect the choice:
  // a law with large errors there may be the best one where it is used.
  std::optional<Score> extrapolated;
  // Half-widths about the model at every row; empty: unknown, or given by Report::curves.
  std::optional<Band> band;
  std::vector<double> residuals;   // predicted - measured, for Report::rows; empty: unknown
  std::vector<std::string> notes;  // remarks about this fit
  std::string refused;             // why the data cannot give this model; empty: fitted
  std::string not_chosen;          // why it is shown but not chosen, e.g. a parameter at its bound
  std::shared_ptr<const Refit> refit;  // until the choice; null: no profiles

  // Returns the estimate of this name; null if the law does not have it.
  const Estimate* estimate(std::string_view name) const;
};

// Chosen model along one group of rows, also between and beyond them: its value, and the
// half-widths that contain 68 and 95 % of measured values; not finite if unknown.
struct PredictedCurve {
  std::string group;
  std::vector<double> at, value, half_68, half_95;  // as in Rows
};

// A measurement that was left out of every fit, with its probable cause if known.
struct OmittedRow {
  double at = 0, measured = 0;  // as in Rows
  std::string group;
  std::string why;  // e.g. "1/10 of what the law has: a slipped decimal?"
};

// Measurements left out for one reason.
struct Omitted {
  std::string reason;            // e.g. "pressure still moving"
  std::string criterion;         // criterion that recognised them
  std::size_t count = 0;         // number left out
  std::vector<OmittedRow> rows;  // all of them, or an even selection
};

// A mount to measure, its pressures, and the errors expected afterwards.
struct FurtherMount {
  double length = 0;              // [m]
  std::vector<double> pressures;  // gauge, rising then falling [Pa]
  std::size_t readings = 0;
  double time = 0;           // for this mount and those before [s]
  double rms = 0, half = 0;  // root mean square, and half-width of 95 % at the worst place [%]
};

// Further measurements of one muscle, the most useful first.
struct Further {
  std::string of;            // e.g. "the muscle of 225 mm"; empty: a single muscle
  std::size_t readings = 0;  // existing readings
  double rms = 0, half = 0;  // expected before the first mount [%]
  std::vector<FurtherMount> mounts;
  std::string note;  // assumptions
};

// Measured data as shown in a figure: the report's quantity over another one.
struct Rows {
  std::string x, x_unit;             // "pressure", "Pa gauge"
  std::string unit;                  // unit of `measured`; empty: Report::unit
  std::vector<double> at, measured;  // [x_unit], [unit]
  std::vector<std::string> group;    // group of each row, e.g. "205 mm"; empty: one group
  std::vector<int> order;            // rank of each row's group; empty: order of the rows
  std::vector<bool> held_out;        // for each row; empty: none
  std::vector<bool> venting;         // for each row, drawn as a triangle; empty: none

  // Other quantities than x and the group vary from row to row, so no curve connects the rows.
  bool scattered = false;

  std::size_t size() const { return at.size(); }
  // Appends rows of one group.
  void add(std::span<const double> more_at, std::span<const double> more_measured,
           const std::string& name);
};

// Models of one quantity in comparison, and the chosen one.
struct Report {
  std::string subject;        // e.g. "static model of DMSP-10-250"
  std::string title;          // title of its page; empty: the subject
  std::string quantity;       // quantity of the residuals, e.g. "force"
  std::string unit;           // SI unit of the quantity
  double full_scale = 0;      // value of 100 %, in `unit`
  std::string full_scale_is;  // e.g. "the largest force measured"
  std::string held_out_is;    // e.g. "every second pressure"; empty: nothing was held out
  std::vector<Fit> fits;
  std::size_t chosen = 0;
  std::string rule;  // rule of the choice, with the values that decided
  Rows rows;
  std::vector<PredictedCurve> curves;  // chosen model; empty: its intervals are unknown
  std::vector<Omitted> left_out;       // one entry per reason
  std::vector<ErrorBy> errors;         // chosen model, over all rows
  std::vector<Further> further;        // for each muscle that can be planned
  std::vector<std::string> notes, warnings;
  std::vector<std::string> not_shown;  // not shown by such data, e.g. "how fast the valve switches"

  // Sets the subject, the quantity of the residuals with its unit, and the value of 100 % in words.
  void set_subject(std::string of, std::string what, std::string what_unit, std::string whole) {
    subject = std::move(of);
    quantity = std::move(what);
    unit = std::move(what_unit);
    full_scale_is = std::move(whole);
  }

  // Returns the chosen fit.
  const Fit& best() const { return fits[chosen]; }
};

// Chooses the model with the fewest free parameters among those whose error is within `tolerance`
// (relative) of the smallest or below `negligible` [%], an error without significance such as a
// converter's step. The error is the cross-validated one, else the held-out one, else that of the
// fit. If there are kinds of parts, the model must also be within the tolerance of the best one
// for each kind, so that a simpler model does not trade one kind for another. Refused models are
// excluded; those with a reason not to be chosen are used only if no other is left, with a warning.
// Writes `chosen` and `rule`, which includes the errors of the next models. Throws Refusal if every
// model was refused.
void choose(Report& report, double tolerance = 0.1, double negligible = 0);

// Chooses, and adds the common parts of a report: profiles of the parameters, and errors by group
// if the rows have groups and the method has no errors of its own.
void conclude(Report& report, double tolerance = 0.1, double negligible = 0);

// Returns the error by which choose() compares a fit that may be chosen [%].
double choice_error(const Report& report, const Fit& fit);

// Returns the names of the chosen law's parameters that the data do not pin.
std::vector<std::string> not_pinned(const Report& report);

// Returns a list of what the report does not show: the method's own items, then those that
// follow from the profiles, the omitted rows, the rows and the other laws.
std::vector<std::string> does_not_show(const Report& report);

// Writes into `not_chosen` which parameters of the fit are at the bounds of their ranges, except
// those named in `but_for`: at a bound the law degenerates to another one, or the data do not
// determine the parameter.
void keep_off_bounds(Fit& fit, std::span<const std::string_view> but_for = {});

// Throws Refusal if the error of the chosen model on its fitted data exceeds `percent`: then the
// data are of something else, or the columns are mislabelled.
void refuse_unexplained(const Report& report, double percent, const std::string& try_this);

// --- a report for programs ---

// Returns the report in format sinew.identification/1: all models, and the chosen one again at
// top level. Values are in the stated units; unknown ones, such as the interval of a value at its
// bound, are null.
Json to_json(const Report& report);

// Returns the value, or null if it is not finite: JSON has no infinity.
Json finite_or_null(double value);

}  // namespace sinew::identify
