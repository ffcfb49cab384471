// `figures`: every curve in the index stands in its file, and those that are laws have their
// numbers.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/cli/program.h"

namespace sinew::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using Json = nlohmann::ordered_json;
using Columns = std::map<std::string, std::vector<double>>;

// One run for all tests: the folder and what it printed.
struct Drawn {
  Workspace w;
  Result result = w.sinew({"figures", "--thesis", "-o", "figures", "--json"});
  Json index = Json::parse(result.out.empty() ? "{}" : result.out);
};

const Drawn& drawn() {
  static const Drawn once;
  return once;
}

Columns read(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(in, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  Columns out;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    for (const std::string& name : names) {
      cell.clear();
      std::getline(cells, cell, ',');
      out[name].push_back(cell.empty() ? std::nan("") : std::stod(cell));
    }
  }
  return out;
}

Columns sheet(const std::string& name) { return read(drawn().w / ("figures/" + name + ".csv")); }

double at(const Columns& c, const std::string& x, const std::string& y, double where) {
  const std::vector<double>& xs = c.at(x);
  std::size_t best = 0;
  for (std::size_t i = 0; i < xs.size(); ++i)
    if (std::fabs(xs[i] - where) < std::fabs(xs[best] - where)) best = i;
  EXPECT_NEAR(xs[best], where, 1e-4 * (1 + std::fabs(where)));
  return c.at(y)[best];
}

void every_curve_stands_in_its_file() {
  ASSERT_EQ(drawn().result.code, 0) << drawn().result.err;
  std::set<std::string> kinds;
  for (const Json& figure : drawn().index["figures"]) {
    EXPECT_FALSE(figure["caption"].get<std::string>().empty());
    EXPECT_FALSE(figure["curves"].empty()) << figure["figure"];
    for (const Json& curve : figure["curves"]) {
      kinds.insert(curve["kind"]);
      EXPECT_FALSE(curve["source"].get<std::string>().empty()) << curve.dump();
      if (curve["kind"] == "unavailable") continue;
      const Columns c = read(drawn().w / ("figures/" + curve["file"].get<std::string>()));
      ASSERT_TRUE(c.contains(curve["x"])) << curve.dump();
      ASSERT_TRUE(c.contains(curve["y"])) << curve.dump();
      EXPECT_GE(c.at(curve["y"]).size(), 4u) << curve.dump();
      EXPECT_THAT(curve["y"].get<std::string>(), AllOf(HasSubstr(" ["), HasSubstr("]")));
    }
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"computed", "synthetic", "unavailable"}));
}

// Figure 2-6 as reference.json has it, to its four decimals.
void figure_2_6() {
  const Columns force = sheet("2-6-force"), stiffness = sheet("2-6-stiffness");
  std::ifstream file(std::string(SINEW_SOURCE_DIR) + "/data/reference.json");
  const Json rows = Json::parse(file)["fig_2_6"]["rows"];
  int compared = 0;
  for (const auto& [length, row] : rows.items())
    for (const auto& [psi, pair] : row.items()) {
      const std::string tail = " at " + psi + " psi gauge [lbf";
      const double l = std::stod(length);
      EXPECT_NEAR(at(force, "length [in]", "force" + tail + "]", l), pair[0],
                  6e-5 + 3e-4 * (l < 2.44));
      EXPECT_NEAR(at(stiffness, "length [in]", "stiffness" + tail + "/in]", l), pair[1],
                  6e-5 + 3e-4 * (l < 2.44));
      ++compared;
    }
  EXPECT_GT(compared, 50);
}

// 3.4: 50 % is 42.5 and 35 %.
void figure_3_13() {
  const Columns c = sheet("3-13");
  EXPECT_NEAR(at(c, "commanded duty [%]", "actual duty at 25 Hz [%]", 50), 42.5, 1e-9);
  EXPECT_NEAR(at(c, "commanded duty [%]", "actual duty at 50 Hz [%]", 50), 35, 1e-9);
  EXPECT_EQ(at(c, "commanded duty [%]", "actual duty at 50 Hz [%]", 19.5), 0);
  EXPECT_EQ(at(c, "commanded duty [%]", "actual duty at 25 Hz [%]", 98), 100);
}

