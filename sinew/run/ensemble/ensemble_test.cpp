// Runs of an ensemble equal single runs of the same values, to the bit, in every figure.
#include "sinew/run/ensemble/ensemble.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

#include "sinew/analysis/summary.h"
#include "sinew/card/walk.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/card/batch.h"
#include "sinew/run/ensemble/many.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/units/quantity.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::run::ensemble_test {
namespace {

const std::string experiments = test::source_dir() + "/experiments/";
const std::string walk = experiments + "walk-test-1.toml";
const std::string leg = experiments + "leg-in-air.toml";

using test::message;

// Numbers of the robot, its air, its controller, its start and its noise; two of them determine
// gains of the plan that the file does not give.
struct Parameter {
  std::string key, unit;
  double low = 0, high = 1;
};
const std::vector<Parameter> parameters = {
    {"joint.hip.angle_gain", "1/count", 2e-4, 6e-4},
    {"joint.knee.damping", "N m s/rad", 0.05, 0.5},
    {"link.femur.mass", "kg", 0.2, 0.4},
    {"valve.inlet.flow.area", "m2", 6e-7, 1.2e-6},
    {"start.pressure", "Pa abs", 1.02e5, 2e5},
    {"start.settle", "s", 0.1, 0.4},
    {"sequence.repeat", "", 1, 2},
    {"seed", "", 1, 1e6},
};

std::vector<std::string> keys_of(const std::vector<Parameter>& all) {
  std::vector<std::string> out;
  for (const Parameter& p : all) out.push_back(p.key);
  return out;
}

std::vector<double> draw(std::size_t rows, std::mt19937& random) {
  std::vector<double> out;
  for (std::size_t r = 0; r < rows; ++r)
    for (const Parameter& p : parameters) {
      const double value = std::uniform_real_distribution(p.low, p.high)(random);
      out.push_back(p.unit.empty() ? std::round(value) : value);
    }
  return out;
}

// A run whose file is read with these settings, without ensembles: the reference of all tests.
RunResult read_and_run(const std::string& file, const std::vector<std::string>& sets) {
  RunResult out;
  try {
    const config::Node root = config::compose(file, sets);
    const analysis::Machine machine = analysis::read_machine(root);
    const experiment::Experiment e = buildable(root, file);
    experiment::refuse_unreachable(e);
    out.summary = analysis::summarize(run(e).table, machine);
  } catch (const config::Error& e) {
    out.status = "refused: " + config::to_text(e.problems().front());
  }
  return out;
}

RunResult single(const std::string& file, std::span<const double> values) {
  std::vector<std::string> sets;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Parameter& p = parameters[i];
    sets.push_back(p.key + "=" +
                   (p.unit.empty() ? units::format_number(values[i])
                                   : units::format_quantity(values[i], p.unit)));
  }
  return read_and_run(file, sets);
}

// Compares a figure of runs of one file with settings: by ensembles, and by reading the file.
void expect_equal(const std::string& file, const std::vector<std::vector<std::string>>& runs,
                  const std::string& figure) {
  Ensembles ensembles({figure});
  for (const std::vector<std::string>& sets : runs) {
    const RunResult found = ensembles.run_once(file, sets), one = read_and_run(file, sets);
    const double *is = found.summary.find(figure), *expected = one.summary.find(figure);
    EXPECT_EQ(found.status, one.status) << sets.back();
    ASSERT_EQ(is != nullptr, expected != nullptr) << sets.back();
    if (is != nullptr) {
      EXPECT_EQ(*is, *expected) << sets.back();
    }
  }
}

const std::vector<std::string> figures = {"joints.hip.tracking_rms_rad",
                                          "air_used_kg",
                                          "muscles.knee_flexor.passiveness_delivered",
                                          "valves.switchings",
                                          "duration_s",
                                          "foot.step_repeat_rms_m",
                                          "no.such_figure"};

