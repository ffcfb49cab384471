// tests/robots/runs.h - shipped experiments as numbers.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"

namespace sinew::test {

inline analysis::Summary summary_of(const std::string& name, std::vector<std::string> sets = {}) {
  const std::string path = std::string(SINEW_SOURCE_DIR) + "/experiments/" + name + ".toml";
  const config::Node root = config::compose(path, sets);
  const run::Outcome out = run::run(run::buildable(root, path));
  EXPECT_EQ(out.status, signals::Status::ok) << name;
  return analysis::summarize(out.table, analysis::read_machine(root));
}

// NaN, which no comparison passes, where the summary has no such key.
inline double figure(const analysis::Summary& s, const char* key) {
  const double* value = s.find(key);
  EXPECT_NE(value, nullptr) << key;
  return value ? *value : std::numeric_limits<double>::quiet_NaN();
}

inline std::string seed(int n) { return "seed=" + std::to_string(n); }

}  // namespace sinew::test
