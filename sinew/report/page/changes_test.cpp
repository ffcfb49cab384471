// Tests of parameters that were changed during a run, and of the picture of a run in a list.
#include "sinew/report/page/parameters.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/config/compose.h"
#include "sinew/report/page/content.h"
#include "tests/places.h"

namespace sinew::report::changes_test {
namespace {

TEST(Changes, AreThoseOfTheFileWithTheirUnits) {
  const config::Node node = config::parse_text(R"(
[[change]]
time = { value = "3 s", source = "--set" }
key = "control.gains.hip.angle"
leg = { value = "", source = "default" }
release = { value = false, source = "default" }
value = { value = "0.004 1/count", source = "set while it ran" }
[[change]]
time = "9.5 s"
key = "control.gains.hip.angle"
leg = "left"
release = true
)",
                                               "resolved.toml");
  const std::vector<PageChange> changes = changes_of(node);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].time, 3);
  EXPECT_EQ(changes[0].value, 0.004);
  EXPECT_EQ(changes[0].unit, "1/count");
  EXPECT_TRUE(changes[1].release);
  EXPECT_EQ(to_json(changes).text(),
            R"([{"time":3.0,"key":"control.gains.hip.angle","value":0.004,"unit":"1/count"},)"
            R"({"time":9.5,"key":"control.gains.hip.angle","value":null,"leg":"left"}])");
}

TEST(Changes, WhatIsNotWrittenLikeAResolvedFileIsLeftOut) {
  for (const char* text :
       {"change = []", "", "[[change]]\nkey = \"a\"\nvalue = \"1 rad\"",
        "[[change]]\ntime = \"3\"\nkey = \"a\"\nvalue = \"1 rad\"",
        "[[change]]\ntime = \"3 s\"\nkey = \"a\"", "[[change]]\ntime = \"3 s\"\nvalue = \"1 rad\"",
        "[[change]]\ntime = \"3 s\"\nkey = \"a\"\nvalue = \"much\""})
    EXPECT_TRUE(changes_of(config::parse_text(text, "resolved.toml")).empty()) << text;
}

TEST(Picture, HasTheLinksOfARobotTheStandOrNothing) {
  const auto drawn = [](const config::Node& resolved) { return Json::parse(picture(resolved)); };
  const Json leg = drawn(config::compose(test::source_dir() + "/experiments/one-joint.toml"));
  ASSERT_EQ(leg["scene"]["links"].size(), 1u);
  EXPECT_NEAR(leg["scene"]["links"][0]["length"].number(), 0.1524, 1e-9);  // 6 in
  EXPECT_EQ(drawn(config::parse_text("format = \"sinew.experiment/1\"\n[element]\n", "a")),
            (Json{{"stand", true}}));
  EXPECT_TRUE(drawn(config::parse_text("title = \"a log\"", "b")).empty());
}

}  // namespace
}  // namespace sinew::report::changes_test