TEST(Ensemble, ARowHasTheBitsOfASingleRun) {
  std::mt19937 random(7);
  constexpr std::size_t rows = 12;
  const std::vector<double> values = draw(rows, random);
  const Ensemble ensemble(leg, {}, keys_of(parameters), figures);
  std::vector<double> found(rows * figures.size());
  const std::vector<std::string> status = ensemble.run(values, found, {.threads = 2});
  for (std::size_t r = 0; r < rows; ++r) {
    const RunResult one =
        single(leg, std::span(values).subspan(r * parameters.size(), parameters.size()));
    EXPECT_EQ(status[r], one.status) << r;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const double* expected = one.summary.find(figures[i]);
      const double is = found[r * figures.size() + i];
      if (expected)
        EXPECT_EQ(is, *expected) << r << " " << figures[i];
      else
        EXPECT_TRUE(std::isnan(is)) << r << " " << figures[i];
    }
  }
  EXPECT_EQ(found[1],
            *single(leg, std::span(values).first(parameters.size())).summary.find("air_used_kg"));
}

TEST(Ensemble, IsTheSameForAnyNumberOfThreadsAndLanes) {
  std::mt19937 random(8);
  const std::vector<double> values = draw(9, random);
  const Ensemble ensemble(leg, {}, keys_of(parameters), {"air_used_kg"});
  std::vector<double> alone(9), many(9);
  (void)ensemble.run(values, alone, {.threads = 1, .lanes = 1});
  for (const int threads : {1, 2, 5})
    for (const int lanes : {1, 2, 8}) {
      (void)ensemble.run(values, many, {.threads = threads, .lanes = lanes});
      EXPECT_EQ(alone, many) << threads << " threads, " << lanes << " lanes";
    }
}

// Walks that a card holds, with plans of their own and equal ones, and others: a row that is
// refused, one whose plan measures, and one that ends early.
TEST(Ensemble, ACardHasTheBitsOfTheProcessor) {
  if (card::walk_ptx().empty()) GTEST_SKIP() << "built without a program for graphics cards";
  ASSERT_TRUE(dlopen((test::build_dir() + "/tests/graphics_card/libcuda.so.1").c_str(), RTLD_NOW))
      << dlerror();
  const Device device = chosen({.kind = Device::Kind::gpu});
  const std::vector<std::string> all = {"trolley.distance_m",       "passiveness",
                                        "valves.switchings",        "joints.hip.tracking_rms_rad",
                                        "foot.step_repeat_rms_m",   "air_used_kg",
                                        "rollers.front.min_load_N", "no.such_figure_at_all"};
  const std::vector<std::string> keys = {"seed", "trolley.drag", "phase.swing.duration",
                                         "muscle.hip_flexor.count"};
  const Ensemble walks(walk, {}, keys, all);
  ASSERT_TRUE(fits_batch(walks.example()));
  std::mt19937 random(11);
  std::vector<double> values;
  for (int i = 0; i < 12; ++i)
    values.insert(values.end(), {1.0 + i, std::uniform_real_distribution(3.0, 5.0)(random),
                                 i % 3 == 0 ? 1.2 + 0.02 * i : 1.5, i == 5 ? -1.0 : 2.0});
  std::vector<double> on_card(12 * all.size()), here(on_card.size());
  const auto status = walks.run(values, on_card, {.threads = 2, .device = device});
  EXPECT_EQ(status, walks.run(values, here, {.threads = 2, .device = {Device::Kind::cpu}}));
  EXPECT_EQ(std::memcmp(on_card.data(), here.data(), here.size() * sizeof(double)), 0);
  EXPECT_NE(status[5], "ok");
}

TEST(Ensemble, TheProcessorReplacesAnAutomaticCardThatFails) {
  if (card::walk_ptx().empty()) GTEST_SKIP() << "built without a program for graphics cards";
  ASSERT_TRUE(dlopen((test::build_dir() + "/tests/graphics_card/libcuda.so.1").c_str(), RTLD_NOW))
      << dlerror();
  const Ensemble walks(leg, {"sequence.repeat=1", "start.settle=0.1 s"}, {"seed"}, {"air_used_kg"});
  std::vector<double> values, here(fewest_on_card), found(fewest_on_card);
  for (std::size_t i = 0; i < fewest_on_card; ++i) values.push_back(1.0 + static_cast<double>(i));
  (void)walks.run(values, here, {.device = {Device::Kind::cpu}});
  ::setenv("SINEW_FAKE_CARD", "wait", 1);
  EXPECT_EQ(walks.run(values, found, Ensemble::Options{}),
            std::vector<std::string>(fewest_on_card, "ok"));
  EXPECT_EQ(found, here);
  EXPECT_NE(message([&] {
              (void)walks.run(values, found, {.device = {Device::Kind::gpu}});
            }).find("cuCtxSynchronize: CUDA_ERROR_LAUNCH_FAILED, 719"),
            std::string::npos);
  ::unsetenv("SINEW_FAKE_CARD");
}

