// analysis/align/signal.h - a channel as a function of time, for the alignment of two recordings.
//
//   u(t)      the straight line between the two samples around t
//   noise     sigma^2 = mean (u_{i-1} - 2 u_i + u_{i+1})^2 / 6, exact for white noise
//   moves     sigma^2 < var(u)/4: neither constant nor nothing but noise
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/analysis/verdict/compare.h"

namespace sinew::analysis {

// Finite samples at ascending times.
struct Signal {
  std::string channel;              // "/joint/hip/angle"
  std::vector<double> time, value;  // [s], in the channel's SI unit

  bool empty() const { return time.empty(); }
  // Return the time from the first to the last sample, and the mean step between samples  [s].
  double duration() const { return empty() ? 0 : time.back() - time.front(); }
  double step() const;
};

// Returns the finite samples of a recording; of several samples at one time the last one.
Signal signal_of(std::string channel, Recording recording);

// Reads a signal at ascending times: each search continues from the last one.
class Reader {
 public:
  // Reads `signal`, which must outlive the reader.
  explicit Reader(const Signal& signal) : signal_(signal) {}
  // Returns whether t is within the signal's times.
  bool holds(double t) const { return t >= signal_.time.front() && t <= signal_.time.back(); }
  // Returns u(t). Requires t within the signal's times.
  double at(double t);

 private:
  const Signal& signal_;
  std::size_t at_ = 0;
};

// Statistics of a signal's values.
struct Spread {
  double mean = 0, variance = 0;
  double noise = 0;  // sigma
  double range = 0;  // greatest less least value
  // Returns whether the signal is neither constant nor only noise.
  bool moves() const { return variance > 0 && noise * noise < 0.25 * variance; }
};
// Returns the statistics of a signal's values.
Spread spread_of(const Signal& signal);

}  // namespace sinew::analysis
