// analysis/record/test_log.h - logs for tests: columns filled by formulas, a sample every 10 ms.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/robot/test_leg.h"
#include "sinew/signals/table.h"

namespace sinew::analysis::test {

inline constexpr double dt = 0.01;

using Of = std::function<double(double)>;  // function of time [s]

class Log {
 public:
  explicit Log(int rows, std::int64_t offset_ns = 0) {
    for (int i = 0; i < rows; ++i) times_.push_back(offset_ns + 10'000'000LL * i);
  }

  Log& scalar(const std::string& topic, const Of& of) {
    table.series.push_back({{topic, "", {{"value", ""}}}, times_, {values(of)}});
    return *this;
  }
  Log& vector(const std::string& topic, const Of& x, const Of& y) {
    table.series.push_back({{topic, "", {{"x", ""}, {"y", ""}}}, times_, {values(x), values(y)}});
    return *this;
  }
  // Adds the edges of a valve that is open for `pulse` from the start of every 10 ms until `end`.
  Log& pulses(const std::string& topic, double pulse, double end) {
    signals::Series s{{topic, "", {{"value", "1"}}}, {}, {{}}};
    for (double t = 0; t < end - 1e-9 && pulse > 0; t += dt)
      for (const bool open : {true, false}) {
        s.time_ns.push_back(std::llround(1e9 * (open ? t : t + pulse)));
        s.columns[0].push_back(open ? 1 : 0);
      }
    table.series.push_back(std::move(s));
    return *this;
  }

  signals::Table table;

 private:
  std::vector<double> values(const Of& of) const {
    std::vector<double> out;
    for (const std::int64_t t : times_) out.push_back(of(1e-9 * static_cast<double>(t)));
    return out;
  }

  std::vector<std::int64_t> times_;
};

inline Of constant(double value) {
  return [value](double) { return value; };
}

// Returns the thesis's leg with the phases of its walk.
inline Machine walking_leg() {
  Machine m;
  m.title = "A walk";
  m.robot = robot::test::leg();
  m.actuators.push_back({.name = "bpa"});
  m.phases = m.sequence = {"swing", "foot_plant", "propulsion"};
  m.period = dt;
  return m;
}

// Returns the phase in a step of 1 s: swing to 0.4 s, foot plant to 0.5 s, then propulsion.
inline int phase_at(double t) {
  const double s = std::fmod(t + 1e-9, 1.0);
  return s < 0.4 ? 0 : s < 0.5 ? 1 : 2;
}

// Returns a log of `steps` seconds of the sequence, with `before` and `after` seconds outside it.
inline Log walk(int steps, double before = 0, double after = 0) {
  const double start = before, end = before + steps;
  Log log(static_cast<int>(std::lround((end + after) / dt)));
  const auto within = [=](double t) { return t > start - 1e-9 && t < end - 1e-9; };
  log.scalar("/plan/phase", [=](double t) { return within(t) ? phase_at(t - start) : -1.0; });
  log.scalar("/plan/step", [=](double t) {
    return within(t) ? std::floor(t - start + 1e-9) : t < start ? 0.0 : steps - 1.0;
  });
  return log;
}

inline void duties(Log& log, const std::string& muscle, double inlet, double exhaust) {
  log.scalar("/muscle/" + muscle + "/inlet_duty", constant(inlet));
  log.scalar("/muscle/" + muscle + "/exhaust_duty", constant(exhaust));
}

}  // namespace sinew::analysis::test