// A refused row has the words of a single run, and others are not disturbed.
TEST(Ensemble, ARefusedRowSaysWhy) {
  const Ensemble ensemble(leg, {}, {"link.femur.mass"}, {"air_used_kg"});
  const std::vector<double> values = {0.3, -1, std::nan(""), 1e9, 0.3};
  std::vector<double> found(values.size());
  const std::vector<std::string> status = ensemble.run(values, found);
  EXPECT_EQ(status[0], "ok");
  EXPECT_EQ(status[1], read_and_run(leg, {"link.femur.mass=-1 kg"}).status);
  EXPECT_NE(status[1].find("refused: "), std::string::npos);
  EXPECT_NE(status[2].find("refused: "), std::string::npos);
  EXPECT_EQ(status[3], read_and_run(leg, {"link.femur.mass=1e+09 kg"}).status);
  EXPECT_EQ(found[0], found[4]);
  EXPECT_TRUE(std::isnan(found[1]));
}

// A later setting overrides earlier ones, however it is written.
TEST(Ensemble, SettingsActInTheirOrder) {
  expect_equal(leg,
               {{"seed=2", "seed = 7", "joint.hip.damping=0.1 N m s/rad"},
                {"seed=2", "seed = 7", "joint.hip.damping=0.2 N m s/rad"},
                {"seed=7", "seed=2", "joint.hip.damping=0.3 N m s/rad"},
                {"joint.hip.damping=0.3 N m s/rad", "seed=5"}},
               "joints.hip.tracking_rms_rad");
}

TEST(Ensemble, AWholeNumberIsWrittenAsOne) {
  expect_equal(leg, {{"seed=2"}, {"seed=3"}, {"seed=4"}, {"seed=3.0"}, {"seed=300 %"}},
               "air_used_kg");
  const Ensemble ensemble(leg, {}, {"seed"}, {"air_used_kg"});
  std::vector<double> found(3);
  const auto status = ensemble.run(std::vector<double>{1.5e9, 7, 2.5}, found);
  EXPECT_EQ(status[0], "ok");
  EXPECT_NE(status[2].find("expected a whole number"), std::string::npos);
}

// Pressures in the file refer to the atmosphere, and so does a gauge pressure that is set.
TEST(Ensemble, TheAtmosphereDeterminesOtherNumbers) {
  expect_equal(leg,
               {{"air.atmosphere=90 kPa abs", "start.pressure=110 kPa abs"},
                {"air.atmosphere=91 kPa abs", "start.pressure=111 kPa abs"},
                {"air.atmosphere=92 kPa abs", "start.pressure=20 kPa gauge"}},
               "air_used_kg");
  Ensemble ensemble(leg, {"sequence.repeat=1"}, {"air.atmosphere"}, {"air_used_kg"});
  std::vector<double> values, alone(24), many(24);
  for (int i = 0; i < 24; ++i) values.push_back(90e3 + 10 * i);
  (void)ensemble.run(values, alone, {.threads = 1, .lanes = 1});
  (void)ensemble.run(values, many, {.threads = 8});
  EXPECT_EQ(alone, many);
}

TEST(Ensemble, AStandsDriveIsTheRunsOwn) {
  expect_equal(experiments + "rig/pwm-50hz-1lb.toml",
               {{"drive.period=20 ms"}, {"drive.period=25 ms"}, {"drive.period=50 ms"}},
               "pulsed.pressure_Pa");
}

TEST(Ensemble, AFaultStaysInEachRun) {
  expect_equal(experiments + "faults/valve-stuck-open.toml",
               {{"joint.hip.damping=0.1 N m s/rad"},
                {"joint.hip.damping=0.2 N m s/rad"},
                {"joint.hip.damping=0.3 N m s/rad"}},
               "joints.hip.tracking_rms_rad");
}

TEST(Ensemble, AnElementOfAListIsNotAParameter) {
  EXPECT_NE(message([] {
              Ensemble(experiments + "faults/sensor-open.toml", {}, {"fault[0].at"}, {});
            }).find("a number of the experiment"),
            std::string::npos);
}

