// tests/bands/shipped.h - runs of the experiments that ship.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::test {

inline const std::string experiments = sinew::test::source_dir() + "/experiments";

using Sets = std::vector<std::string>;  // key=value

inline std::string file_of(const std::string& name) { return experiments + "/" + name + ".toml"; }

inline analysis::Summary summary_of(const std::string& name, const Sets& sets = {}) {
  const config::Node root = config::compose(file_of(name), sets);
  const run::Outcome out = run::run(run::buildable(root, file_of(name)));
  EXPECT_EQ(out.status, signals::Status::ok) << name;
  return analysis::summarize(out.table, analysis::read_machine(root));
}

}  // namespace sinew::test
