// identify/valve/fill.h - models of one filling or venting, and their fit.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/valve/chamber.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

struct Curve {
  std::vector<double> time, pressure;  // [s], [Pa abs]; the part that is fitted
  double start = 0, end = 0;           // before it moves, and settled value [Pa abs]
  double opening = 0;                  // approximate start of the motion [s]
  bool opening_seen = false;           // the record begins before the opening
  bool settled = true;                 // nearly constant at its end
  double rate = 0;                     // dP/dt between 15 and 50 % of the change [Pa/s]
  std::vector<std::string> notes;      // remarks on its preparation, for the report

  // Return whether the pressure rises, its change [Pa], and the share of the change at a pressure.
  bool fills() const { return end > start; }
  double range() const { return fills() ? end - start : start - end; }
  double share(double p) const { return (p - start) / (end - start); }
};

// Prepares the columns `time` and `pressure`. Throws Refusal if the pressure is constant, there are
// too few samples, the sensor clips the curve, or it reverses.
Curve curve_of(const Measured& data);

// A model of a filling chamber.
struct FillModel {
  std::string_view name, law, source;
  Chamber::Shape shape = Chamber::Shape::rigid;
  gas::Flow::Law flow = gas::Flow::Law::orifice;
  double exponent = 0;  // 0: fitted
  bool leak = false;
};

// Returns all models.
std::span<const FillModel> fill_models();

// Options of a fit of fillings.
inline const SolverOptions fill_options{
    .correlated = true, .most_steps = 60, .widest_interval = 0.25, .difference = 1e-3};

// Error below which all models are equally good, since no pressure sensor resolves it
// [% of the pressure's range].
inline constexpr double unresolved_error = 1e-3;

// A chamber, with the instant at which its valve opens, or the delays of a pulsed valve [s].
struct ValvedChamber : Chamber {
  double opening_instant = 0, opening_delay = 0, closing_delay = 0;
};

// A parameter and its place.
struct FreeValue {
  Parameter parameter;
  double ValvedChamber::*member;
};

// Returns the free parameters of a model, with start values from the curve.
std::vector<FreeValue> free_values(const FillModel& model, const Curve& curve,
                                   const ValveOptions& options);

// Returns the model of one filling; its first parameter is C/V. A value at a bound may be an
// artefact of the model, so the intervals of the others treat it as free. All arguments must live
// until the report is concluded.
Candidate fill_candidate(const FillModel& model, const Curve& curve, const ValveOptions& options);

// Returns the fits of the models to the curve, scored on every second tenth of its way unless
// another record scores them.
Report fill_contest(const Curve& curve, const ValveOptions& options,
                    std::span<const FillModel> models = fill_models(),
                    bool is_scored_elsewhere = false);

// Returns the predicted pressures at the times of the curve. Returns false if the values are not
// valid.
bool predict_fill(const FillModel& model, const Curve& curve, const ValveOptions& options,
                  std::span<const FreeValue> free, std::span<const double> values,
                  std::span<double> pressure);

// --- uncertainty of C/V from a filling, in addition to one model's interval ---
//
// All reports have a fit for each of fill_models(), whose first parameter is C/V, or C.

// Sums of squared residuals of a fit [Pa2].
struct FillSquares {
  double found = 0;
  double acceptable = 0;  // largest that is compatible with the best, at 95 %
};

// Returns the sums of each fit that was not refused, before the choice.
std::vector<FillSquares> squares_of(const Report& report);

constexpr double well_known = 0.25;  // half of the interval of C/V, relative to its value
// Returns half of an estimate's interval, relative to its value.
inline double half_of(const Estimate& e) { return 0.5 * (e.high - e.low) / e.value; }

// Throw Refusal for a curve that still moves at its end, and for one that no model fits.
void refuse_unsettled(const Measured& data, const Curve& curve, const ValveOptions& options);
void refuse_poor_fit(const Measured& data, const Report& report, double worst);

// Widens the intervals of free exponents to fixed exponents that fit as well as the best: a
// curve is strongly nonlinear in the exponent.
void reach_for_fixed(std::span<const FillSquares> squares, Report& report);

// Refuses models that leave C/V undetermined if another one fits the curve and determines it.
void refuse_undetermined_models(Report& report, double worst_fit);

// Widens the chosen model's intervals of its first `count` parameters to those of every model that
// the curve cannot distinguish from the best, or that fits no worse than the chosen one: the
// assumed chamber matters more than the noise. Returns the names of these models; of one parameter,
// those that widen its interval.
std::string reach_over_models(std::span<const FillSquares> squares, std::size_t count,
                              Report& report);

}  // namespace sinew::identify