TEST(Ensemble, RefusesAParameterThatIsNoNumber) {
  EXPECT_NE(message([] { Ensemble(leg, {}, {"joint.hip.dampign"}, {}); }).find("joint.hip.dampign"),
            std::string::npos);
  EXPECT_NE(message([] { Ensemble(leg, {}, {"title"}, {}); }).find("a number of the experiment"),
            std::string::npos);
  const Ensemble ensemble(leg, {}, {"seed"}, {"air_used_kg"});
  std::vector<double> room(1);
  EXPECT_THROW((void)ensemble.run(std::vector<double>{1, 2}, room), std::invalid_argument);
}

// A figure that does not exist is misspelt if one is similar; one that does not apply to a run is
// not a number, however similar others are.
TEST(Ensemble, RefusesAMisspeltFigure) {
  const std::vector<double> values = {1, 1};
  std::vector<double> found(2);
  const Ensemble wrong(leg, {}, {"seed"}, {"joints.hip.trakcing_rms_rad"});
  for (int again = 0; again < 2; ++again)
    EXPECT_NE(message([&] {
                (void)wrong.run(values, found);
              }).find("try \"joints.hip.tracking_rms_rad\""),
              std::string::npos);

  const char* key = "phases.swing.joints.hip.most_turning_points";
  const Ensemble once(leg, {}, {"sequence.repeat"}, {key});
  EXPECT_EQ(once.run(std::vector<double>{1, 2}, found), std::vector<std::string>(2, "ok"));
  EXPECT_TRUE(std::isnan(found[0]));
  EXPECT_FALSE(std::isnan(found[1]));
}

// Whether a muscle took air is a remark on every run, also if no channel of the figures shows it:
// the channel that shows it is then recorded, too.
TEST(Ensemble, SeesThatNoMuscleTookAir) {
  Ensembles ensembles({"duration_s"});
  const std::vector<std::string> shut = {"valve.inlet.flow.area=0 m2"};
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(ensembles.run_once(leg, shut).no_air) << i;
    EXPECT_FALSE(ensembles.run_once(leg, {"valve.inlet.flow.area=9e-7 m2"}).no_air) << i;
  }
  const auto recorded = ensembles.begin(leg, shut).member->selection->topics();
  EXPECT_TRUE(recorded.contains("/true/muscle/hip_flexor/air_in"));
}

// Each figure of a summary, computed from the topics that it needs alone.
TEST(Selection, EveryFigureNeedsOnlyItsTopics) {
  std::mt19937 random(9);
  for (const char* file : {"leg-in-air.toml", "walk-two-legs.toml", "walk-with-hoses.toml",
                           "walk-with-regulators.toml"}) {
    const std::string path = experiments + file;
    const config::Node root = config::compose(path, {"sequence.repeat=1"});
    const experiment::Experiment e = buildable(root, path);
    const analysis::Machine machine = analysis::read_machine(root);
    const signals::Table whole = run(e).table;
    const analysis::Summary all = analysis::summarize(whole, machine);
    for (const analysis::Entry& entry : all.entries()) {
      if (random() % 12 != 0) continue;
      const analysis::Selection selection({entry.key}, whole, machine);
      const signals::Table own = run(e, {.topics = &selection.topics()}).table;
      const auto found = selection.figures(own, machine);
      ASSERT_TRUE(found) << file << " " << entry.key;
      ASSERT_TRUE(found->find(entry.key)) << file << " " << entry.key;
      EXPECT_EQ(*found->find(entry.key), entry.value) << file << " " << entry.key;
    }
  }
}

// A run whose figures need topics that were not needed before is not summarised by less.
TEST(Selection, SaysThatItNeedsOtherTopics) {
  const config::Node root = config::compose(leg, {"sequence.repeat=1"});
  const analysis::Machine machine = analysis::read_machine(root);
  const signals::Table whole = run(buildable(root, leg)).table;
  const signals::Table nothing;
  const analysis::Selection selection({"joints.hip.tracking_rms_rad"}, nothing, machine);
  EXPECT_FALSE(selection.figures(whole, machine));
}

}  // namespace
}  // namespace sinew::run::ensemble_test
