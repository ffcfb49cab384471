#include "sinew/report/page/stand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "sinew/actuator/braid.h"
#include "sinew/analysis/record/test_log.h"
#include "sinew/config/compose.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/report/page/test_run.h"
#include "tests/places.h"

namespace sinew::report::stand_test {
namespace {

using analysis::test::constant;

std::string path_of(const std::string& experiment) {
  return sinew::test::source_dir().append("/experiments/rig/").append(experiment);
}
constexpr double pound = 4.4482216152605;

struct Drawn {
  config::Node resolved;
  analysis::Machine machine;
  signals::Table table, drawn;
  Channels channels;
  Stand stand;

  Drawn(const std::string& experiment, analysis::test::Log log,
        const std::vector<std::string>& sets = {})
      : resolved(config::compose(path_of(experiment), sets)),
        machine(analysis::read_machine(resolved)),
        table(std::move(log.table)) {
    channels.add(table);
    stand = report::stand(channels, machine, drawn);
    channels.add(drawn);
  }
  const signals::Column& values(const Channel& c) const { return *channels.find(c).values; }
};

// Returns a log of 60 s with a sample every 10 ms and a length that oscillates.
analysis::test::Log hanging() {
  analysis::test::Log log(6000);
  log.scalar("/true/stand/length", [](double t) { return 0.08 + 0.01 * std::sin(t); });
  log.scalar("/true/stand/force", [](double t) { return 20 + 5 * std::sin(t); });
  log.scalar("/true/muscle/bpa/pressure", constant(5e5));
  return log;
}

TEST(Stand, SwellsTheActuatorAsTheBraidDoes) {
  const Drawn d("weights-60.toml", hanging());
  const actuator::Braid braid{.thread_length = 4.218 * 0.0254, .turns = 2.3125};
  const signals::Column& length = d.values(d.stand.length);
  for (std::size_t i = 0; i < length.size(); i += 97)
    EXPECT_NEAR(d.values(d.stand.diameter)[i], actuator::diameter(braid, length[i]), 1e-6);
  EXPECT_NEAR(d.stand.shortest, actuator::shortest_length(braid), 1e-6);
  EXPECT_EQ(d.stand.turns, braid.turns);
  EXPECT_EQ(d.stand.air, Stand::Air::sealed);
  EXPECT_EQ(d.stand.drawn_from, "true values");
}

// A hook of 0.1 lb; the load rises by 1 lb within 1 s of every two, up to 15 lb, and falls again.
TEST(Stand, HangsWhatTheFileHangs) {
  const Drawn d("weights-60.toml", hanging());
  const signals::Column& weight = d.values(d.stand.weight);
  for (const auto& [seconds, pounds] : std::map<double, double>{
           {0, 0}, {0.5, 0}, {1, 0.5}, {2, 1}, {3, 1.5}, {30, 15}, {31, 14.5}, {59.9, 0}})
    EXPECT_NEAR(weight[static_cast<std::size_t>(std::lround(100 * seconds))],
                (pounds + 0.1) * pound, 1e-9)
        << seconds;
  EXPECT_NEAR(d.stand.heaviest, 15.1 * pound, 1e-9);
  EXPECT_NEAR(d.stand.weight_step, pound, 1e-9);
}

TEST(Stand, TakesWeightsFromTheirInstantsOn) {
  const Drawn d("trapped-60-6.toml", hanging(),
                {"load.weights=[{at=\"0 s\",mass=\"2 kg\"},{at=\"5 s\",mass=\"3 kg\"}]"});
  const signals::Column& weight = d.values(d.stand.weight);
  EXPECT_NEAR(weight[499], 2 * 9.80665, 1e-9);
  EXPECT_NEAR(weight[500], 3 * 9.80665, 1e-9);
  EXPECT_NEAR(d.stand.weight_step, 9.80665, 1e-9);
}

TEST(Stand, KnowsItsValves) {
  EXPECT_EQ(Drawn("pwm-25hz-5lb.toml", hanging()).stand.air, Stand::Air::three_way);
  EXPECT_EQ(Drawn("feedback.toml", hanging()).stand.air, Stand::Air::valves);
  EXPECT_EQ(Drawn("length-sweep.toml", hanging()).stand.air, Stand::Air::regulated);
}

// A log of hardware has no topics under /true, and its pressure transducer reads gauge.
TEST(Stand, IsDrawnFromSensorsWhereThereIsNoTruth) {
  analysis::test::Log log(100);
  log.scalar("/sensor/length/value", constant(0.08));
  log.scalar("/sensor/pressure/value", constant(4e5));
  log.scalar("/sensor/force/value", constant(10));
  const Drawn d("isometric.toml", log);
  EXPECT_EQ(d.stand.drawn_from, "measured values");
  EXPECT_EQ(d.stand.load, Stand::Load::clamped);
  EXPECT_NEAR(d.values(d.stand.pressure)[0], 4e5 + d.machine.atmosphere, 1e-9);
  EXPECT_EQ(d.values(d.stand.tension)[0], 10);
  EXPECT_TRUE(Drawn("isometric.toml", analysis::test::Log(10)).stand.empty());
}

TEST(Stand, OfACylinderHasItsMeasures) {
  const Drawn d("sealed-cylinder.toml", hanging());
  EXPECT_NEAR(d.stand.bore, 0.627 * 0.0254, 1e-9);
  EXPECT_NEAR(d.stand.longest, 2 * 0.0254, 1e-9);
  EXPECT_EQ(d.stand.load, Stand::Load::driven);
  EXPECT_TRUE(d.stand.diameter.is_empty());
}

TEST(StandCharts, AreOfWhatMoves) {
  const Drawn d("weights-60.toml", hanging());
  const std::vector<Plot> charts = stand_charts(d.channels, d.stand);
  ASSERT_EQ(charts.size(), 1u) << "the pressure stands still";
  EXPECT_EQ(charts[0].title, "Tension against length");
  EXPECT_EQ(charts[0].curves[0].x_channel.topic, "/true/stand/length");
}

TEST(StandCharts, OfASweepAreOverItsDuties) {
  analysis::test::Log log(3);
  log.scalar("/sweep/duty", [](double t) { return 10 * t; });
  log.scalar("/true/sweep/length", [](double t) { return 0.1 - t; });
  const Drawn d("duty-sweep.toml", log);
  const std::vector<Plot> charts = stand_charts(d.channels, d.stand);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_EQ(charts[0].x.unit, "share");
  EXPECT_EQ(charts[0].curves[0].xs, d.values({"/sweep/duty"}));
  EXPECT_TRUE(panels(d.channels, d.machine).empty()) << "it has no time";
}

TEST(StandPanels, ShowEveryChannelOnceButWhatIsDrawnOtherwise) {
  analysis::test::Log log = hanging();
  log.scalar("/sensor/length/value", constant(0.08)).scalar("/sensor/length/count", constant(80));
  log.scalar("/desired/length", constant(0.08)).scalar("/sensor/odd/value", constant(1));
  log.pulses("/valve/bpa/inlet/open", 0.002, 3);
  for (signals::Series& s : log.table.series)
    s.topic.fields[0].unit.assign(1, s.topic.name.ends_with("length/value") ? 'm' : '1');
  Channels channels;
  channels.add(log.table);
  std::map<std::string, int> times;
  for (const Plot& p :
       panels(channels, analysis::read_machine(config::compose(path_of("feedback.toml")))))
    for (const Curve& c : p.curves) times[c.y_channel.topic] += 1;
  for (const signals::Series& s : log.table.series)
    EXPECT_EQ(times[s.topic.name], s.topic.name.ends_with("/open") ? 0 : 1) << s.topic.name;
}

TEST(StandContent, RefersOnlyToColumnsThatAreThere) {
  const Drawn d("feedback.toml", hanging());
  const auto run = nlohmann::json::parse(test::content_of(d.table, d.resolved, "feedback").json);
  const std::size_t columns = run["samples"]["columns"].size();
  for (const char* key : {"length", "diameter", "pressure", "tension", "weight"})
    EXPECT_LT(run["stand"][key], columns) << key;
  EXPECT_TRUE(run["stand"]["desired"].is_null());
  EXPECT_EQ(run["stand"]["air"], "valves");
  for (const auto& chart : run["charts"])
    for (const auto& curve : chart["curves"]) EXPECT_LT(curve["x"], columns);
  const auto nothing = nlohmann::json::parse(test::content_of({}, d.resolved, "").json);
  EXPECT_TRUE(nothing["stand"].is_null());
}

}  // namespace
}  // namespace sinew::report::stand_test
