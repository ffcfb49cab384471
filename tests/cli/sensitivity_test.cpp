// `sinew sensitivity` as its users see it.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/cli/json.h"
#include "tests/cli/program.h"

namespace sinew::test::sensitivity_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string lever = "experiments/one-joint.toml";
const Words study = {"sensitivity", lever,
                     "--range",     "phase.up.duration=1:2 s",
                     "--range",     "seed=1:9 whole",
                     "--report",    "sequence_duration_s"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Sensitivity, TellsWhatAFigureFollows) {
  const Workspace w;
  const Result r = w.sinew(with(study, {"--points", "8", "--runs", "runs.csv", "-o", "s.csv"}));
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("sequence_duration [s]: mean"), HasSubstr("95 %"),
                           HasSubstr("phase.up.duration [s]")));
  const std::string runs = read_text(w / "runs.csv");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 8 * 4);
  EXPECT_THAT(read_text(w / "s.csv"), HasSubstr("\"alone, low\""));
  // Nothing that stands is lost, and by any number of threads it is the same.
  EXPECT_EQ(w.sinew(with(study, {"--points", "8", "-o", "s.csv"})).code, 1);
  EXPECT_EQ(w.sinew(with(study, {"--points", "8", "--threads", "1", "--json"})).out,
            w.sinew(with(study, {"--points", "8", "--threads", "3", "--json"})).out);
}

TEST(Sensitivity, HasThreeMethods) {
  const Workspace w;
  for (const char* method : {"morris", "ends"}) {
    const Result r = w.sinew(with(study, {"--method", method, "--json"}));
    EXPECT_EQ(r.code, 0) << r.err;
    const auto ranges = nlohmann::json::parse(r.out)["figures"][0]["ranges"];
    ASSERT_EQ(ranges.size(), 2U);
    EXPECT_EQ(ranges[0]["range"], "phase.up.duration [s]");
  }
}

TEST(Sensitivity, SaysWhatIsWrong) {
  const Workspace w;
  const auto refused = [&](const Words& words) {
    const Result r = w.sinew(words);
    EXPECT_NE(r.code, 0);
    return r.err;
  };
  EXPECT_THAT(refused({"sensitivity", lever}), HasSubstr("--range: found none"));
  EXPECT_THAT(refused(with(study, {"--range", "phase.up.durration=1:2 s"})),
              HasSubstr("did you mean"));
  EXPECT_THAT(refused(with(study, {"--report", "no.such_m", "--method", "ends"})),
              HasSubstr("no.such_m: found no run with it"));
  EXPECT_THAT(refused(with(study, {"--method", "guess"})), HasSubstr("sobol"));
  EXPECT_THAT(refused(with(study, {"--points", "1000000"})), HasSubstr("4000000 runs"));
  EXPECT_THAT(refused(with(study, {"--set", "seed=3", "--range", "seed=1:4"})),
              AllOf(HasSubstr("seed"), Not(HasSubstr("Aborted"))));
}

}  // namespace
}  // namespace sinew::test::sensitivity_test
