#include "sinew/report/page/page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/test_run.h"
#include "tests/places.h"

namespace sinew::report::page_test {
namespace {

using Json = nlohmann::ordered_json;

const std::string walk = sinew::test::source_dir() + "/experiments/walk-test-1.toml";

config::Node resolved(const std::vector<std::string>& sets = {}) {
  return config::compose(walk, sets);
}

signals::Table table() { return test::walking(analysis::read_machine(resolved())); }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

const std::string small_template =
    "<title>@title@</title><script id=a>@run@</script><script id=b>@samples@</script>";

// --- filling ---

TEST(Fill, PutsEveryTextInItsPlace) {
  EXPECT_EQ(fill(small_template, {"A walk", "{}", "AAAA"}),
            "<title>A walk</title><script id=a>{}</script><script id=b>AAAA</script>");
  EXPECT_EQ(fill("@samples@ @run@ @title@", {"t", "r", "s"}), "s r t");
}

TEST(Fill, LetsNothingLeaveItsElement) {
  const std::string bad = "</script></title><script>alert(1)</script><!-- & \" @samples@ @run@";
  const Json run = {{"title", bad}};
  const std::string html = fill(small_template, {bad, run.dump(), "AAAA"});
  EXPECT_EQ(count(html, "<script"), 2u);
  EXPECT_EQ(count(html, "</script"), 2u);
  EXPECT_EQ(count(html, "</title"), 1u);
  EXPECT_EQ(count(html, "<!--"), 0u);
  EXPECT_EQ(count(html, "AAAA"), 1u) << "a mark in a text is text";

  const std::string opening = "<script id=a>";
  const std::size_t from = html.find(opening) + opening.size();
  const std::string json = html.substr(from, html.find("</script>", from) - from);
  EXPECT_EQ(Json::parse(json)["title"], bad) << "and it reads back as it was";
}

TEST(Fill, RefusesATemplateWithoutAPlace) {
  for (const char* text : {"", "@title@ @run@", "@run@ @samples@", "@title@ @samples@"})
    EXPECT_THROW(fill(text, {}), std::invalid_argument) << text;
}

// --- content ---

TEST(Content, IsTheSameForTheSameRun) {
  const config::Node node = resolved();
  const signals::Table a = table(), b = table();
  const Content first = test::content_of(a, node, "walk"),
                second = test::content_of(b, node, "walk");
  EXPECT_EQ(first.json, second.json);
  EXPECT_EQ(first.samples, second.samples);
}

TEST(Content, HoldsTheSummaryAsItIs) {
  const config::Node node = resolved();
  const signals::Table t = table();
  const Json run = Json::parse(test::content_of(t, node, "walk").json);
  const auto machine = analysis::read_machine(node);
  EXPECT_EQ(run["summary"], Json::parse(to_json(analysis::summarize(t, machine))));
  EXPECT_EQ(run["verdicts"].size(), machine.reported.size());
  EXPECT_EQ(run["title"], machine.title);
  EXPECT_EQ(run["robot"], "leg");
  EXPECT_EQ(run["name"], "walk");
  EXPECT_FALSE(run["summary"].contains("host")) << "differs from run to run";
}

TEST(Content, RefersOnlyToColumnsThatAreThere) {
  const config::Node node = resolved();
  const signals::Table t = table();
  const Json run = Json::parse(test::content_of(t, node, "").json);
  const std::size_t columns = run["samples"]["columns"].size();
  for (const Json& panel : run["panels"])
    for (const Json& line : panel["lines"]) EXPECT_LT(line["column"], columns) << panel["title"];
  for (const Json& frame : run["scene"]["frames"]) EXPECT_LT(frame["x"], columns);
  for (const Json& m : run["scene"]["muscles"]) {
    EXPECT_LT(m["length"], columns);
    EXPECT_LT(m["inlet"], columns);
    EXPECT_TRUE(m["exhaust"].is_null()) << "not logged";
  }
  for (const Json& clock : run["samples"]["columns"])
    EXPECT_LT(clock, run["samples"]["clocks"].size());
}

TEST(Content, OfAnEmptyLogIsAPageWithoutReplay) {
  const config::Node node = resolved();
  const signals::Table nothing;
  const Json run = Json::parse(test::content_of(nothing, node, "").json);
  EXPECT_TRUE(run["scene"].is_null());
  EXPECT_TRUE(run["panels"].empty());
  EXPECT_EQ(run["duration"], 0.0);
  EXPECT_FALSE(run["parameters"].empty());
}

TEST(Page, ReportsWhatIsMissingWithoutNpm) {
  const config::Node node = resolved();
  const signals::Table t = table();
  const analysis::Analysis analysis(t, analysis::read_machine(node));
  if (has_page()) {
    EXPECT_GT(page({analysis, node, ""}).size(), 50000u);
    return;
  }
  try {
    page({analysis, node, ""});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("npm ci in web/"), std::string::npos) << e.what();
  }
}

// --- panels ---

Plot panel(const std::vector<Plot>& all, const std::string& title) {
  for (const Plot& p : all)
    if (p.title == title) return p;
  return {};
}

TEST(Panels, ShowEveryChannelOnceButWhatIsDrawnOtherwise) {
  const analysis::Machine m = test::machine();
  const signals::Table t = test::walking(m);
  Channels channels;
  channels.add(t);
  const std::vector<Plot> all = panels(channels, m);
  for (const signals::Series& s : t.series) {
    int times = 0;
    for (const Plot& p : all)
      for (const Curve& c : p.curves) times += c.y_channel.topic == s.topic.name;
    const bool apart = s.topic.name.starts_with("/plan/") || s.topic.name.ends_with("/open");
    const int fields = static_cast<int>(s.topic.fields.size());
    EXPECT_EQ(times, apart ? 0 : fields) << s.topic.name;
  }
}

TEST(Panels, HideTheTruthOnlyWhereAMeasurementStandsForIt) {
  const analysis::Machine m = test::machine();
  analysis::test::Log log(10);
  for (const char* topic : {"/joint/hip/angle", "/true/joint/hip/angle", "/true/joint/knee/angle"})
    log.scalar(topic, analysis::test::constant(1));
  Channels channels;
  channels.add(log.table);
  const Plot angles = panel(panels(channels, m), "Joint angles");
  ASSERT_EQ(angles.curves.size(), 3u);
  EXPECT_FALSE(angles.curves[0].hidden);
  EXPECT_TRUE(angles.curves[1].hidden);
  EXPECT_FALSE(angles.curves[2].hidden) << "of the knee there is nothing else";
  EXPECT_EQ(angles.curves[0].color, angles.curves[1].color);
  EXPECT_NE(angles.curves[0].color, angles.curves[2].color);
}

TEST(Panels, TakeWhatNobodyKnowsByItsUnit) {
  analysis::test::Log log(10);
  log.scalar("/stand/a", analysis::test::constant(1))
      .scalar("/stand/b", analysis::test::constant(1));
  log.scalar("/stand/c", analysis::test::constant(1));
  log.table.series[0].topic.fields[0].unit = log.table.series[2].topic.fields[0].unit = "N";
  log.table.series[1].topic.fields[0].unit = "m";
  Channels channels;
  channels.add(log.table);
  const std::vector<Plot> all = panels(channels, {});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].y.unit, "N");
  EXPECT_EQ(all[0].curves.size(), 2u);
  EXPECT_EQ(all[1].y.unit, "m");
  EXPECT_EQ(all[1].group, "Other");
}

