// Values of files as used, and their origins.
#include "sinew/files/values.h"

#include <gtest/gtest.h>

#include "sinew/config/diagnostics.h"
#include "tests/places.h"

namespace sinew::files::values_test {
namespace {

const std::string leg = sinew::test::source_dir() + "/robots/leg/robot.toml";

TEST(Values, AreThoseWhoseKeyIsRequestedOrBeginsSo) {
  const Values all = values(leg), some = values(leg, {}, {"joint.knee"});
  EXPECT_GT(all.origins.size(), some.origins.size());
  ASSERT_FALSE(some.origins.empty());
  for (const config::Origin& o : some.origins) EXPECT_EQ(o.path.find("joint.knee"), 0u) << o.path;
  const std::string key = some.origins.front().path;
  EXPECT_EQ(values(leg, {}, {key}).origins.size(), 1u) << "a whole key is no beginning";
}

TEST(Values, OfASettingNameItAsTheirPlace) {
  const Values set = values(leg, {"joint.hip.angle_gain=0.31 %/count"}, {"joint.hip.angle_gain"});
  ASSERT_EQ(set.origins.size(), 1u);
  EXPECT_EQ(set.origins[0].text, "0.31 %/count");
  EXPECT_NE(text_of(set).find("0.31 %/count"), std::string::npos);
  EXPECT_NE(json_of(set).find("\"written\":\"0.31 %/count\""), std::string::npos) << json_of(set);
}

TEST(Values, OfAKeyThatThereIsNotAreRefusedWithTheNearestOne) {
  try {
    values(leg, {}, {"joint.knee.angle_gian"});
    FAIL();
  } catch (const config::Error& e) {
    EXPECT_NE(std::string(e.what()).find("joint.knee.angle_gain"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sinew::files::values_test
