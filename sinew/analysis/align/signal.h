// analysis/align/signal.h - a channel as a function of time, for laws that lay two recordings on
// each other.
//
//   u(t)      the straight line between the two samples around t
//   noise     sigma^2 = mean (u_{i-1} - 2 u_i + u_{i+1})^2 / 6, which white noise of that sigma
//             gives
//   moves     sigma^2 < var(u)/4: neither constant nor nothing but noise
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/analysis/verdict/compare.h"

namespace sinew::analysis {

// Samples that are numbers, at ascending times.
struct Signal {
  std::string channel;              // "/joint/hip/angle"
  std::vector<double> time, value;  // [s], in the channel's SI unit

  // Has it no samples? How long is it from the first to the last one  [s]?
  bool empty() const { return time.empty(); }
  double duration() const { return empty() ? 0 : time.back() - time.front(); }
  double step() const;  // between samples, on average [s]
};

// Leaves out what is no number; of samples at one time the last one stays.
Signal signal_of(std::string channel, Recording recording);

// Where a signal is read at ascending times: each search goes on where the last one ended.
class Reader {
 public:
  // Reads this signal, which outlives it.
  explicit Reader(const Signal& signal) : signal_(signal) {}
  // Does t lie within its times?
  bool holds(double t) const { return t >= signal_.time.front() && t <= signal_.time.back(); }
  // Returns x(t); t lies within the signal's times.
  double at(double t);

 private:
  const Signal& signal_;
  std::size_t at_ = 0;
};

// How the values of a signal are spread.
struct Spread {
  double mean = 0, variance = 0;
  double noise = 0;  // sigma
  double range = 0;  // greatest less least value
  // Is it neither constant nor nothing but noise?
  bool moves() const { return variance > 0 && noise * noise < 0.25 * variance; }
};
// Returns how a signal's values are spread, and how much of that is noise.
Spread spread_of(const Signal& signal);

}  // namespace sinew::analysis
