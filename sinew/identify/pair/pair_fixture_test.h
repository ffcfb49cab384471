// A sealed pair on a slide that is moved by hand, made with known physics, for the tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// The simulated pair of the tests.
struct TestPair {
  double stiffness = 1.5e5, viscous = 4e3, mass = 300;     // [N/m] [N s/m] [kg]
  double friction = 30, presliding = 1e-5, fade_time = 0;  // [N] [m] [s], 0: it does not fade
  double bias = -7, gain = 1, delay = 0;                   // force sensor [N] [1] [s]
  double exponent = 1.2, area = 8e-3, volume = 4e-4;       // trapped air [1] [m2] [m3]
  double elastic = 0;                                      // stiffness without the air [N/m]
  double noise = 0.5, memory = 0;                          // force noise [N], coefficient of AR(1)
  double shift = 0;                                        // phase of the motion [rad]
};

// Returns the position of the slide: three sines, so that it reverses at many places.
inline double test_position(double t, double shift) {
  using std::numbers::pi;
  return 4e-4 * std::sin(2 * pi * 0.31 * t + shift) +
         2e-4 * std::sin(2 * pi * 0.83 * t + 2 * shift) + 5e-5 * std::sin(2 * pi * 2.3 * t);
}

// Returns a record of `seconds` at 500 Hz. `with_air`: the stiffness is that of the air and
// `elastic`, and both pressures are measured.
inline PairRecord test_record(const TestPair& pair, unsigned seed, bool with_air = false,
                              double seconds = 8, const std::string& file = "a.csv") {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  constexpr double step = 0.002, fine = 5e-5, room = 101325, nominal = 3.5e5 + room;
  Measured out{.file = file};
  std::vector<double> time, force, at, p1, p2;
  double w = 0, drift = 0, x = test_position(-0.5, pair.shift), next = 0;
  std::vector<double> late;  // forces that the sensor delays
  for (int i = 0;; ++i) {
    const double t = -0.5 + i * fine, before = x;
    if (t > seconds) break;
    x = test_position(t, pair.shift);
    const double v = (x - before) / fine;
    const double fade = pair.fade_time > 0 ? w / pair.fade_time : 0;
    w = std::clamp(w + fine * (v / pair.presliding - fade), -1.0, 1.0);
    const double v2 =
        (test_position(t + 1e-4, pair.shift) - test_position(t - 1e-4, pair.shift)) / 2e-4;
    const double a =
        (test_position(t + 1e-4, pair.shift) - 2 * x + test_position(t - 1e-4, pair.shift)) / 1e-8;
    const double falls = nominal * std::pow(1 + pair.area * x / pair.volume, -pair.exponent);
    const double rises = nominal * std::pow(1 - pair.area * x / pair.volume, -pair.exponent);
    const double springs =
        with_air ? pair.area * (rises - falls) + pair.elastic * x : pair.stiffness * x;
    late.push_back(springs + pair.viscous * v2 + pair.mass * a + pair.friction * w);
    if (t < next - 0.5 * fine) continue;
    next += step;
    const auto behind = static_cast<std::size_t>(std::lround(pair.delay / fine));
    drift = pair.memory * drift +
            std::sqrt(1 - pair.memory * pair.memory) * pair.noise * normal(random);
    time.push_back(t);
    at.push_back(x);
    force.push_back(pair.bias + pair.gain * late[late.size() - 1 - behind] + drift);
    p1.push_back(falls + 20 * normal(random));
    p2.push_back(rises + 20 * normal(random));
  }
  out.columns = {{.name = "time", .unit = "s", .values = time},
                 {.name = "force", .unit = "N", .values = force},
                 {.name = "displacement", .unit = "m", .values = at}};
  if (with_air) {
    out.columns.push_back({.name = "pressure_1", .unit = "Pa abs", .values = p1});
    out.columns.push_back({.name = "pressure_2", .unit = "Pa abs", .values = p2});
  }
  for (std::size_t i = 0; i < time.size(); ++i) out.lines.push_back(static_cast<int>(i) + 2);
  return pair_record(out);
}

}  // namespace sinew::identify
