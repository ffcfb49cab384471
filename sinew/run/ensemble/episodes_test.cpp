// Episodes that step together equal single episodes of the same values and seeds, to the bit.
#include "sinew/run/ensemble/episodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "sinew/config/diagnostics.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/units/quantity.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::run::episodes_test {
namespace {

const std::string experiments = test::source_dir() + "/experiments/";

Task task(double period = 0.02) {
  return {.actions = {{.setting = "control.angle.hip", .offset = 0.2},
                      {.setting = "control.gains.hip.angle", .factor = 2}},
          .observations = {{.channel = "/joint/hip/angle", .middle = 4.9, .scale = 0.5},
                           {.channel = "/true/joint/knee/velocity"},
                           {.channel = "/muscle/hip_flexor/tension"}},
          .measures = {"/true/trolley/position", "plan:control.gains.hip.angle"},
          .period = period};
}

// Numbers of the machine, of its plan and of both.
struct Parameter {
  std::string key, unit;
  double low = 0, high = 1;
};
const std::vector<Parameter> parameters = {{"link.femur.mass", "kg", 0.2, 0.4},
                                           {"joint.hip.angle_gain", "1/count", 2e-4, 6e-4},
                                           {"joint.knee.damping", "N m s/rad", 0.05, 0.5}};

struct Begun {
  int seed = 1;
  std::vector<double> values;
};

Begun draw(std::mt19937& random) {
  Begun out{.seed = static_cast<int>(random() % 1000), .values = {}};
  for (const Parameter& p : parameters)
    out.values.push_back(std::uniform_real_distribution(p.low, p.high)(random));
  return out;
}

// An event of an episode in a step: another episode begins, or it continues with an action.
struct Event {
  std::optional<Begun> begins;
  std::vector<double> action;
};

std::vector<Event> draw_events(std::size_t steps, std::mt19937& random) {
  std::uniform_real_distribution any(-1.2, 1.2);
  std::vector<Event> out(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    if (k == 0 || random() % 100 == 0) out[k].begins = draw(random);
    out[k].action = {any(random), any(random)};
  }
  return out;
}

// Observations and measures of each step, then whether it has ended.
using Rows = std::vector<std::vector<double>>;

// The reference: the experiment is read with these values, and its episode runs by itself.
Rows single(const std::string& file, const std::vector<Event>& events) {
  Rows out;
  std::optional<Episode> episode;
  std::unique_ptr<Simulation> leg;
  for (const Event& event : events) {
    if (event.begins) {
      std::vector<std::string> sets = {"sequence.repeat=1",
                                       "seed=" + std::to_string(event.begins->seed)};
      for (std::size_t i = 0; i < parameters.size(); ++i)
        sets.push_back(parameters[i].key + "=" +
                       units::format_quantity(event.begins->values[i], parameters[i].unit));
      const experiment::Experiment e = buildable(file, sets);
      Simulation example(e);
      episode.emplace(task(), example);
      leg = std::make_unique<Simulation>(e);
      episode->begin(*leg);
    } else {
      episode->step(*leg, event.action);
    }
    std::vector<double>& row = out.emplace_back(6);
    episode->observe(*leg, std::span(row).first(3), std::span(row).subspan(3, 2));
    row[5] = leg->ended() ? 1 : 0;
  }
  return out;
}

std::vector<std::string> keys() {
  std::vector<std::string> out;
  for (const Parameter& p : parameters) out.push_back(p.key);
  return out;
}

std::shared_ptr<const Ensemble> ensemble_of(const std::string& file) {
  return std::make_shared<const Ensemble>(file, std::vector<std::string>{"sequence.repeat=1"},
                                          keys(), std::vector<std::string>{}, true);
}

std::shared_ptr<const Episode> definition_of(const Ensemble& ensemble) {
  Simulation example(ensemble.example());
  return std::make_shared<const Episode>(task(), example);
}

// Steps all episodes with their events; returns the rows of each.
std::vector<Rows> together(Episodes& legs, const std::vector<std::vector<Event>>& events) {
  const std::size_t n = events.size();
  std::vector<Rows> out(n);
  std::vector<double> observed(3 * n), measured(2 * n);
  const auto ended = std::make_unique<bool[]>(n), failed = std::make_unique<bool[]>(n);
  for (std::size_t k = 0; k < events[0].size(); ++k) {
    std::vector<double> actions;
    for (std::size_t i = 0; i < n; ++i) {
      const Event& event = events[i][k];
      if (event.begins) legs.begin(i, event.begins->seed, event.begins->values);
      actions.insert(actions.end(), event.action.begin(), event.action.end());
    }
    legs.step(actions, {.observed = observed,
                        .measured = measured,
                        .ended = {ended.get(), n},
                        .failed = {failed.get(), n}});
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_FALSE(failed[i]) << legs.cause(i);
      std::vector<double>& row = out[i].emplace_back();
      row.insert(row.end(), &observed[3 * i], &observed[3 * i] + 3);
      row.insert(row.end(), &measured[2 * i], &measured[2 * i] + 2);
      row.push_back(ended[i] ? 1 : 0);
    }
  }
  return out;
}

// Returns the first row and number with other bits; empty if all bits are equal.
std::string difference(const Rows& a, const Rows& b) {
  for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k)
    for (std::size_t i = 0; i < a.at(k).size(); ++i)
      if (std::memcmp(&a[k][i], &b.at(k)[i], sizeof(double)) != 0)
        return "row " + std::to_string(k) + ", number " + std::to_string(i);
  return "";
}

// Walks, walks whose phases end by readings, and a robot that lanes do not hold.
TEST(Episodes, EachIsASingleEpisodeOfItsValues) {
  for (const char* name : {"walk-test-1", "touchdown", "walk-with-hoses"}) {
    const std::string file = experiments + name + ".toml";
    const bool walk = std::string(name) == "walk-test-1";
    const std::size_t count = walk ? 11 : 3, steps = walk ? 300 : 60;
    std::mt19937 random(3);
    std::vector<std::vector<Event>> events;
    std::vector<Rows> expected;
    for (std::size_t i = 0; i < count; ++i) {
      events.push_back(draw_events(steps, random));
      expected.push_back(single(file, events[i]));
    }
    const auto ensemble = ensemble_of(file);
    for (const int threads : {1, 2, 5}) {
      Episodes legs(definition_of(*ensemble), ensemble, count, threads);
      const std::vector<Rows> found = together(legs, events);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_EQ(difference(found[i], expected[i]), "")
            << name << ", " << threads << " threads, " << i;
    }
  }
}

TEST(Episodes, ARefusedValueChangesNothing) {
  const auto ensemble = ensemble_of(experiments + "walk-test-1.toml");
  Episodes legs(definition_of(*ensemble), ensemble, 4, 1),
      others(definition_of(*ensemble), ensemble, 4, 1);
  const std::vector<double> good = {0.3, 4e-4, 0.1}, wrong = {-1, 4e-4, 0.1};
  std::vector<std::vector<Event>> events(4, std::vector<Event>(1, {Begun{1, good}, {0, 0}}));
  (void)together(legs, events);
  (void)together(others, events);
  EXPECT_NE(test::message([&] { legs.begin(2, 1, wrong); }).find("link.femur.mass"),
            std::string::npos);
  for (auto& one : events) one[0].begins.reset();
  EXPECT_EQ(together(legs, events), together(others, events));
}

}  // namespace
}  // namespace sinew::run::episodes_test
