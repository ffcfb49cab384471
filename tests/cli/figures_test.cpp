// `figures`: what is refused and kept.
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace sinew::test::figures_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Figures, KeepsWhatIsThereAndNamesWhatIsMissing) {
  const Workspace w;
  std::filesystem::create_directories(w / "here");
  write_text(w / "here/index.json", "mine");
  const Result kept = w.sinew({"figures", "--thesis", "-o", "here"});
  EXPECT_EQ(kept.code, 1);
  EXPECT_THAT(kept.err, HasSubstr("index.json"));
  EXPECT_TRUE(read_text(w / "here/index.json") == "mine");

  const Result lost = w.sinew({"figures", "--thesis", "-o", "there", "--root", "nowhere"});
  EXPECT_EQ(lost.code, 1);
  EXPECT_THAT(lost.err, AllOf(HasSubstr("nowhere/robots"), HasSubstr("--root")));
  EXPECT_EQ(w.sinew({"figures", "-o", "there"}).code, 2);
}

}  // namespace
}  // namespace sinew::test::figures_test
