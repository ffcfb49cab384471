// A sensitivity study of real runs: its points equal single runs, and invalid settings are refused.
#include "sinew/tune/sensitivity.h"

#include <gtest/gtest.h>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "tests/places.h"

namespace sinew::tune::sensitivity_table_test {
namespace {

const std::string lever = sinew::test::source_dir() + "/experiments/one-joint.toml";

Sweep base() {
  return {.experiment = lever,
          .sample = Sample{.ranges = {parse_range("phase.up.duration=1:2 s"),
                                      parse_range("seed=1:9 whole")}},
          .report = parse_figures("sequence_duration_s [ms], no.such_figure_m")};
}

// The sequence lasts as long as its phases: each second of a phase is a second of the whole, and
// the sensors' noise has no influence.
TEST(SensitivityTable, ASequenceIsAsLongAsItsPhases) {
  const Design ends{Method::one_at_a_time, 2, 0, 1};
  const Sweep runs = sweep_of(ends, base());
  ASSERT_EQ(points(runs), 5U);
  const std::vector<Row> rows = sweep(runs, {.threads = 2});
  EXPECT_EQ(rows[0].cells[0], "1.5");
  EXPECT_EQ(rows[1].cells[0], "1");
  EXPECT_EQ(rows[2].cells[0], "2");
  const std::vector<FigureSensitivity> all = sensitivities(ends, runs, rows);
  ASSERT_EQ(all.size(), 2U);
  ASSERT_TRUE(all[0].found);
  EXPECT_FALSE(all[1].found) << "no run has it";
  const std::vector<Effect>& effects = all[0].found->effects;
  const double longer = effects[0].to_high.value, shorter = effects[0].to_low.value;
  EXPECT_GT(longer, 0);
  EXPECT_NEAR(longer, -shorter, 1e-6 * longer);
  EXPECT_NEAR(std::fmod(longer, 500), 0, 1e-6)
      << "half a second for each time that the phase comes";
  EXPECT_EQ(effects[1].to_high.value, 0);

  const auto table = sensitivity_rows(ends, runs, all);
  ASSERT_EQ(table.size(), 4U);
  for (const auto& row : table)
    EXPECT_EQ(row.size(), sensitivity_headings(Method::one_at_a_time).size());
  EXPECT_EQ(table[0][1], "phase.up.duration [s]");
  EXPECT_EQ(table[2][2], "");

  const auto json = Json::parse(sensitivity_json(ends, runs, all));
  EXPECT_EQ(json["runs"], 5);
  EXPECT_EQ(json["figures"][0]["ranges"][0]["to the high end"], longer);
  EXPECT_FALSE(json["figures"][1].contains("ranges"));
}

TEST(SensitivityTable, SobolsIndicesOfRuns) {
  const Design design{Method::sobol, 2, 16, 1};
  const Sweep runs = sweep_of(design, base());
  const auto all = sensitivities(design, runs, sweep(runs, {.threads = 2}));
  ASSERT_TRUE(all[0].found);
  EXPECT_NEAR(all[0].found->effects[0].total.value, 1, 0.3) << "16 rows";
  EXPECT_EQ(all[0].found->effects[1].total.value, 0);
}

TEST(SensitivityTable, RefusesWhatIsNoStudy) {
  const auto of = [](auto change) -> std::string {
    Sweep s = base();
    Design design{Method::sobol, 2, 16, 1};
    change(s, design);
    try {
      sweep_of(design, s);
    } catch (const config::Error& e) {
      return e.what();
    }
    return "";
  };
  using std::string;
  EXPECT_EQ(of([](Sweep&, Design&) {}), "");
  EXPECT_NE(of([](Sweep& s, Design&) { s.sample.reset(); }).find("what is varied"), string::npos);
  EXPECT_NE(of([](Sweep& s, Design&) { s.axes = {seeds(2)}; }).find("ranges alone"), string::npos);
  EXPECT_NE(of([](Sweep& s, Design&) { s.report.clear(); }).find("no figure"), string::npos);
  EXPECT_NE(of([](Sweep&, Design& d) { d.count = 1'000'000; }).find("4000000 runs"), string::npos);
}

}  // namespace
}  // namespace sinew::tune::sensitivity_table_test
