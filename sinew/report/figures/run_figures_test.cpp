#include "sinew/report/figures/run_figures.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "sinew/config/compose.h"
#include "sinew/report/figures/figure_layout.h"
#include "sinew/report/page/test_run.h"
#include "tests/places.h"

namespace sinew::report::run_figures_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Kind = Curve::Kind;

config::Node walk() {
  return config::compose(sinew::test::source_dir() + "/experiments/walk-test-1.toml", {});
}

// Returns the log of a walk with the units of a real run.
signals::Table logged() {
  signals::Table table = test::walking(analysis::read_machine(walk()));
  for (signals::Series& s : table.series)
    for (const auto& [end, unit] : {std::pair("/angle", "rad"), std::pair("/pressure", "Pa")})
      if (s.topic.name.ends_with(end)) s.topic.fields[0].unit = unit;
  return table;
}

std::vector<Figure> figures(const signals::Table& table, const RunFigureOptions& options = {},
                            const config::Node& resolved = walk()) {
  const analysis::Analysis analysis(table, analysis::read_machine(resolved));
  return run_figures({.analysis = analysis, .resolved = resolved, .name = "walk-test-1"}, options);
}

const Figure& named(const std::vector<Figure>& list, const std::string& name) {
  const auto at = std::ranges::find(list, name, &Figure::name);
  if (at == list.end()) throw std::out_of_range(name);
  return *at;
}

const Curve& labelled(const Figure& figure, const std::string& label) {
  for (const Plot& plot : figure.plots)
    for (const Curve& c : plot.curves)
      if (c.label == label) return c;
  throw std::out_of_range(label);
}

TEST(RunFigures, ShowTheSamplesOfTheLogInTheirUnit) {
  const signals::Table table = logged();
  const signals::Column& angle = *table.column("/joint/hip/angle");
  for (const auto& [units, scale] :
       {std::pair(units::UnitSet::si, 1.0), std::pair(units::UnitSet::thesis, 180 / M_PI)}) {
    const std::vector<Figure> list = figures(table, {.units = units});
    const Curve& hip = labelled(named(list, "joint-angles"), "hip");
    ASSERT_EQ(hip.ys.size(), angle.size());
    for (std::size_t i = 0; i < angle.size(); ++i)
      EXPECT_NEAR(hip.ys[i] / scale, angle[i], 1e-12 * angle[i]);
  }
  const std::vector<Figure> list = figures(table, {.units = units::UnitSet::thesis});
  EXPECT_EQ(named(list, "pressure").plots[0].y.unit, "psi gauge");
  EXPECT_EQ(named(list, "joint-angles").plots[0].y.title(), "joint angles [deg]");
}

TEST(RunFigures, DistinguishDesiredFromActualAndLeaveOutWhatThePageHides) {
  const std::vector<Figure> list = figures(logged());
  const Figure& angles = named(list, "joint-angles");
  EXPECT_EQ(labelled(angles, "hip").kind, Kind::computed);
  EXPECT_EQ(labelled(angles, "hip desired").kind, Kind::desired);
  EXPECT_EQ(labelled(angles, "hip desired").color, labelled(angles, "hip").color);
  EXPECT_THROW(labelled(angles, "hip true"), std::out_of_range);
  EXPECT_THAT(angles.caption,
              AllOf(HasSubstr("Walking, test 1"), HasSubstr("simulated"), HasSubstr("Dotted"),
                    HasSubstr("Shaded: stance"), HasSubstr("seed 1")));
}

TEST(RunFigures, OfALogWithoutTruthAreMeasured) {
  signals::Table table = logged();
  std::erase_if(table.series,
                [](const signals::Series& s) { return s.topic.name.starts_with("/true/"); });
  const std::vector<Figure> list = figures(table);
  EXPECT_EQ(labelled(named(list, "joint-angles"), "hip").kind, Kind::measured);
  EXPECT_THAT(named(list, "joint-angles").caption, Not(HasSubstr("simulated,")));
  EXPECT_EQ(std::ranges::find(list, "pressure", &Figure::name), list.end());
}

TEST(RunFigures, ShowTheFootsPathAsLongInXAsInY) {
  const std::vector<Figure> list = figures(logged());
  const Figure& path = named(list, "foot-path");
  EXPECT_TRUE(path.plots[0].equal_scale);
  EXPECT_EQ(path.plots[0].x.unit, path.plots[0].y.unit);
  EXPECT_EQ(path.plots[0].x.unit, "mm");
}

TEST(RunFigures, ShowNothingOutsideTheirTime) {
  const std::vector<Figure> list = figures(logged(), {.from = 0.5, .to = 0.8});
  for (const Figure& figure : list)
    for (const Plot& plot : figure.plots)
      for (const Curve& c : plot.curves) {
        EXPECT_FALSE(c.xs.empty());
        if (plot.x.unit != "s") continue;
        EXPECT_GE(c.xs.front(), 0.5);
        EXPECT_LE(c.xs.back(), 0.8);
      }
  EXPECT_TRUE(figures(logged(), {.from = 1e6}).empty());
}

TEST(RunFigures, HaveNamesOfTheirOwnAndShadeStance) {
  std::set<std::string> names;
  for (const Figure& figure : figures(logged())) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
    EXPECT_EQ(file_name_of(figure.name), figure.name);
    EXPECT_NO_THROW(data(figure));
    if (figure.plots[0].x.unit != "s") continue;
    // Three steps have three spans, because foot plant and propulsion are joined.
    EXPECT_EQ(figure.plots[0].spans.size(), 3u) << figure.name;
  }
}

// The times of faults are shaded between lines, and the caption has the faults.
TEST(RunFigures, ShadeTheTimesOfFaults) {
  const config::Node broken = config::compose(
      sinew::test::source_dir() + "/experiments/walk-test-1.toml",
      {R"(fault=[{ at = "0.4 s", for = "200 ms", of = "knee_extensor.inlet", what = "stuck open" },)"
       R"( { at = "0.9 s", of = "supply", what = "failed" },)"
       R"( { at = "1 h", of = "hip_flexor", what = "blocked" }])"});
  const signals::Table table = logged();
  const auto faults = [&](const RunFigureOptions& options) {
    std::vector<Span> out;
    const Figure figure = named(figures(table, options, broken), "joint-angles");
    for (const Span& s : figure.plots[0].spans)
      if (s.of == Span::Of::fault) out.push_back(s);
    const bool told = figure.caption.find("broken on purpose: ") != std::string::npos;
    EXPECT_EQ(told, !out.empty()) << figure.caption;
    if (out.size() == 2) {
      EXPECT_THAT(figure.caption, HasSubstr("knee_extensor.inlet stuck open from 0.4 s to 0.6 s, "
                                            "supply failed from 0.9 s on."));
    }
    return out;
  };
  const std::vector<Span> whole = faults({});
  ASSERT_EQ(whole.size(), 2u) << "one begins after the end";
  EXPECT_NEAR(whole[0].to, 0.6, 1e-12);
  const double end = 1e-9 * static_cast<double>(table.find("/joint/hip/angle")->time_ns.back());
  EXPECT_NEAR(whole[1].to, end, 0.02);
  EXPECT_EQ(faults({.from = 0.7, .to = 0.8}).size(), 0u);
  EXPECT_EQ(faults({.from = 0.5, .to = 0.8}).size(), 1u);
}

}  // namespace
}  // namespace sinew::report::run_figures_test
