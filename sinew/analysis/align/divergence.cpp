#include "sinew/analysis/align/divergence.h"

#include <algorithm>
#include <cmath>

#include "sinew/analysis/align/signal.h"

namespace sinew::analysis {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

std::optional<double> diverges_at(const PairedSamples& met, double band) {
  std::size_t beyond = 0;  // in a row
  for (std::size_t i = 0; i < met.difference.size(); ++i) {
    const double d = met.difference[i];
    if (!std::isfinite(d)) continue;
    beyond = std::abs(d) > band ? beyond + 1 : 0;
    if (beyond == 3) return 1e-9 * static_cast<double>(met.time_ns[i - 2]);
  }
  return std::nullopt;
}

std::array<double, 10> growth_of(const PairedSamples& met) {
  std::array<double, 10> square{}, count{};
  if (met.time_ns.empty()) return square;
  const std::int64_t from = met.time_ns.front();
  const double whole = static_cast<double>(met.time_ns.back() - from) + 1;
  for (std::size_t i = 0; i < met.difference.size(); ++i) {
    const double d = met.difference[i];
    if (!std::isfinite(d)) continue;
    const auto tenth =
        static_cast<std::size_t>(10 * static_cast<double>(met.time_ns[i] - from) / whole);
    square[tenth] += d * d;
    count[tenth] += 1;
  }
  for (std::size_t k = 0; k < square.size(); ++k)
    square[k] = count[k] > 0 ? std::sqrt(square[k] / count[k]) : not_known;
  return square;
}

}  // namespace

bool is_of_motion(std::string_view topic) {
  return !signals::is_of_valve(topic) && !topic.ends_with("_duty") &&
         !topic.starts_with("/true/") && !topic.starts_with("/desired/") &&
         topic.find("/plan/") == topic.npos && topic.find("/desired/") == topic.npos &&
         !topic.starts_with("/low_level/");
}

std::vector<Divergence> divergences(const signals::Table& measured, const signals::Table& simulated,
                                    double share) {
  std::vector<Divergence> out;
  for (const ChannelDifference& d : differences(measured, simulated)) {
    if (!is_of_motion(d.topic) || d.difference.how == Pairing::never) continue;
    const auto recording = [&](const signals::Table& table) {
      return Recording{&table.find(d.topic)->time_ns, table.column(d.topic, d.field)};
    };
    const PairedSamples met = pair_samples(recording(measured), recording(simulated));
    const Spread spread = spread_of(signal_of(d.topic, recording(measured)));
    Divergence p{d.topic, d.field, d.unit, d.difference};
    p.band = std::max(share * spread.range, 4 * spread.noise);
    p.at = diverges_at(met, p.band);
    p.growth = growth_of(met);
    out.push_back(std::move(p));
  }
  std::ranges::stable_sort(out, {}, [](const Divergence& p) { return p.at.value_or(INFINITY); });
  return out;
}

}  // namespace sinew::analysis
