// analysis/align/test_motion.h - a motion for tests, recorded with any clock and noise.
#pragma once

#include <cmath>
#include <random>
#include <string>

#include "sinew/analysis/align/correlation.h"
#include "sinew/signals/table.h"

namespace sinew::analysis::test {

// A motion that never repeats itself: at rest until 1 s, then swings of three incommensurable
// frequencies.
inline double motion(double t) {
  if (t < 1) return 0.3;
  const double u = t - 1;
  return 0.3 + 0.2 * std::sin(2.1 * u) + 0.15 * std::sin(1.3 * std::sqrt(2.0) * u) +
         0.1 * (1 - std::cos(0.37 * u));
}

// A second motion, for a second channel.
inline double tension(double t) { return 40 + 25 * motion(0.8 * t) + 10 * motion(1.3 * t); }

struct Measured {
  Clock clock = {};                     // in relation to the motion's time
  double period = 0.01, duration = 30;  // of the samples, by its clock [s]
  double noise = 0;                     // sigma of the angle [rad]
  unsigned seed = 1;
};

// Adds a channel with recorded samples of the motion `of`.
template <class Of>
void add_channel(signals::Table& table, const std::string& name, const std::string& unit,
                 const Measured& how, double noise, Of of) {
  std::mt19937 random(how.seed + static_cast<unsigned>(table.series.size()));
  std::normal_distribution<double> normal(0, 1);
  signals::Series s{{name, "", {{"value", unit}}}, {}, {{}}};
  const auto samples = static_cast<int>(how.duration / how.period);
  for (int i = 0; i < samples; ++i) {
    const double t = i * how.period;
    s.time_ns.push_back(std::llround(1e9 * t));
    s.columns[0].push_back(of(how.clock.first(t)) + (noise > 0 ? noise * normal(random) : 0));
  }
  table.series.push_back(std::move(s));
}

inline signals::Table recorded(const Measured& how) {
  signals::Table out;
  add_channel(out, "/joint/elbow/angle", "rad", how, how.noise, motion);
  add_channel(out, "/muscle/elbow_flexor/tension", "N", how, 100 * how.noise, tension);
  add_channel(out, "/room/pressure", "Pa abs", how, 0, [](double) { return 101325.0; });
  add_channel(out, "/room/temperature", "K", how, 0.1, [](double) { return 293.0; });
  return out;
}

}  // namespace sinew::analysis::test
