// `identify dynamic` from the outside: losses from files of free decays, and what is refused.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/identify/motion/free_decay.h"
#include "sinew/units/literals.h"
#include "tests/cli/program.h"

namespace sinew::test::identify_dynamic_test {
namespace {

using namespace units::literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string start = "robots/leg/actuator.toml";

// A decay as a potentiometer with a resolution of 0.01 mm has it. Synthetic.
std::string decay(double psi, double pounds, double step = 0.005) {
  identify::Hanging h{.actuator = actuator::thesis_actuator()};
  h.actuator.effectiveness.scale = 0.92;  // as the leg's
  h.actuator.effectiveness.argument = actuator::Effectiveness::Argument::absolute;
  h.mass = pounds * 1.0_lb;
  h.pressure = actuator::thesis_atmosphere + psi * 1.0_psi;
  h.external_volume = 0.114_in3;
  h.polytropic_exponent = 1.4;
  h.atmosphere = actuator::thesis_atmosphere;
  h.gravity = units::standard_gravity;
  std::vector<double> t, x;
  for (int i = 0; i * step < 1.6; ++i) t.push_back(i * step);
  x.resize(t.size());
  EXPECT_TRUE(identify::free_decay(h, *identify::rest_length(h) + 0.2_in, 0, t, x));
  std::string out = "t,x\n";
  for (std::size_t i = 0; i < t.size(); ++i)
    out += std::to_string(t[i]) + "," + std::to_string(1e-2 * std::round(1e5 * x[i])) + "\n";
  return out;
}

const Words options{"--actuator", start,   "--external-volume", "0.114 in3", "--map",
                    "time=t",     "--map", "length=x",          "--unit",    "t=s",
                    "--unit",     "x=mm"};

Result identified(const Workspace& w, Words files, const Words& more) {
  Words words{"identify", "dynamic"};
  for (const Words& part : {files, options, more})
    words.insert(words.end(), part.begin(), part.end());
  return w.sinew(words);
}

TEST(IdentifyDynamic, WritesTheStartFileWithTheLossesOfTwoRecords) {
  const Workspace w;
  write_text(w / "a.csv", decay(60, 6));
  write_text(w / "b.csv", decay(80, 11));
  const Result result = identified(w, {"a.csv", "b.csv"},
                                   {"--mass", "6 lb, 11 lb", "--pressure",
                                    "60 psi gauge,80 psi gauge", "--json", "-o", "mine.toml"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  EXPECT_EQ(out["chosen"], "secant") << out["rule"];
  EXPECT_EQ(out["models"].size(), 7u);
  EXPECT_LT(out["held_out"]["rmse_percent"], 0.2);
  const auto loss = actuator::thesis_actuator().loss;
  EXPECT_NEAR(out["parameters"][0]["value"], loss.viscous, 0.02 * loss.viscous);
  EXPECT_NEAR(out["parameters"][1]["value"], loss.coulomb_length, 0.02 * loss.coulomb_length);
  const Json& record = out["records"][0];
  EXPECT_LT(record["two_point_printed"]["coulomb_length_m"],
            record["two_point_exact"]["coulomb_length_m"]);

  const std::string file = read_text(w / "mine.toml");
  EXPECT_THAT(file, AllOf(HasSubstr("identify dynamic a.csv b.csv: secant"),
                          HasSubstr("uncertainty"), HasSubstr("[17]")));
  const Result check = w.sinew({"check", "mine.toml"});
  EXPECT_EQ(check.code, 0) << check.err;
}

TEST(IdentifyDynamic, PrintsTheThesissMethodBesideTheTrajectory) {
  const Workspace w;
  write_text(w / "a.csv", decay(60, 6));
  const Result result = identified(
      w, {"a.csv"}, {"--mass", "6 lb", "--pressure", "60 psi gauge", "--model", "secant"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("two points, [45] as printed"), HasSubstr("all turns"),
                    HasSubstr("trajectory, secant"), HasSubstr("the last third of the record")));
}

TEST(IdentifyDynamic, RefusesWhatItCannotUse) {
  const Workspace w;
  write_text(w / "a.csv", decay(60, 6));
  const Words pressure{"--pressure", "60 psi gauge"};
  const auto with = [&](const Words& more) {
    Words words = pressure;
    words.insert(words.end(), more.begin(), more.end());
    return identified(w, {"a.csv"}, words);
  };
  Result result = with({"--mass", "6 g"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("at the measured length it holds 2."));

  result = with({"--mass", "6 lbf"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--mass"));

  result = with({"--mass", "6 lb, 11 lb"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("found 2 values; expected one, or 1"));

  result = with({"--mass", "6 lb", "--model", "magic"});
  EXPECT_EQ(result.code, 2);

  result = identified(w, {"a.csv"}, {"--mass", "6 lb"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("no measured pressure"));

  result = with({"--mass", "6 lb", "--exponent", "0"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(
      result.err,
      HasSubstr("--exponent: found \"0\"; expected 1 to 1.66667: from isothermal to adiabatic"));

  result = identified(w, {"a.csv", "a.csv"}, {"--mass", "6 lb", "--pressure", "60 psi gauge"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("data: found a.csv twice"));

  result = with({"--mass", "6 lb", "-o", "a.csv", "--force"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("a.csv: found something that is no parameter file"));

  write_text(w / "slow.csv", decay(60, 6, 0.03));
  result = identified(w, {"slow.csv"}, {"--mass", "6 lb", "--pressure", "60 psi gauge"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("slow.csv"));
}

}  // namespace
}  // namespace sinew::test::identify_dynamic_test
