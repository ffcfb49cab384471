// Trains a faster walk with the cross-entropy method: legs walk with gaits drawn at random around
// the best so far, and the fastest ones determine the next distribution.
//
//   train_a_walk [SHARE [GENERATIONS]]     SHARE is the folder that has experiments/: the sources,
//                                          or <prefix>/share/sinew
//
// An action is, 20 times per second, the offset of each joint from the plan's angle and a factor of
// its stiffness. A gait is a matrix: the action is linear in the observation and the phase of the
// step. The result is evaluated with the noise of 20 seeds that were not used in training.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/episode.h"

namespace {

using namespace sinew;

constexpr std::size_t tried = 48, kept = 10;
constexpr std::size_t actions = 4, observations = 14, phase_at = 12, features = observations + 2;

using Gait = std::array<double, actions * features>;  // [action][feature]

// The task "walk" of sinew.gym.
run::Task task() {
  run::Task t{.measures = {"/true/trolley/position"}};
  for (const char* joint : {"hip", "knee"})
    t.actions.push_back({.setting = std::string("control.angle.") + joint, .offset = 0.2});
  for (const char* joint : {"hip", "knee"})
    t.actions.push_back({.setting = std::string("control.stiffness.") + joint, .factor = 2});
  t.observations = {{"/joint/hip/angle", 4.9, 0.5},
                    {"/joint/knee/angle", 5.2, 0.5},
                    {"/desired/joint/hip/angle", 4.9, 0.5},
                    {"/desired/joint/knee/angle", 5.2, 0.5},
                    {"/true/joint/hip/velocity", 0, 3},
                    {"/true/joint/knee/velocity", 0, 3},
                    {"/joint/hip/stiffness", 0, 4},
                    {"/joint/knee/stiffness", 0, 4},
                    {"/muscle/hip_flexor/tension", 0, 200},
                    {"/muscle/hip_extensor/tension", 0, 200},
                    {"/muscle/knee_flexor/tension", 0, 200},
                    {"/muscle/knee_extensor/tension", 0, 200},
                    {"/plan/phase"},
                    {"/true/trolley/velocity", 0, 0.3}};
  return t;
}

// Random bits of a generation, a hash of their number: main.py has the same.
std::uint64_t dice(std::uint64_t generation, std::uint64_t number) {
  std::uint64_t z = ((generation << 32) + number + 1) * 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return z ^ (z >> 31);
}

// Returns an approximately normal number: the sum of twelve uniform numbers, minus six.
double normal(std::uint64_t generation, std::uint64_t number) {
  double sum = 0;
  for (std::uint64_t i = 0; i < 12; ++i)
    sum += static_cast<double>(dice(generation, 12 * number + i) >> 11) * 0x1p-53;
  return sum - 6;
}

// The walk of the thesis on a track of 20 m, since its track is not longer than its walk.
class Track {
 public:
  // Runs the plan once, which the constructor of the episode requires.
  explicit Track(const std::string& file)
      : walk_(run::buildable(file, {"trolley.track_length=20 m", "sequence.repeat=4"})),
        episode_(task(), *std::make_unique<run::Simulation>(walk_)) {}

  // Returns the distance of a gait with a seed [m].
  double way(const Gait& gait, int seed) const {
    experiment::Experiment walk = walk_;
    walk.seed = seed;
    run::Simulation leg(walk);
    episode_.begin(leg);
    std::array<double, observations> observed;
    std::array<double, 1> before, after;
    double way = 0;
    for (episode_.observe(leg, observed, before); !leg.ended(); before = after) {
      episode_.step(leg, action(gait, observed));
      episode_.observe(leg, observed, after);
      way += after[0] - before[0];
    }
    return way;
  }

  // Returns the distances with 20 seeds from 10,000 on.
  std::array<double, 20> judged(const Gait& gait) const {
    std::array<double, 20> ways;
    for (int i = 0; i < 20; ++i) ways[static_cast<std::size_t>(i)] = way(gait, 10'000 + i);
    return ways;
  }

 private:
  // Encodes the index of the phase as three numbers 0 or 1.
  static std::array<double, actions> action(const Gait& gait,
                                            const std::array<double, observations>& observed) {
    std::array<double, features> f;
    for (int phase = 0; phase < 3; ++phase)
      f[static_cast<std::size_t>(phase)] = std::lround(observed[phase_at]) == phase;
    std::copy_n(observed.begin(), phase_at, f.begin() + 3);
    std::copy(observed.begin() + phase_at + 1, observed.end(), f.begin() + 3 + phase_at);
    std::array<double, actions> out;
    for (std::size_t i = 0; i < actions; ++i)
      out[i] = std::inner_product(f.begin(), f.end(), gait.begin() + i * features, 0.0);
    return out;
  }

  experiment::Experiment walk_;
  run::Episode episode_;
};

// Normal distribution of gaits: mean and standard deviation.
struct Cloud {
  Gait mean{}, spread;

  Gait draw(std::uint64_t generation, std::uint64_t number) const {
    Gait out;
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = mean[i] + spread[i] * normal(generation, number * out.size() + i);
    return out;
  }

  // Moves the distribution towards the best gaits.
  void move(const std::vector<Gait>& best) {
    const auto n = static_cast<double>(best.size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
      double sum = 0, squares = 0;
      for (const Gait& gait : best) sum += gait[i];
      for (const Gait& gait : best) squares += (gait[i] - sum / n) * (gait[i] - sum / n);
      mean[i] = 0.3 * mean[i] + 0.7 * (sum / n);
      spread[i] = 0.01 + 0.3 * spread[i] + 0.7 * std::sqrt(squares / n);
    }
  }
};

template <class Numbers>
double average(const Numbers& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

// Returns the mean distance of a generation [m].
double generation(const Track& track, std::uint64_t number, Cloud& cloud) {
  std::vector<Gait> gaits;
  std::vector<double> ways;
  for (std::uint64_t i = 0; i < tried; ++i) {
    gaits.push_back(cloud.draw(number, i));
    const auto seed = static_cast<int>(dice(number + (1 << 20), i) % 9'999 + 1);
    ways.push_back(track.way(gaits.back(), seed));
  }
  std::vector<std::size_t> order(tried);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, std::greater(), [&](std::size_t i) { return ways[i]; });
  std::vector<Gait> best;
  for (std::size_t i = 0; i < kept; ++i) best.push_back(gaits[order[i]]);
  cloud.move(best);
  return average(ways);
}

bool train(const std::string& file, int generations) {
  const Track track(file);
  Cloud cloud;
  cloud.spread.fill(0.3);
  const auto plan = track.judged(cloud.mean);
  std::printf("the plan: %.2f m in four steps\n", average(plan));
  for (int g = 1; g <= generations; ++g) {
    const double way = generation(track, static_cast<std::uint64_t>(g), cloud);
    if (g % 5 == 0) std::printf("generation %d: %.2f m on average\n", g, way);
  }
  const auto trained = track.judged(cloud.mean);
  std::array<double, 20> gain;
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] = trained[i] / plan[i] - 1;
  const double worst = *std::ranges::min_element(gain);
  std::printf(
      "trained: %.2f m, %.0f %% further; of %zu seeds that it has not met the worst %.0f %%\n",
      average(trained), 100 * average(gain), gain.size(), 100 * worst);
  return worst >= 0.2;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  try {
    const int generations = argc > 2 ? std::stoi(argv[2]) : 15;
    return train(share + "/experiments/walk-test-1.toml", generations) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
