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
  EXPECT_EQ(to_json(changes),
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

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t out = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++out;
  return out;
}

TEST(Picture, IsOfTheStandOrOfARecordingWhereThereIsNoRobot) {
  const std::string stand =
      picture(config::parse_text("format = \"sinew.experiment/1\"\n[element]\n", "resolved.toml"));
  const std::string curve = picture(config::parse_text("title = \"a log\"", "resolved.toml"));
  for (const std::string& svg : {stand, curve}) {
    EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\""));
    EXPECT_TRUE(svg.ends_with("</svg>"));
    EXPECT_EQ(svg.find("nan"), svg.npos);
  }
  EXPECT_NE(stand, curve);
  EXPECT_LT(count(stand, "<path"), count(curve, "<path"));
}

}  // namespace
}  // namespace sinew::report::changes_test