// Choked above 13.1 psi: the flow is linear in the absolute pressure.
void figure_3_4() {
  const Columns c = sheet("3-4");
  const std::string x = "supply pressure [psi gauge]", y = "mass flow to the atmosphere [g/s]";
  EXPECT_EQ(at(c, x, y, 0), 0);
  EXPECT_NEAR(at(c, x, y, 100) / at(c, x, y, 40), 114.7 / 54.7, 1e-9);
  // [42]: 1.8e-5 ft2 of air at 100 psi gauge.
  const double expected =
      1e3 * 1.8e-5 * 0.09290304 * 114.7 * 6894.757 * 0.0404184 / std::sqrt(293.15);
  EXPECT_NEAR(at(c, x, y, 100) / expected, 1, 0.01);
}

// 4.3: the inlet opens in about 0.5 ms and its current is gone as long after the edge; the
// exhaust's dip comes later the more pressure there is.
void figures_4_8_and_4_9() {
  const Columns c = sheet("4-8");
  const std::string y = "current at 100 psi gauge [A]";
  EXPECT_LT(at(c, "time [ms]", y, 0.5), at(c, "time [ms]", y, 0.38));
  EXPECT_GT(at(c, "time [ms]", y, 0.6), at(c, "time [ms]", y, 0.5));
  EXPECT_GT(at(c, "time [ms]", y, 4.4), 0);
  EXPECT_EQ(at(c, "time [ms]", y, 4.56), 0);

  const Columns e = sheet("4-9");
  double last = 0;
  for (const char* psi : {"0", "30", "60", "90"}) {
    const std::vector<double>& i = e.at("current at " + std::string(psi) + " psi gauge [A]");
    std::size_t turn = 1;  // the first minimum
    while (!(i[turn] < i[turn - 1] && i[turn] < i[turn + 1])) ++turn;
    EXPECT_GT(e.at("time [ms]")[turn], last);
    last = e.at("time [ms]")[turn];
  }
}

void every_figure_is_there() {
  std::vector<std::string> wanted{"2-6"};
  for (int i = 8; i <= 13; ++i) wanted.push_back("2-" + std::to_string(i));
  for (int i = 4; i <= 23; ++i)
    if (i != 5 && i != 12) wanted.push_back("3-" + std::to_string(i));
  wanted.insert(wanted.end(), {"4-8", "4-9"});
  std::vector<std::string> there;
  for (const Json& figure : drawn().index["figures"]) there.push_back(figure["figure"]);
  EXPECT_EQ(there, wanted);
}

// What a student would find on our stand is what the model was given: [30] at each mean pressure,
// to 1.5 %, and falling with the pressure.
void figure_2_11_finds_the_effectiveness() {
  const Columns c = sheet("2-11-stand");
  const std::vector<double>&p = c.at("mean pressure [psi gauge]"),
        &eff = c.at("effectiveness found [-]");
  ASSERT_EQ(p.size(), 4u);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(eff[i], 0.9969 + 0.0005 * p[i] - 0.00002 * p[i] * p[i], 0.015);
    if (i > 0) {
      EXPECT_LT(eff[i], eff[i - 1]);
    }
  }
}

// The simulations of chapter 3 start 0.2 in below where the load hangs and end there.
void figure_3_7() {
  const Columns c = sheet("3-7-trapped-60-6");
  EXPECT_NEAR(c.at("length [in]").front(), 3.09108, 1e-4);
  EXPECT_NEAR(c.at("length [in]").back(), 2.8932, 1e-4);
  const Columns measured = sheet("3-6-trapped-60-6");
  EXPECT_EQ(measured.at("time [s]").size(), c.at("time [s]").size());
  EXPECT_NE(measured.at("length [in]").back(), c.at("length [in]").back());
}

// Drawn once for all of them.
TEST(Figures, AreWhatTheirLawsSay) {
  ASSERT_EQ(drawn().result.code, 0) << drawn().result.err;
  every_curve_stands_in_its_file();
  figure_2_6();
  figure_3_13();
  figure_3_4();
  figures_4_8_and_4_9();
  every_figure_is_there();
  figure_2_11_finds_the_effectiveness();
  figure_3_7();
}

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
}  // namespace sinew::test
