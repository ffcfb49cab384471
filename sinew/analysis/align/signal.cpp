#include "sinew/analysis/align/signal.h"

#include <algorithm>
#include <cmath>

namespace sinew::analysis {

double Signal::step() const {
  return time.size() < 2 ? 0 : duration() / static_cast<double>(time.size() - 1);
}

Signal signal_of(std::string channel, Recording recording) {
  Signal out{std::move(channel), {}, {}};
  for (std::size_t i = 0; i < recording.time_ns->size(); ++i) {
    const double t = 1e-9 * static_cast<double>((*recording.time_ns)[i]);
    const double v = (*recording.values)[i];
    if (!std::isfinite(v)) continue;
    if (!out.time.empty() && t <= out.time.back()) {
      out.value.back() = v;
      continue;
    }
    out.time.push_back(t);
    out.value.push_back(v);
  }
  return out;
}

double Reader::at(double t) {
  const std::vector<double>& time = signal_.time;
  if (time[at_] > t)
    at_ = static_cast<std::size_t>(std::ranges::upper_bound(time, t) - time.begin()) - 1;
  while (at_ + 1 < time.size() && time[at_ + 1] <= t) ++at_;
  const double before = signal_.value[at_];
  if (at_ + 1 == time.size()) return before;
  const double share = (t - time[at_]) / (time[at_ + 1] - time[at_]);
  return before + share * (signal_.value[at_ + 1] - before);
}

Spread spread_of(const Signal& signal) {
  Spread out;
  const std::vector<double>& x = signal.value;
  if (x.empty()) return out;
  const auto count = static_cast<double>(x.size());
  const auto [least, greatest] = std::ranges::minmax(x);
  out.range = greatest - least;
  if (out.range == 0) {
    out.mean = least;
    return out;
  }
  for (const double v : x) out.mean += v / count;
  for (const double v : x) out.variance += (v - out.mean) * (v - out.mean) / count;
  if (x.size() < 3) return out;
  double square = 0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double bend = x[i - 1] - 2 * x[i] + x[i + 1];
    square += bend * bend;
  }
  out.noise = std::sqrt(square / (6 * (count - 2)));
  return out;
}

}  // namespace sinew::analysis
