// Lookup of values by the key in an error or an origin, and of items by name.
#include "sinew/config/node.h"

#include <gtest/gtest.h>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"

namespace sinew::config::lookup_test {
namespace {

TEST(ValueAt, FindsTablesValuesAndPlacesOfListsAndNothingElse) {
  const Node root = parse_text(
      "[joint.hip]\ndamping = \"1 N m s/rad\"\n[[reported]]\naccept = [\"1 m\", \"2 m\"]\n", "t");
  ASSERT_TRUE(value_at(root, "joint.hip.damping"));
  EXPECT_EQ(value_at(root, "joint.hip.damping")->text, "1 N m s/rad");
  ASSERT_TRUE(value_at(root, "reported[0].accept[1]"));
  EXPECT_EQ(value_at(root, "reported[0].accept[1]")->text, "2 m");
  EXPECT_EQ(value_at(root, ""), &root);
  for (const char* none :
       {"joint.knee", "reported[1]", "reported[0].accept[2]", "joint.hip.damping.x"})
    EXPECT_EQ(value_at(root, none), nullptr) << none;
}

struct Item {
  std::string name;
};

TEST(Named, TheOnlyItemNeedsNoNameAndATypingErrorIsReported) {
  const std::vector<Item> one{{"inlet"}}, two{{"inlet"}, {"exhaust"}};
  EXPECT_EQ(&named(one, "", "file", "valve"), &one[0]);
  EXPECT_EQ(&named(two, "exhaust", "file", "valve"), &two[1]);
  EXPECT_THROW((void)named(two, "", "file", "valve"), Error);
  EXPECT_THROW((void)named(std::vector<Item>{}, "", "file", "valve"), Error);
  try {
    (void)named(two, "exhuast", "file", "valve");
    ADD_FAILURE();
  } catch (const Error& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find("file: "), 0u) << text;
    EXPECT_NE(text.find("try \"exhaust\""), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace sinew::config::lookup_test
