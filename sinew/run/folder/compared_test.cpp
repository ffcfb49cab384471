// A measurement is aligned with a simulation although their clocks differ, and the remaining
// difference shows which parameter differs.
#include "sinew/run/folder/page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <random>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/run/folder/replayed.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::run::compared_test {
namespace {

namespace fs = std::filesystem;

const std::string bench = sinew::test::source_dir() + "/experiments/one-joint.toml";

// The recording of a laboratory: angle and tensions only, at its own rate, by a clock that began
// earlier and is 0.3 % fast, with noise.
struct Laboratory {
  analysis::Clock clock{2.371, 0.003};
  double period = 0.008;  // sampling period [s]
  double noise = 0.004;   // sigma, share of each channel's range
  unsigned seed = 5;
};

signals::Series measured(const signals::Series& was, const Laboratory& lab, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  const analysis::Signal truth = analysis::signal_of("", {&was.time_ns, &was.columns[0]});
  const double sigma = lab.noise * analysis::spread_of(truth).range;
  analysis::Reader reader(truth);
  signals::Series out{was.topic, {}, {{}}};
  const double end = lab.clock.other(truth.time.back());
  for (double t = 0; t < end; t += lab.period) {
    const double then = std::max(lab.clock.first(t), truth.time.front());
    out.time_ns.push_back(std::llround(1e9 * t));
    out.columns[0].push_back(reader.at(std::min(then, truth.time.back())) + sigma * normal(random));
  }
  return out;
}

signals::Table measured(const signals::Table& simulated, const Laboratory& lab) {
  signals::Table out;
  for (const char* topic :
       {"/joint/lever/angle", "/muscle/flexor/tension", "/muscle/extensor/tension"})
    if (const signals::Series* s = simulated.find(topic))
      out.series.push_back(measured(*s, lab, lab.seed + static_cast<unsigned>(out.series.size())));
  return out;
}

class Compared : public ::testing::Test {
 protected:
  Compared() { fs::create_directories(root_); }
  ~Compared() override { fs::remove_all(root_); }

  // Stores a simulation, or a measurement of one, and returns its folder.
  std::string keep(const std::string& name, const std::vector<std::string>& sets,
                   const Laboratory* lab) {
    const experiment::Experiment e = buildable(bench, sets);
    const Outcome outcome = run::run(e);
    const signals::Table table = lab ? measured(outcome.table, *lab) : outcome.table;
    // A laboratory does not know its machine's parameters, so it imports with those of the model.
    const experiment::Experiment believed = lab ? buildable(bench) : e;
    return store_table(table, believed, {.folder = (root_ / name).string(), .report = false})
        .folder.string();
  }

  static report::AlignOptions by_correlation(bool fit_clock) {
    report::AlignOptions align_options(report::Align::correlation);
    align_options.fit_clock = fit_clock;
    return align_options;
  }

  static const analysis::Difference& angle(const report::Comparison& c) {
    for (const report::ChannelRow& row : c.channels)
      if (row.channel.topic == "/joint/lever/angle") return *row.differences[1];
    throw std::runtime_error("no angle");
  }

