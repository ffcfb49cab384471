// tune/sensitivity.h - sensitivity of a figure to several ranges: designs of points to be run, and
// estimates from their figures. The functions are pure; sweep.h runs the points.
//
//   one at a time  each range from its middle to both ends, all others in their middle
//   morris         elementary effects along r paths on a grid of 4 levels, a step of 2/3 of a range
//                  in one range after the other (Morris 1991):
//                  mu* = mean |EE| (Campolongo 2007), sigma = standard deviation of EE
//   sobol          shares of the variance (Saltelli et al. 2010): V is the figure's variance,
//                  S_i   = (1/n) sum f(B) (f(AB_i) - f(A)) / V       of range i alone
//                  S_Ti  = (1/2n) sum (f(A) - f(AB_i))^2 / V         with all its interactions
//
// Symbols: d ranges; f a figure at a point; A, B: n points each, of 2 d Sobol's dimensions; AB_i: A
// with column i of B. Effects are in the figure's unit per whole range. Intervals are 95 %, by the
// bootstrap over paths or rows with a seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

// Methods of sensitivity analysis: each range alone; Morris's paths; Sobol's shares of the
// variance.
enum class Method { one_at_a_time, morris, sobol };

// Definition of the points.
struct Design {
  Method method = Method::sobol;
  std::size_t ranges = 0;  // d
  std::size_t count = 0;   // morris: paths r; sobol: rows n; one at a time: not used
  std::uint64_t seed = 1;
};

// Returns the design of "sobol", "morris" or "ends" (one at a time). A count of 0 is the usual one:
// 256 rows or 20 paths.
Design design_of(std::string_view method, std::size_t ranges, int count, int seed);

// Returns the number of points: 2 d + 1, r (d + 1), n (d + 2).
std::size_t size(const Design& design);

// Returns their shares of the ranges, d per point, in [0, 1]. They are the same on every computer.
std::vector<double> shares(const Design& design);

// A number with its 95 % interval; low = high = value without a bootstrap.
struct Estimate {
  double value = 0, low = 0, high = 0;
};

struct Effect {
  // one at a time: f(from) - f(middle), f(to) - f(middle)
  // morris: mu*, mu, sigma;  sobol: S_i, S_Ti
  Estimate to_low, to_high;
  Estimate mean_size, mean, spread;
  Estimate first, total;
};

struct Sensitivity {
  std::vector<Effect> effects;    // one per range
  double mean = 0, variance = 0;  // those of the figure over the design's own points (sobol: A and
                                  // B)
  std::size_t left_out = 0;       // paths or rows with a run that lacks the figure
};

// Returns the estimates from the figures of all points of a design, in its order. A figure that is
// not finite marks a run without it. Returns nothing if too few remain: one at a time requires the
// middle, the other methods two paths or rows; or if the figure never changes (sobol).
std::optional<Sensitivity> sensitivity(const Design& design, std::span<const double> figures);

// Sensitivity study: its sweep and its results, as rows and as JSON.
//
//   const Sweep runs = sweep_of(design, base);           // base.sample has the ranges
//   const std::vector<Row> rows = sweep(runs, {.threads = 2});
//   for (const FigureSensitivity& f : sensitivities(design, runs, rows)) ...

// Returns the sweep with the design's points in its ranges. Throws config::Error if the sweep
// varies or searches other keys too, reports nothing, or has more than most_points.
Sweep sweep_of(const Design& design, Sweep base);

struct FigureSensitivity {
  std::string figure;                // heading in the sweep, "trolley.distance [in]"
  std::optional<Sensitivity> found;  // empty: too few runs have the figure, or it never changes
};

// Returns the sensitivity of each reported figure, in the figure's unit. Requires all rows.
std::vector<FigureSensitivity> sensitivities(const Design& design, const Sweep& runs,
                                             const std::vector<Row>& rows);

// Return the table of all figures and ranges: the headings of its columns, and its rows. A figure
// without a result has rows with empty cells.
std::vector<std::string> sensitivity_headings(Method method);
std::vector<std::vector<std::string>> sensitivity_rows(const Design& design, const Sweep& runs,
                                                       const std::vector<FigureSensitivity>& all);

// Returns the same in format sinew.sensitivity/1, with mean, standard deviation and the number of
// omitted paths or rows.
std::string sensitivity_json(const Design& design, const Sweep& runs,
                             const std::vector<FigureSensitivity>& all);

// Results of a sensitivity study as text.

// Returns a line with the figure's mean and standard deviation, and a table with a line for each
// range, three digits and intervals; a single line if the figure has no result.
std::string text_of(const Design& design, const Sweep& runs, const FigureSensitivity& figure);

}  // namespace sinew::tune
