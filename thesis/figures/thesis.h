// thesis/figures/thesis.h - figures of Colbrunn (2000) as data, each with the statements of the
// text and verdicts on our results.
//
// A curve is computed (a law or a simulation, as in the thesis) or synthetic (instead of a
// measurement that is lost: our simulated stand with stated losses, transducers, noise and seed).
// All others are listed as missing. Verdicts are computed here, from the curves as drawn and from
// summaries of runs; docs/evidence/thesis-figures.md lists the bands that we chose.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"
#include "sinew/report/figures/gallery.h"
#include "sinew/report/figures/measure.h"

namespace sinew::thesis {

using report::Exhibit;
using Exhibits = std::vector<Exhibit>;

// Folder of the project, and the parts whose laws are drawn.
struct Sources {
  std::string root;
  actuator::Actuator actuator;  // robots/leg-as-printed, with gauge pressure in [30]
  gas::Air air;                 // chapter 3
  gas::Valve chapter3;          // valve of the test stand
  gas::Valve inlet, exhaust;    // valves at the bench

  // Returns the path of a file of the project.
  std::string path(const std::string& file) const;
};

// Loads the sources. Throws config::Error if root is not the project's folder.
Sources sources(const std::string& root);

// Returns the number of steps of gallery().
std::int64_t steps();

// Returns all figures in the order of the thesis; `done` counts the steps. Throws config::Error if
// an experiment cannot be read.
report::Gallery gallery(const Sources&, std::atomic<std::int64_t>& done);

// Returns the number of statements of each verdict: for each figure, and for each class.
std::string text_of(const report::Gallery& gallery);

// Return the figures of a chapter, or of a part of it.
Exhibits chapter_1(const Sources&);
Exhibits chapter_2(const Sources&);
Exhibits weights(const Sources&);      // 2-8 to 2-12: weights on an actuator with its air sealed in
Exhibits valve_laws(const Sources&);   // 3-4, 3-13
Exhibits trapped_air(const Sources&);  // 3-6 to 3-11: a load released with the air sealed in
Exhibits pulsed_valve(const Sources&);  // 3-14 to 3-23
Exhibits chapter_4(const Sources&);
Exhibits chapter_5(const Sources&);
Exhibits chapter_6(const Sources&);         // 6-1, 6-3 to 6-11: test 1
Exhibits chapter_6_limits(const Sources&);  // 6-12 to 6-16
Exhibits chapter_7(const Sources&);

// Adds to 2-13 a run in which the stand stretches the actuator.
void add_length_sweep(const Sources&, Exhibit& figure_2_13);

using report::StatementClass;

// Creates the statements of one section, one number each; `because` explains a difference of ours.
class Section {
 public:
  // `where` is the section as named in the claims.
  explicit Section(std::string where) : where_(std::move(where)) {}
  report::Claim number(StatementClass statement_class, const std::string& says,
                       const std::string& reported, const std::string& quantity, double computed,
                       const std::string& unit, const report::Band& accept,
                       const std::string& why = "", const std::string& because = "") const;

 private:
  std::string where_;
};

// Returns a verdict on a summary's key, with the key's description if it has one.
report::Claim described_claim(const analysis::Verdict& verdict);

// Returns "knee flexor" for knee_flexor.
std::string spaced_name(std::string name);

// Returns the points of a curve, for measurements.
inline report::Trace trace(const report::Curve& curve) { return {curve.xs, curve.ys}; }

}  // namespace sinew::thesis
