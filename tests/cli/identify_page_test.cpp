// The page that `identify` leaves: it shows the file's numbers, what the report says of them, and
// takes nobody's file away.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::identify_page_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const std::string mesh = "length [mm],diameter [mm]\n65,11.72\n75,10.5\n85,9.01\n95,6.84\n";

// ISO 6358, read a little off.
std::string chart() {
  std::string text = "upstream [bar abs],downstream [bar abs],flow [L/min]\n";
  for (const double down : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.5}) {
    const double x = std::max(0.0, (down / 7 - 0.3) / 0.7);
    const double flow = 1260 * std::sqrt(1 - x * x) + 5 * std::sin(9 * down);
    text += "7," + std::to_string(down) + "," + std::to_string(flow) + "\n";
  }
  return text;
}

std::string hold() {
  std::string text = "time [s],force [N],pressure [kPa gauge]\n";
  for (double t = 0; t < 30; t += 0.5)
    text += std::to_string(t) + "," + std::to_string(50 - 4 * std::exp(-t / 5)) + ",400\n";
  return text;
}

std::string weights() {
  std::string text = "load [N],cell [V]\n";
  for (const double n : {0, 10, 20, 30, 40, 30, 20, 10, 0})
    text += std::to_string(n) + "," + std::to_string(0.5 + 0.05 * n + 1e-3 * std::sin(n)) + "\n";
  return text;
}

// The JSON that the page holds.
Json page(const std::filesystem::path& file) {
  const std::string html = read_text(file), opening = "id=\"run-data\">";
  const std::size_t from = html.find(opening) + opening.size();
  return Json::parse(html.substr(from, html.find("</script>", from) - from));
}

struct Case {
  Words method;
  std::string text;  // of data.csv
  std::size_t rows;  // that are fitted
  double first_x,
      scale;  // of the chart, in SI; its first measured value of the file's second column
};

class IdentifyPage : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (!SINEW_HAS_PAGE) GTEST_SKIP() << "built without npm";
  }
};

