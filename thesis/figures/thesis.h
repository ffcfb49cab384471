// thesis/figures/thesis.h - the figures of Colbrunn (2000) as data, each with what the text says of
// it and whether ours shows it.
//
// A curve is computed (a law or a simulation, as the thesis drew it) or synthetic (in the place of
// a measurement that is lost: our stand with stated losses, transducers, noise and seed). What can
// be neither is named as missing. Verdicts are computed here, from the curves as they are drawn
// and from summaries of runs; docs/evidence/thesis-figures.md lists which bands are ours.
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

// Where the files of the project are, and what the laws are drawn with.
struct Sources {
  std::string root;
  actuator::Actuator actuator;  // robots/leg-as-printed, the gauge pressure in [30]
  gas::Air air;                 // chapter 3's
  gas::Valve chapter3;          // of the test stand
  gas::Valve inlet, exhaust;    // at the bench

  // Returns where a file of the project stands.
  std::string path(const std::string& file) const;
};

// Throws config::Error where root is no folder of the project.
Sources sources(const std::string& root);

// Returns how many steps gallery() has.
std::int64_t steps();

// Returns all figures in the order of the thesis, made step by step; `done` counts the steps.
// Throws config::Error where an experiment cannot be read.
report::Gallery gallery(const Sources&, std::atomic<std::int64_t>& done);

// Returns the number of statements of each verdict: for each figure, and for each class.
std::string text_of(const report::Gallery& gallery);

// Each returns the figures of a chapter, or of a part of it.
Exhibits chapter_2(const Sources&);
Exhibits valve_laws(const Sources&);    // 3-4, 3-13
Exhibits trapped_air(const Sources&);   // 3-6 to 3-11: a load let go with the air shut in
Exhibits pulsed_valve(const Sources&);  // 3-14 to 3-23
Exhibits chapter_4(const Sources&);
Exhibits chapter_5(const Sources&);
Exhibits chapter_6(const Sources&);         // 6-1, 6-3 to 6-11: test 1
Exhibits chapter_6_limits(const Sources&);  // 6-12 to 6-16
Exhibits chapter_7(const Sources&);

using report::StatementClass;

// Section collects the statements of one section, a number each; `because` says why ours differs.
class Section {
 public:
  // `where` is the section, as the claims name it.
  explicit Section(std::string where) : where_(std::move(where)) {}
  report::Claim number(StatementClass statement_class, const char* says, const char* theirs,
                       const char* quantity, double ours, const char* unit, report::Band accept,
                       const char* why = "", const char* because = "") const;

 private:
  std::string where_;
};

// Returns a verdict on a summary's key, its key in words where we have them.
report::Claim in_words(const analysis::Verdict& verdict);

// Returns "knee flexor" of knee_flexor.
std::string in_words(std::string name);

// Returns the points of a curve, to be measured.
inline report::Trace trace(const report::Curve& curve) { return {curve.xs, curve.ys}; }

}  // namespace sinew::thesis
