// Quantity of a named setting: read in its unit, refused outside its range.
#include "sinew/config/setting.h"

#include <gtest/gtest.h>

#include "sinew/config/diagnostics.h"

namespace sinew::config::setting_test {
namespace {

std::string refusal(const std::string& text, const Range& range) {
  try {
    quantity_setting("mass", text, "kg", units::atmosphere, range);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Setting, IsReadInItsUnit) {
  EXPECT_NEAR(quantity_setting("mass", "6 lb", "kg"), 2.72155, 1e-5);
  EXPECT_EQ(quantity_setting("pressure", "0 Pa gauge", "Pa abs", 98e3), 98e3);
  EXPECT_EQ(at_commas("6 lb, 11 lb"), (std::vector<std::string>{"6 lb", "11 lb"}));
  EXPECT_TRUE(at_commas("").empty());
}

TEST(Setting, ReportsItsNameAndRange) {
  const Range range = above_zero(10, "it hangs");
  EXPECT_EQ(refusal("1 kg", range), "nothing");
  EXPECT_EQ(refusal("10 kg", range), "nothing");
  EXPECT_EQ(refusal("0 kg", range),
            "mass: found \"0 kg\"; expected more than 0 kg, at most 10 kg: it hangs");
  EXPECT_EQ(refusal("1 t", range).substr(0, 12), "mass: found ");
  EXPECT_EQ(refusal("11000 g", range).substr(0, 45),
            "mass: found \"11000 g\", which is 11 kg; expect");
  EXPECT_THROW(number_setting("count", 0, {1, 100, ""}), Error);
}

TEST(Setting, OfAMessageIsInTheUnitThatWasWritten) {
  const Origins origins = {
      {.path = "start.lift", .unit = "m", .text = "2 cm"},
      {.path = "start.trolley", .unit = "m", .text = "0 m", .is_default = true}};
  EXPECT_EQ(quantity_like(origins, "start.lift", 0.03, "m", "in"), "3 cm");
  EXPECT_EQ(quantity_like(origins, "start.trolley", 0.0254, "m", "in"), "1 in");
  EXPECT_EQ(quantity_like(origins, "start.other", 0.0254, "m", "in"), "1 in");
}

TEST(Quantity, OfATextIsReportedWithItsKey) {
  EXPECT_DOUBLE_EQ(quantity("2 cm", "m"), 0.02);
  try {
    quantity("62 psi", "Pa abs", "key");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "text: key: found \"62 psi\", a pressure without its reference; expected Pa abs "
              "(pressure); try \"62 psi gauge\" or \"62 psi abs\"");
  }
}

}  // namespace
}  // namespace sinew::config::setting_test