// --- parameters ---

TEST(Parameters, ComeWithTheirSources) {
  const config::Node node = config::parse_text(R"(
format = "sinew.experiment/2"
title = "T"
empty = []
[joint.hip]
damping = { value = "1 N m s/rad", fit = true, range = ["0 N m s/rad", "2 N m s/rad"], source = "x" }
spring = { value = "0 N m/rad", source = "default" }
angles = ["1 rad", "2 rad"]
[[reported]]
key = "a"
)",
                                               "resolved.toml");
  const std::vector<Parameter> rows = parameters(node);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].key, "title");
  EXPECT_EQ(rows[1].key, "joint.hip.damping");
  EXPECT_EQ(rows[1].value, "1 N m s/rad");
  EXPECT_EQ(rows[1].mark, "fit");
  EXPECT_EQ(rows[1].range, "0 N m s/rad to 2 N m s/rad");
  EXPECT_EQ(rows[1].source, "x");
  EXPECT_EQ(rows[2].mark, "default");
  EXPECT_EQ(rows[2].source, "");
  EXPECT_EQ(rows[3].value, "1 rad, 2 rad");
}

TEST(Parameters, AreAlsoThoseOfListsOfTables) {
  const config::Node node = config::parse_text(R"(
[[change]]
time = "1 s"
value = { value = "2 N m/rad", source = "set while it ran" }
[[change]]
release = true
)",
                                               "resolved.toml");
  const std::vector<Parameter> rows = parameters(node);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].key, "change[0].time");
  EXPECT_EQ(rows[1].key, "change[0].value");
  EXPECT_EQ(rows[1].value, "2 N m/rad");
  EXPECT_EQ(rows[1].source, "set while it ran");
  EXPECT_EQ(rows[2].key, "change[1].release");
}

}  // namespace
}  // namespace sinew::report::page_test
