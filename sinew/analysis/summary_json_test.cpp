// Format of summary.json, and exactness of its numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sinew/analysis/record/test_log.h"
#include "sinew/analysis/summary.h"

namespace sinew::analysis::summary_json_test {
namespace {

using test::walk;
using test::walking_leg;

TEST(Json, NestsKeysInTheirOrder) {
  Summary s;
  s.title = "A \"walk\" – 1";
  s.add("z.b_m", 0.1);
  s.add("a", 12);
  s.add("z.a.c", 1e-12);
  s.add("not", std::numeric_limits<double>::quiet_NaN());
  s.add("zero", -0.0);
  const std::string text = to_json(s, {.numbers = {{"threads", 2}}, .warnings = {}});
  EXPECT_EQ(text,
            "{\n"
            "  \"format\": \"sinew.summary/1\",\n"
            "  \"title\": \"A \\\"walk\\\" – 1\",\n"
            "  \"z\": {\n"
            "    \"b_m\": 0.1,\n"
            "    \"a\": {\n"
            "      \"c\": 1e-12\n"
            "    }\n"
            "  },\n"
            "  \"a\": 12,\n"
            "  \"zero\": 0,\n"
            "  \"host\": {\n"
            "    \"threads\": 2\n"
            "  }\n"
            "}\n");
}

// Warnings of the log are separate from those that depend on the computer of the run.
TEST(Json, HasWarningsBeforeTheHost) {
  Summary s;
  s.title = "A walk";
  s.warnings = {"a \"first\"", "a second"};
  EXPECT_EQ(to_json(s, {.numbers = {{"threads", 1}}, .warnings = {"3 ticks came late"}}),
            "{\n"
            "  \"format\": \"sinew.summary/1\",\n"
            "  \"title\": \"A walk\",\n"
            "  \"warnings\": [\n"
            "    \"a \\\"first\\\"\",\n"
            "    \"a second\"\n"
            "  ],\n"
            "  \"host\": {\n"
            "    \"threads\": 1,\n"
            "    \"warnings\": [\n"
            "      \"3 ticks came late\"\n"
            "    ]\n"
            "  }\n"
            "}\n");
}

TEST(Json, IsValidAndBringsBackTheSameBits) {
  test::Log log = walk(3, 0.5, 0.5);
  log.scalar("/joint/hip/angle", [](double t) { return 5 + std::sin(7 * t) / 3; });
  log.scalar("/joint/hip/stiffness", [](double t) { return std::exp(t) / 7; });
  const Summary s = summarize(log.table, walking_leg());
  const nlohmann::json json = nlohmann::json::parse(to_json(s));
  EXPECT_EQ(json["format"], "sinew.summary/1");
  EXPECT_FALSE(json.contains("host"));
  for (const Entry& e : s.entries()) {
    std::string pointer = "/" + e.key;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    EXPECT_EQ(json[nlohmann::json::json_pointer(pointer)].get<double>(), e.value) << e.key;
  }
}

}  // namespace
}  // namespace sinew::analysis::summary_json_test
