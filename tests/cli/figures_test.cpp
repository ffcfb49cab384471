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

TEST(Figures, EveryCurveOfTheIndexStandsInItsFile) {
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
      EXPECT_GE(c.at(curve["y"]).size(), 10u) << curve.dump();
      EXPECT_THAT(curve["y"].get<std::string>(), AllOf(HasSubstr(" ["), HasSubstr("]")));
    }
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"computed", "synthetic", "unavailable"}));
}

// Figure 2-6 as reference.json has it, to its four decimals.
TEST(Figures, Figure2_6) {
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
TEST(Figures, Figure3_13) {
  const Columns c = sheet("3-13");
  EXPECT_NEAR(at(c, "commanded duty [%]", "actual duty at 25 Hz [%]", 50), 42.5, 1e-9);
  EXPECT_NEAR(at(c, "commanded duty [%]", "actual duty at 50 Hz [%]", 50), 35, 1e-9);
  EXPECT_EQ(at(c, "commanded duty [%]", "actual duty at 50 Hz [%]", 19.5), 0);
  EXPECT_EQ(at(c, "commanded duty [%]", "actual duty at 25 Hz [%]", 98), 100);
}

// Choked above 13.1 psi: the flow is linear in the absolute pressure.
TEST(Figures, Figure3_4) {
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
TEST(Figures, Figures4_8And4_9) {
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
