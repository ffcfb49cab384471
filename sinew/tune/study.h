// tune/study.h - a sweep as a file, so that a published table can be made again.
//
//   format     = "sinew.plan/1"
//   title      = "Largest angle gain against stiffness gain"
//   experiment = "../experiments/leg-in-air.toml"
//   vary       = ["joint.hip.stiffness_gain=0:13:5 %/(lbf in/rad)"]
//   largest    = "joint.hip.angle_gain=0.02:0.4:20 %/count"
//   where      = ["joints.hip.swing_oscillation_later_steps_rms_rad < 2 deg"]
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune {

struct Study {
  std::string title;
  std::string reproduces;
  std::string experiment;  // relative to the file
  std::vector<std::string> set, vary, where;
  std::vector<std::string> report;  // empty: what is reported of the experiment
  std::vector<std::string> range;   // sampled
  Sample::Kind sample = Sample::Kind::sobol;
  int points = 0, sample_seed = 1;  // of the sample
  std::string largest;              // empty: every point is one run
  int halvings = 6;
  int seeds = 0;  // 0: the experiment's own seed
  bool allow_unreachable = false;
  std::string units;  // of figures that name none (units/shown.h); empty: SI, or as reported
};

// What is said besides a plan: lists are added to the plan's, the others stand in place of its own
// where they are said.
struct Said {
  Study study;         // numbers above 0 and words that are not empty are said
  std::string sample;  // "sobol", "latin" or "random"; empty: not said
  std::optional<int> sample_seed, halvings;
};

// Throws config::Error with everything that is wrong with the file.
Study load_study(const std::string& path);

// Returns a plan, or the study of one run of an experiment, with what is said besides. Throws
// config::Error.
Study load_study(const std::string& path, const Said& said);

// Its words understood; the experiment is read where it says what is reported. Throws config::Error
// for words that cannot be, and for such an experiment that is wrong.
Sweep sweep_of(const Study&);

}  // namespace sinew::tune
