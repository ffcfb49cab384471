// `identify static` from the outside: what it prints and writes, that its file is used, what it
// refuses.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::identify_static_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string map = SINEW_SOURCE_DIR "/data/martens_boblan_2017/DMSP-10-250_force_map.csv";

Words words(const std::string& file, const Words& more) {
  Words out{"identify",
            "static",
            file,
            "--map",
            "force=F_N,pressure=P_gauge_Pa,length=L_m",
            "--unit",
            "F_N=N",
            "--unit",
            "P_gauge_Pa=Pa gauge",
            "--unit",
            "L_m=m",
            "--rest-length",
            "250 mm"};
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

TEST(IdentifyStatic, ScoresWhatItDidNotSeeAndSaysWhyItChose) {
  const Workspace w;
  const Result result = w.sinew(words(map, {"--hold-out", "pressure", "--json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  EXPECT_GE(out["models"].size(), 6u);
  EXPECT_LE(out["held_out"]["rmse_percent"].get<double>(), 0.5);
  EXPECT_THAT(out["rule"].get<std::string>(), HasSubstr(out["model"].get<std::string>()));
  for (const Json& p : out["parameters"]) EXPECT_TRUE(p.contains("low") && p.contains("high"));
}

// The file has its sources, is read by `actuator`, and says where the fit ends.
TEST(IdentifyStatic, WritesAFileThatIsUsed) {
  const Workspace w;
  const Result result =
      w.sinew(words(map, {"--model", "saturating-elastic", "-o", "dmsp.toml", "--name", "dmsp"}));
  ASSERT_EQ(result.code, 0) << result.err;
  std::ifstream file(w / "dmsp.toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_THAT(text, AllOf(HasSubstr("uncertainty"), HasSubstr("saturating_tension")));

  // 0.234 m, 559.062 kPa: 216.3 N were measured.
  const Result point = w.sinew(
      {"actuator", "dmsp.toml", "--length", "0.234 m", "--pressure", "559062 Pa gauge", "--json"});
  ASSERT_EQ(point.code, 0) << point.err;
  EXPECT_NEAR(Json::parse(point.out)["points"][0]["tension_N"].get<double>(), 216.3, 5);

  const Result beyond =
      w.sinew({"actuator", "dmsp.toml", "--length", "0.19 m", "--pressure", "800000 Pa gauge"});
  EXPECT_THAT(beyond.err, AllOf(HasSubstr("outside the fitted pressures"),
                                HasSubstr("outside the fitted lengths")));
}

TEST(IdentifyStatic, TakesTheBraidFromAFileWhereOneLengthIsAllThereIs) {
  const Workspace w;
  std::ofstream(w / "one.csv") << "pressure [kPa gauge],force [N]\n"
                                  "100,8\n200,17\n300,26\n400,33\n500,40\n600,46\n";
  const Result without = w.sinew({"identify", "static", "one.csv", "--length", "85 mm"});
  EXPECT_EQ(without.code, 1);
  EXPECT_THAT(without.err, AllOf(HasSubstr("one length only"), HasSubstr("--actuator")));
  const Result with = w.sinew({"identify", "static", "one.csv", "--length", "85 mm", "--actuator",
                               "robots/leg/actuator.toml", "--json"});
  ASSERT_EQ(with.code, 0) << with.err;
  EXPECT_THAT(Json::parse(with.out)["model"].get<std::string>(), HasSubstr("effectiveness"));
}

TEST(IdentifyStatic, RefusesWhatItCannotUse) {
  const Workspace w;
  const Result model = w.sinew(words(map, {"--model", "cubik"}));
  EXPECT_EQ(model.code, 1);
  EXPECT_THAT(model.err, AllOf(HasSubstr("cubik"), HasSubstr("elastic-cubic")));
  const Result where = w.sinew(words(map, {"--where", "phase=fill"}));
  EXPECT_EQ(where.code, 2);
  EXPECT_THAT(where.err, AllOf(HasSubstr("--where"), HasSubstr("phase")));
  EXPECT_EQ(w.sinew(words(map, {"--branch", "sideways"})).code, 2);
  const Result hold_out = w.sinew(words(map, {"--hold-out", "nonsense"}));
  EXPECT_EQ(hold_out.code, 2);
  EXPECT_THAT(hold_out.err, HasSubstr("expected pressure, length, muscle or a file that is there"));
  EXPECT_THAT(w.sinew(words(map, {"--hold-out", map})).err, HasSubstr("expected another file"));
}

}  // namespace
}  // namespace sinew::test::identify_static_test