  const fs::path root_ = fs::temp_directory_path() / ("sinew-compared-" + std::to_string(getpid()));
};

TEST_F(Compared, AnotherClockIsFoundAndWhatIsLeftIsNoise) {
  const Laboratory lab;
  const std::string a = keep("a", {}, nullptr), b = keep("b", {}, &lab);
  const report::Comparison c = compare_runs({a, b}, by_correlation(true));
  ASSERT_TRUE(c.runs[1].alignment);
  const analysis::Alignment& found = *c.runs[1].alignment;
  EXPECT_NEAR(found.clock.rate, 0.003, 4e-4);
  EXPECT_NEAR(found.clock.shift, 2.371, 0.006);
  EXPECT_LT(found.rate_uncertainty, 4e-4);
  EXPECT_GT(found.correlation, 0.995);
  EXPECT_LT(angle(c).share(), 0.012);  // noise 0.004, and the quantization of the lever's angle
  EXPECT_GT(angle(c).correlation, 0.995);

  const Json json = Json::parse(to_json(c));
  EXPECT_EQ(json["align"], "correlation");
  EXPECT_EQ(json["clock"], "fit");
  EXPECT_NEAR(json["runs"][1]["alignment"]["rate"].number(), 0.003, 4e-4);
}

TEST_F(Compared, ADifferenceOfParametersIsWhatIsLeft) {
  const Laboratory lab;
  const std::string a = keep("a", {}, nullptr), b = keep("b", {}, &lab);
  const std::string other = keep("other", {"joint.lever.damping=1.6 lbf in s/rad"}, &lab);
  const report::Comparison same = compare_runs({a, b}, by_correlation(true));
  const report::Comparison apart = compare_runs({a, other}, by_correlation(true));
  EXPECT_NEAR(apart.runs[1].alignment->clock.rate, 0.003, 2e-3);
  EXPECT_GT(angle(apart).rms, 2 * angle(same).rms);
}

TEST_F(Compared, WhatIsLeftIsWrittenAsATable) {
  const Laboratory lab;
  const std::string a = keep("a", {}, nullptr), b = keep("b", {}, &lab);
  const std::string csv =
      residuals_csv(compare_runs({a, b}, by_correlation(true), {"/joint/lever/angle"}));
  EXPECT_TRUE(csv.starts_with("time [s],B /joint/lever/angle [rad]\n")) << csv.substr(0, 100);
  EXPECT_GT(std::ranges::count(csv, '\n'), 500);
}

TEST_F(Compared, AConstantMeasurementIsRefusedByItsName) {
  Laboratory lab;
  const std::string a = keep("a", {}, nullptr);
  lab.noise = 0;
  const experiment::Experiment e = buildable(bench);
  signals::Table still = measured(run::run(e).table, lab);
  for (signals::Series& s : still.series) s.columns[0].assign(s.time_ns.size(), 1.0);
  const std::string b =
      store_table(still, e, {.folder = (root_ / "still").string(), .report = false})
          .folder.string();
  try {
    (void)compare_runs({a, b}, by_correlation(false));
    ADD_FAILURE() << "aligned with each other";
  } catch (const config::Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("still"), text.npos) << text;
    EXPECT_NE(text.find("no common channel that moves"), text.npos) << text;
  }
}

TEST_F(Compared, AReplayOfThePlantIsKeptAndReported) {
  const std::string a = keep("a", {}, nullptr);
  ReplayRequest request{.run = a, .of = ReplayOf::plant, .folder = (root_ / "replayed").string()};
  const Replayed same = replay_run(request);
  EXPECT_TRUE(same.agrees());
  EXPECT_TRUE(fs::exists(root_ / "replayed" / "log.mcap"));
  request.sets = {"joint.lever.damping=1.6 lbf in s/rad"};
  request.force = true;
  const Replayed other = replay_run(request);
  EXPECT_FALSE(other.agrees());
  const Json json = Json::parse(to_json(other));
  EXPECT_EQ(json["of"], "plant");
  EXPECT_TRUE(json["channels"][0]["parts_at_s"].is_number());
  EXPECT_NE(text_of(other, units::UnitSet::metric, 0).find("/joint/lever/angle"),
            std::string::npos);
}

TEST_F(Compared, AReplayWithoutWhatItNeedsNamesTheTopics) {
  const Laboratory lab;
  const std::string b = keep("b", {}, &lab);
  for (const auto& [of, topic] : {std::pair{ReplayOf::plant, "/valve/flexor/inlet/open"},
                                  std::pair{ReplayOf::controller, "/sensor/lever_angle/count"}})
    try {
      (void)replay_run({.run = b, .of = of});
      ADD_FAILURE() << "replayed";
    } catch (const config::Error& error) {
      EXPECT_NE(std::string(error.what()).find(topic), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace sinew::run::compared_test