// Points are the file's, the line is what the model says, and the second chart their difference.
TEST_P(IdentifyPage, ShowsTheFileBesideTheModel) {
  const Case& c = GetParam();
  const Workspace w;
  write_text(w / "data.csv", c.text);
  Words words{"identify"};
  words.insert(words.end(), c.method.begin(), c.method.end());
  words.insert(words.end(), {"data.csv", "--report", "fit.html", "--json"});
  const Result result = w.sinew(words);
  ASSERT_EQ(result.code, 0) << result.err;
  const Json run = page(w / "fit.html"), part = run["parts"][0];
  EXPECT_EQ(run["format"], "sinew.fit/1");
  EXPECT_THAT(run["data"], Contains("data.csv"));
  EXPECT_EQ(part["report"]["parameters"], Json::parse(result.out)["parameters"]);

  double square = 0;
  std::size_t rows = 0;
  std::vector<double> measured, model, left;
  std::vector<Json> bands;
  const auto add = [](std::vector<double>& to, const Json& numbers) {
    for (const Json& x : numbers) to.push_back(x);
  };
  for (const Json& curve : part["charts"][0]["curves"]) {
    if (curve.contains("hidden")) continue;
    if (curve["style"] == "band") {
      bands.push_back(curve);
      continue;
    }
    add(curve["style"] == "line" ? model : measured, curve["y"]);
    EXPECT_TRUE(std::ranges::is_sorted(curve["x"]));
  }
  for (const Json& curve : part["charts"][1]["curves"]) {
    if (curve["style"] == "band") continue;
    rows += curve["y"].size();
    add(left, curve["y"]);
  }
  ASSERT_EQ(rows, c.rows);
  ASSERT_EQ(measured.size(), rows);
  ASSERT_EQ(model.size(), rows);
  for (std::size_t i = 0; i < rows; ++i) {
    EXPECT_NEAR(model[i] - measured[i], left[i], 1e-6 * std::abs(measured[i]) + 1e-12);
    square += left[i] * left[i] / static_cast<double>(rows);
  }
  EXPECT_NEAR(std::sqrt(square), part["report"]["fit"]["rmse"],
              1e-4 * std::sqrt(square) + 1e-9 * c.scale);
  EXPECT_NEAR(part["charts"][0]["curves"][0]["x"][0], c.first_x, 1e-9);
  EXPECT_LT(std::sqrt(square), 0.05 * c.scale) << "it fits";

  // Where the report tells bands they lie about the model's line, as wide everywhere.
  const Json& report = part["report"];
  ASSERT_EQ(bands.size(), report.contains("band") ? 2 : 0);
  EXPECT_EQ(report.contains("band"), c.method[0] == "creep");
  for (const Json& band : bands) {
    const double half = report["band"][band["label"] == "68 % band" ? "half_68" : "half_95"];
    ASSERT_EQ(band["y"].size(), rows);
    for (std::size_t i = 0; i < rows; ++i) {
      EXPECT_NEAR(band["y"][i].get<double>() + half, model[i], 1e-6 * c.scale);
      EXPECT_NEAR(band["y_high"][i].get<double>() - half, model[i], 1e-6 * c.scale);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, IdentifyPage,
                         ::testing::Values(Case{{"geometry"}, mesh, 4, 0.065, 0.01},
                                           Case{{"valve"}, chart(), 7, 1e5, 0.02},
                                           Case{{"creep"}, hold(), 60, 0, 50},
                                           Case{{"sensor"}, weights(), 9, 0, 2}),
                         [](const auto& each) { return each.param.method[0]; });

TEST(IdentifyPages, StandBesideTheParameterFileUnlessNobodyWantsThem) {
  if (!SINEW_HAS_PAGE) GTEST_SKIP() << "built without npm";
  const Workspace w;
  write_text(w / "data.csv", mesh);
  EXPECT_EQ(w.sinew({"identify", "geometry", "data.csv", "-o", "a.toml"}).code, 0);
  EXPECT_THAT(names_in(w.path()), Contains("a.html"));
  const Json run = page(w / "a.html");
  bool fitted = false;
  for (const Json& row : run["parameters"])
    fitted = fitted || (row[0].get<std::string>().ends_with("braid.turns") && row[2] == "fit");
  EXPECT_TRUE(fitted) << "with the values of the parameter file";
  EXPECT_EQ(w.sinew({"identify", "geometry", "data.csv", "-o", "b.toml", "--no-report"}).code, 0);
  EXPECT_THAT(names_in(w.path()), Not(Contains("b.html")));
  w.sinew({"identify", "geometry", "data.csv"});
  EXPECT_THAT(names_in(w.path()), Not(Contains("data.html")));
}

TEST(IdentifyPages, TakeNobodysFileAway) {
  if (!SINEW_HAS_PAGE) GTEST_SKIP() << "built without npm";
  const Workspace w;
  write_text(w / "data.csv", mesh);
  const auto geometry = [&](const Words& more) {
    Words words{"identify", "geometry", "data.csv"};
    words.insert(words.end(), more.begin(), more.end());
    return w.sinew(words);
  };
  ASSERT_EQ(geometry({"--report", "a.html"}).code, 0);
  const std::string first = read_text(w / "a.html");
  const Result again = geometry({"--report", "a.html"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, AllOf(HasSubstr("a.html"), HasSubstr("--force")));
  EXPECT_EQ(geometry({"--report", "a.html", "--force"}).code, 0);
  EXPECT_EQ(read_text(w / "a.html"), first) << "the same bytes";

  // Beside -o too, before anything is written.
  write_text(w / "mine.html", "<p>mine</p>");
  for (const Words& words : {Words{"-o", "mine.toml"}, Words{"-o", "mine.toml", "--force"}}) {
    const Result refused = geometry(words);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("mine.html"));
  }
  EXPECT_EQ(read_text(w / "mine.html"), "<p>mine</p>");
  EXPECT_FALSE(std::filesystem::exists(w / "mine.toml"));
  EXPECT_EQ(geometry({"-o", "mine.toml", "--no-report"}).code, 0);

  const Result same = geometry({"-o", "both.html"});
  EXPECT_EQ(same.code, 2);
  EXPECT_THAT(same.err, AllOf(HasSubstr("the page's name too"), HasSubstr("--no-report")));
  EXPECT_EQ(geometry({"--report", "c.html", "--no-report"}).code, 2);
  const Result counted = w.sinew({"identify", "geometry", "--trapezoids", "37,16", "--side",
                                  "0.057 in", "--report", "d.html"});
  EXPECT_EQ(counted.code, 2);
  EXPECT_THAT(counted.err, HasSubstr("expected a file of lengths"));
}

}  // namespace
}  // namespace sinew::test::identify_page_test
