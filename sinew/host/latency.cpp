#include "sinew/host/latency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/host/beat.h"

namespace sinew::host {

Latency measure_latency(double seconds, double tick) {
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(seconds / tick)));
  const auto step = static_cast<std::int64_t>(std::llround(1e9 * tick));
  std::vector<double> late(count);
  std::int64_t due = now_ns();
  for (double& l : late) {
    due += step;
    sleep_until_ns(due);
    l = 1e-9 * static_cast<double>(now_ns() - due);
  }
  return latency_of(std::move(late));
}

Latency latency_of(std::vector<double> late) {
  if (late.empty()) return {};
  std::ranges::sort(late);
  // The last that belongs to the share, so that of few wake-ups it is the worst.
  const auto at = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(late.size()));
    return late[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  return {at(0.5), at(0.999), late.back(), late.size()};
}

LatencyClass class_of(const Latency& latency, double tick) {
  if (latency.worst <= 0.5 * tick) return LatencyClass::real_time;
  return latency.most <= tick ? LatencyClass::usual : LatencyClass::unfit;
}

std::string in_words(const Latency& l, double tick) {
  const LatencyClass c = class_of(l, tick);
  const char* name = c == LatencyClass::real_time ? "real-time"
                     : c == LatencyClass::usual   ? "usual"
                                                  : "unfit";
  return fmt::format("{}: {} wake-ups, worst {:.0f} us, 99.9 % within {:.0f} us", name, l.count,
                     1e6 * l.worst, 1e6 * l.most);
}

}  // namespace sinew::host
