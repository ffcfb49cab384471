// tests/cli/json.h - a command's answer with --json, parsed.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test {

// Returns what `sinew WORDS --json` prints; an empty object where it fails, which fails the test.
inline nlohmann::ordered_json json(const Workspace& w, Words words) {
  words.push_back("--json");
  const Result result = w.sinew(words);
  EXPECT_EQ(result.code, 0) << result.err;
  return result.code == 0 ? nlohmann::ordered_json::parse(result.out)
                          : nlohmann::ordered_json::object();
}

}  // namespace sinew::test
