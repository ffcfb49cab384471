// tune/study.h - a sweep as a file, so that a published table can be reproduced.
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
  std::vector<std::string> report;  // empty: the experiment's reported figures
  std::vector<std::string> range;   // sampled ranges
  Sample::Kind sample = Sample::Kind::sobol;
  int points = 0, sample_seed = 1;  // those of the sample
  std::string largest;              // empty: every point is one run
  int halvings = 6;
  int seeds = 0;  // 0: the experiment's own seed
  bool allow_unreachable = false;
  std::string units;   // for figures without a unit (units/shown.h); empty: SI, or as reported
  Places places = {};  // places of a plan's values, for messages
};

// Settings given in addition to a plan: lists are appended to the plan's, the others override it if
// they are given.
struct StudyOptions {
  Study study;         // numbers above 0 and non-empty texts are given
  std::string sample;  // "sobol", "latin" or "random"; empty: not given
  std::optional<int> sample_seed, halvings;
};

// Throws config::Error with all faults of the file.
Study load_study(const std::string& path);

// Returns a plan, or the study of a single experiment, with the additional settings. Throws
// config::Error.
Study load_study(const std::string& path, const StudyOptions& options);

// Returns the sweep of a study; reads the experiment if its reported figures are needed. Throws
// config::Error for invalid settings, and for a faulty experiment if it is read.
Sweep sweep_of(const Study&);

}  // namespace sinew::tune
