// `sinew completion fish`, run by fish where it is installed. The other shells: completion.txt.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/cli/program.h"
#include "tests/places.h"

namespace sinew::test::completion_test {
namespace {

namespace fs = std::filesystem;
using ::testing::StartsWith;

TEST(Completion, FishOffersTheSame) {
  if (std::system("command -v fish >/dev/null") != 0) GTEST_SKIP() << "fish is not installed";
  const Workspace w;
  write_text(w / "script", w.sinew({"completion", "fish"}).out);
  const auto offered_by_fish = [&](const std::string& line) {
    write_text(w / "ask", "set -x PATH " + fs::path(sinew::test::program()).parent_path().string() +
                              " $PATH; source script; complete -C '" + line + "'\n");
    const std::string where = "cd '" + w.path().string() + "' && fish ask >out 2>&1";
    EXPECT_EQ(std::system(where.c_str()), 0);
    return read_text(w / "out");
  };
  EXPECT_THAT(offered_by_fish("sinew run --units t"), StartsWith("thesis"));
  EXPECT_THAT(offered_by_fish("sinew run experiments/one-joint.toml --set air.supply.kind=t"),
              StartsWith("air.supply.kind=tank"));
  EXPECT_THAT(offered_by_fish("sinew run experiments/one-joint.toml --set joint.lever.dampi"),
              StartsWith("joint.lever.damping="));
}

}  // namespace
}  // namespace sinew::test::completion_test
