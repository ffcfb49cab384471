// Tests of parameters that were changed during a run, and of the picture of a run in a list.
#include "sinew/report/page/changes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/report/page/picture.h"

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

TEST(Changes, WhatIsNotSaidAsAResolvedFileDoesIsLeftOut) {
  for (const char* text :
       {"change = []", "", "[[change]]\nkey = \"a\"\nvalue = \"1 rad\"",
        "[[change]]\ntime = \"3\"\nkey = \"a\"\nvalue = \"1 rad\"",
        "[[change]]\ntime = \"3 s\"\nkey = \"a\"", "[[change]]\ntime = \"3 s\"\nvalue = \"1 rad\"",
        "[[change]]\ntime = \"3 s\"\nkey = \"a\"\nvalue = \"much\""})
    EXPECT_TRUE(changes_of(config::parse_text(text, "resolved.toml")).empty()) << text;
}

TEST(Picture, IsOfTheStandOrOfARecordingWhereThereIsNoRobot) {
  const auto drawn = [](const char* text) {
    return Json::parse(picture(config::parse_text(text, "resolved.toml")));
  };
  EXPECT_EQ(drawn("format = \"sinew.experiment/1\"\n[element]\n"), (Json{{"stand", true}}));
  const Json log = drawn("title = \"a log\"");
  EXPECT_TRUE(log.empty() || log["scene"].is_null());
}

}  // namespace
}  // namespace sinew::report::changes_test
