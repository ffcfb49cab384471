#include "sinew/analysis/align/event.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"

namespace sinew::analysis {
namespace {

constexpr std::size_t at_rest = 5, stays = 3;  // samples

// Between samples i-1 and i, where the signal passes the level.
Instant between(const Signal& s, std::size_t i, double level, double noise) {
  const double t0 = s.time[i - 1], t1 = s.time[i], rise = s.value[i] - s.value[i - 1];
  const double t = t0 + (t1 - t0) * (level - s.value[i - 1]) / rise;
  // A noisy sample says little of the slope: that over a few samples does.
  const std::size_t from = i > 2 ? i - 3 : 0, to = std::min(i + 2, s.time.size() - 1);
  const double slope = std::abs(s.value[to] - s.value[from]) / (s.time[to] - s.time[from]);
  const double by_noise = slope > 0 ? noise / slope : t1 - t0;
  return {t, std::max(by_noise, (t1 - t0) / std::sqrt(12.0))};
}

}  // namespace

std::optional<Instant> first_crossing(const Signal& s, double level, bool upwards) {
  const double sign = upwards ? 1 : -1;
  for (std::size_t i = 1; i < s.value.size(); ++i)
    if (sign * (s.value[i - 1] - level) <= 0 && sign * (s.value[i] - level) > 0)
      return between(s, i, level, spread_of(s).noise);
  return std::nullopt;
}

std::optional<Instant> first_motion(const Signal& s, double band) {
  if (s.value.size() < at_rest + stays) return std::nullopt;
  std::array<double, at_rest> begins{};
  std::copy_n(s.value.begin(), at_rest, begins.begin());
  std::ranges::sort(begins);
  const double from = begins[at_rest / 2];
  const auto beyond = [&](std::size_t i) { return std::abs(s.value[i] - from) > band; };

  for (std::size_t i = 1; i + stays <= s.value.size(); ++i) {
    if (!beyond(i) || !beyond(i + 1) || !beyond(i + 2)) continue;
    if (i < at_rest || beyond(i - 1)) return std::nullopt;
    return between(s, i, s.value[i] > from ? from + band : from - band, spread_of(s).noise);
  }
  return std::nullopt;
}

Event parse_event(const std::string& text) {
  const std::size_t sign = text.find_first_of("<>");
  const auto fail = [&](std::string_view found) {
    config::fail({"event", 0, 0}, "", std::string(found),
                 "a channel, > or <, and a level with its unit", "\"/joint/elbow/angle > 10 deg\"");
  };
  if (sign == text.npos) fail("\"" + text + "\", without > or <");
  Event out{std::string(config::trimmed(text.substr(0, sign))), text[sign] == '>',
            std::string(config::trimmed(text.substr(sign + 1)))};
  if (!out.channel.starts_with("/")) fail("\"" + text + "\", which begins with no channel");
  if (out.level.empty()) fail("\"" + text + "\", without a level");
  return out;
}

double EventPair::uncertainty() const { return std::hypot(first.uncertainty, other.uncertainty); }

std::optional<EventPair> surest_motion(std::span<const Pair> pairs) {
  std::optional<EventPair> best;
  for (const Pair& pair : pairs) {
    const Spread a = spread_of(pair.first), b = spread_of(pair.other);
    if (!a.moves() || !b.moves()) continue;
    const double band = std::max(0.05 * std::max(a.range, b.range), 8 * std::max(a.noise, b.noise));
    const auto first = first_motion(pair.first, band), other = first_motion(pair.other, band);
    if (!first || !other) continue;
    EventPair found{*first, *other,
                    fmt::format("{} moves by {:.3g}{}{}", pair.first.channel, band,
                                pair.unit == "1" ? "" : " ", pair.unit == "1" ? "" : pair.unit)};
    if (!best || found.uncertainty() < best->uncertainty()) best = std::move(found);
  }
  return best;
}

}  // namespace sinew::analysis
