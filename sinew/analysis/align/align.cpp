#include "sinew/analysis/align/align.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/analysis/align/divergence.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"

namespace sinew::analysis {

namespace {

constexpr double least_alike = 0.6;
constexpr double quiet = 0.02;  // smallest share of the channel's variance in a usable piece [-]
constexpr double fastest_drift = 0.02;  // largest rate from piece to piece [-]

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double scale_of(std::vector<double> residuals) {
  for (double& r : residuals) r = std::abs(r);
  return 1.4826 * median(std::move(residuals));
}

// Returns the interval in which all channels of both recordings have samples, by the first one's
// clock.
Interval overlap(std::span<const Pair> pairs, const Clock& clock) {
  Interval out{-INFINITY, INFINITY};
  for (const Pair& p : pairs) {
    out.from = std::max({out.from, p.first.time.front(), clock.first(p.other.time.front())});
    out.to = std::min({out.to, p.first.time.back(), clock.first(p.other.time.back())});
  }
  return out;
}

bool moves_in(const Pair& pair, double variance, const Interval& piece) {
  const std::vector<double>& time = pair.first.time;
  double n = 0, sum = 0, square = 0, origin = 0;
  for (auto i = std::ranges::lower_bound(time, piece.from) - time.begin();
       i < std::ssize(time) && time[static_cast<std::size_t>(i)] <= piece.to; ++i) {
    const double v = pair.first.value[static_cast<std::size_t>(i)];
    if (n == 0) origin = v;
    n += 1, sum += v - origin, square += (v - origin) * (v - origin);
  }
  return n > 0 && square / n - sum / n * sum / n > quiet * variance;
}

// Returns the best shift within `reach` of the clock's; empty if it is at the limit or r is too
// low.
std::optional<LocalShift> shift_in(std::span<const Pair> pairs, const Clock& about,
                                   const Interval& piece, double reach, double width) {
  const int side = std::max(1, static_cast<int>(std::ceil(reach / width)));
  int best = 0;
  double best_r = -INFINITY;
  for (int i = -side; i <= side; ++i) {
    const auto found = overlap_correlation(pairs, {about.shift + i * width, about.rate}, piece);
    if (found && found->r > best_r) best = i, best_r = found->r;
  }
  if (best_r < least_alike || std::abs(best) == side) return std::nullopt;
  const Peak peak = refine(pairs, {about.shift + best * width, about.rate}, width, piece);
  if (!std::isfinite(peak.uncertainty)) return std::nullopt;
  const double middle = 0.5 * (piece.from + piece.to);
  return LocalShift{middle, peak.clock.other(middle) - middle,
                    std::max(peak.uncertainty, 0.01 * longest_step(pairs))};
}

}  // namespace

std::vector<LocalShift> local_shifts(std::span<const Pair> pairs, const Clock& about,
                                     double known_at, double half_width) {
  const Interval all = overlap(pairs, about);
  const double duration = all.to - all.from, step = longest_step(pairs);
  if (!(duration > 0)) return {};
  const double count =
      std::clamp(std::floor(duration / std::max(2 * half_width, 16 * step)), 4.0, 24.0);
  const double length = duration / count, width = std::max(step, half_width / 8);

  std::vector<double> variance;
  for (const Pair& p : pairs) variance.push_back(spread_of(p.first).variance);

  // Pieces are searched from the one at `known_at` to both ends, each beginning at the shift of the
  // one before it.
  std::vector<LocalShift> out;
  const int pieces = static_cast<int>(count);
  const int start = std::clamp(static_cast<int>((known_at - all.from) / length), 0, pieces - 1);
  for (const int by : {1, -1}) {
    Clock clock = about;
    for (int k = by > 0 ? start : start - 1; k >= 0 && k < pieces; k += by) {
      const Interval piece{all.from + k * length, all.from + (k + 1) * length};
      std::vector<Pair> moving;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (moves_in(pairs[i], variance[i], piece)) moving.push_back(pairs[i]);
      if (moving.empty()) continue;
      const double reach = std::min(half_width, fastest_drift * length + 0.5 * half_width);
      const auto found = shift_in(moving, clock, piece, reach, width);
      if (!found) continue;
      clock.shift = found->shift - about.rate * found->time;
      out.push_back(*found);
    }
  }
  std::ranges::sort(out, {}, &LocalShift::time);
  return out;
}

namespace {

// Weighted sums for a straight line by least squares.
struct Line {
  double w = 0, x = 0, xx = 0, y = 0, xy = 0;
  void add(double weight, double t, double d) {
    w += weight, x += weight * t, xx += weight * t * t, y += weight * d, xy += weight * t * d;
  }
  double det() const { return w * xx - x * x; }
};

// Fits the shift, and the rate if `rate`; `known` is the rate otherwise.
ClockFit fit(std::span<const LocalShift> shifts, bool rate, double known) {
  std::vector<double> huber(shifts.size(), 1), error(shifts.size());
  ClockFit out{.clock = {0, known}, .pieces = shifts.size()};
  Line sums;
  for (int again = 0; again < 12; ++again) {
    sums = {};
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      const LocalShift& s = shifts[i];
      sums.add(huber[i] / (s.uncertainty * s.uncertainty), s.time, s.shift - known * s.time);
    }
    out.clock = {sums.y / sums.w, known};
    if (rate)
      out.clock = {(sums.xx * sums.y - sums.x * sums.xy) / sums.det(),
                   known + (sums.w * sums.xy - sums.x * sums.y) / sums.det()};
    for (std::size_t i = 0; i < shifts.size(); ++i)
      error[i] = (shifts[i].shift - out.clock.shift - out.clock.rate * shifts[i].time) /
                 shifts[i].uncertainty;
    const double scale = std::max(scale_of(error), 1e-9);
    for (std::size_t i = 0; i < shifts.size(); ++i)
      huber[i] = std::min(1.0, 1.345 * scale / std::max(std::abs(error[i]), 1e-300));
  }
  double square = 0;
  for (std::size_t i = 0; i < shifts.size(); ++i) square += huber[i] * error[i] * error[i];
  const double q = std::max(1.0, square / (static_cast<double>(shifts.size()) - (rate ? 2 : 1)));
  out.shift_uncertainty = std::sqrt(q * (rate ? sums.xx / sums.det() : 1 / sums.w));
  out.rate_uncertainty = rate ? std::sqrt(q * sums.w / sums.det()) : 0;
  return out;
}

}  // namespace

ClockFit fit_clock(std::span<const LocalShift> shifts) { return fit(shifts, true, 0); }

ClockFit fit_shift(std::span<const LocalShift> shifts, double rate) {
  return fit(shifts, false, rate);
}

namespace {

constexpr double least_correlation = 0.6;
constexpr double least_fall = 0.01;  // fall of r within a tenth of the shorter recording
constexpr double clearly_better =
    0.005;  // in correlation_with_rest(), of the best peak over the next
constexpr double clearly_higher = 0.01;  // in r, of a peak over the next one

// Reason why an alignment is impossible; align() adds the name of the recording.
struct Refusal {
  std::string found, expected, try_this;
};

[[noreturn]] void refuse(std::string found, std::string expected, std::string try_this) {
  throw Refusal{std::move(found), std::move(expected), std::move(try_this)};
}

// --- which channels ---

bool holds(const signals::Series& s, const signals::Field& field) {
  return std::ranges::any_of(s.topic.fields, [&](const signals::Field& f) {
    return f.name == field.name && f.unit == field.unit;
  });
}

std::string name_of(const signals::Series& s, const signals::Field& f) {
  return s.topic.fields.size() > 1 ? s.topic.name + "." + f.name : s.topic.name;
}

// Returns every channel that both recordings have, with its samples.
std::vector<Pair> common_pairs(const signals::Table& first, const signals::Table& other) {
  std::vector<Pair> out;
  for (const signals::Series& a : first.series) {
    const signals::Series* b = other.find(a.topic.name);
    if (!b) continue;
    for (std::size_t i = 0; i < a.topic.fields.size(); ++i) {
      const signals::Field& field = a.topic.fields[i];
      if (!holds(*b, field)) continue;
      const std::string name = name_of(a, field);
      Pair pair{signal_of(name, {&a.time_ns, &a.columns[i]}),
                signal_of(name, {&b->time_ns, other.column(b->topic.name, field.name)}),
                field.unit};
      if (!pair.first.empty() && !pair.other.empty()) out.push_back(std::move(pair));
    }
  }
  return out;
}

bool moves(const Pair& pair) {
  return spread_of(pair.first).moves() && spread_of(pair.other).moves();
}

// Returns the index of a channel's kind in the order of preference.
std::size_t kind_of(const Pair& pair) {
  static constexpr std::array<std::string_view, 5> kinds = {"/angle", "/length", "/position",
                                                            "/tension", "/pressure"};
  const std::string& name = pair.first.channel;
  for (std::size_t k = 0; k < kinds.size(); ++k)
    if (name.find(kinds[k]) != name.npos) return k;
  return name.ends_with("/count") ? kinds.size() + 1 : kinds.size();
}

// Returns the channels that move in both recordings, of the first kind that has any, 8 at most.
std::vector<Pair> chosen_pairs(std::vector<Pair> all) {
  std::erase_if(all, [](const Pair& p) { return !is_of_motion(p.first.channel) || !moves(p); });
  std::size_t first = 100;
  for (const Pair& p : all) first = std::min(first, kind_of(p));
  std::erase_if(all, [&](const Pair& p) { return kind_of(p) != first; });
  constexpr std::size_t most = 8;
  if (all.size() > most) all.resize(most);
  if (all.empty())
    refuse(
        "no common channel that moves in both recordings",
        "a channel that both have, and that is neither constant nor nothing but noise",
        "a mapping of the measurement's columns to the run's channels, as sinew import makes it");
  return all;
}

const Pair& named_pair(const std::vector<Pair>& all, const std::string& name) {
  const auto at = std::ranges::find(all, name, [](const Pair& p) { return p.first.channel; });
  if (at != all.end()) return *at;
  std::vector<std::string> names;
  for (const Pair& p : all) names.push_back(p.first.channel);
  const std::string near = config::closest_in_quotes(name, {names.begin(), names.end()});
  refuse(config::in_quotes(name) + ", which is not in both recordings", "a channel that both have",
         near.empty() ? "another channel" : near);
}

std::vector<Pair> requested_pairs(const std::vector<Pair>& all,
                                  const std::vector<std::string>& names) {
  std::vector<Pair> out;
  for (const std::string& name : names) {
    const Pair& pair = named_pair(all, name);
    if (!moves(pair))
      refuse(name + ", which is constant or nothing but noise in one of the recordings",
             "a channel that moves in both", "another channel");
    out.push_back(pair);
  }
  return out;
}

bool same_samples(const std::vector<Pair>& pairs) {
  return std::ranges::all_of(pairs, [](const Pair& p) {
    return p.first.time == p.other.time && p.first.value == p.other.value;
  });
}

// --- by an event ---

EventPair requested_event(const std::vector<Pair>& all, const AlignRequest& request) {
  const Event event = parse_event(request.event);
  const Pair& pair = named_pair(all, event.channel);
  const double level = config::quantity(event.level, pair.unit, "event", request.atmosphere);
  const auto first = first_crossing(pair.first, level, event.upwards);
  const auto other = first_crossing(pair.other, level, event.upwards);
  if (!first || !other)
    refuse(fmt::format("{}: it never crosses {} {} in the {} recording", event.channel, event.level,
                       event.upwards ? "upwards" : "downwards", first ? "other" : "first"),
           "an event that happens in both", "another level or channel");
  return {*first, *other, request.event};
}

// Aligns by an event. Returns its time in the first recording [s].
double align_by_event(const std::vector<Pair>& all, const AlignRequest& request, Alignment& out) {
  EventPair found;
  if (!request.event.empty()) {
    found = requested_event(all, request);
  } else {
    const std::vector<Pair> pairs = chosen_pairs(all);
    const auto surest = surest_motion(pairs);
    if (!surest)
      refuse("no channel that stands still first and then begins to move, in both recordings",
             "recordings that begin at rest", "an event of your own, or align=correlation");
    found = *surest;
  }
  out.event = found.words;
  out.clock = {found.shift(), 0};
  out.shift_uncertainty = found.uncertainty();
  return found.first.time;
}

// --- by correlation ---

void require_clear(const Found& found, const std::string& channels) {
  if (found.r < least_correlation)
    refuse(fmt::format("a correlation of {:.2f} at best, of {}", found.r, channels),
           fmt::format("at least {}", least_correlation),
           "other channels, an event, or a longer piece of the same motion");
  if (found.fall < least_fall)
    refuse(fmt::format("a correlation of {:.3f} that hardly changes with the shift, of {}", found.r,
                       channels),
           "a motion that does not repeat itself", "another channel, or an event");
}

[[noreturn]] void repeats(const Clock& one, const Clock& other, const std::string& channels) {
  refuse(
      fmt::format("shifts of {:.3f} s and of {:.3f} s, at which {} are as much alike", one.shift,
                  other.shift, channels),
      "one shift that is clearly the best: the motion repeats itself",
      "an event, a limit of the shift below half of its period, or recordings that begin and end "
      "at rest");
}

// Returns, of the peaks that are nearly as high, the one at which beginnings and ends agree best.
Clock best_of(const std::vector<Pair>& pairs, const Found& found, const std::string& channels) {
  if (found.others.empty()) return found.clock;
  Clock best = found.clock, second = found.others.front();
  double r = correlation_with_rest(pairs, best).value_or(-1), next = -1;
  const auto free = overlap_correlation(pairs, best);
  bool as_high = false;
  for (const Clock& other : found.others) {
    const auto its = overlap_correlation(pairs, other);
    as_high = as_high || (its && free && its->r > free->r - clearly_higher);
    const double held = correlation_with_rest(pairs, other).value_or(-1);
    if (held > r) {
      second = std::exchange(best, other);
      next = std::exchange(r, held);
    } else if (held > next) {
      second = other;
      next = held;
    }
  }
  if (!as_high) return found.clock;
  if (!(r > next + clearly_better)) repeats(best, second, channels);
  return best;
}

std::string list_of(const std::vector<std::string>& channels) {
  return fmt::format("{}", fmt::join(channels, ", "));
}

// Returns the half width of the peak of the first recording's autocorrelation [s].
double own_width(const std::vector<Pair>& pairs) {
  std::vector<Pair> own;
  for (const Pair& p : pairs) own.push_back({p.first, p.first, p.unit});
  const auto found = search(own, INFINITY, false);
  return found ? found->half_width : 10 * longest_step(pairs);
}

// Fits the shift, and the rate on request, to the shifts of pieces; twice, because a better clock
// makes the pieces more alike.
void follow_clock(const std::vector<Pair>& pairs, double known_at, double half_width,
                  const AlignRequest& request, Alignment& out) {
  for (int again = 0; again < 2; ++again) {
    const std::vector<LocalShift> shifts = local_shifts(pairs, out.clock, known_at, half_width);
    out.pieces = shifts.size();
    if (shifts.size() < least_pieces) break;
    const ClockFit fit = fit_clock(shifts);
    if (request.fit_clock) {
      out.clock = fit.clock;
      out.shift_uncertainty = fit.shift_uncertainty;
      out.rate_uncertainty = fit.rate_uncertainty;
      continue;
    }
    if (std::abs(fit.clock.rate) > 3 * fit.rate_uncertainty) {
      out.rate_seen = fit.clock.rate;
      out.rate_seen_uncertainty = fit.rate_uncertainty;
    }
    if (request.by == AlignBy::correlation)
      out.shift_uncertainty = fit_shift(shifts, 0).shift_uncertainty;
    break;
  }
  if (request.fit_clock && out.pieces < least_pieces)
    refuse(fmt::format("{} pieces of the recording with a shift of their own, of {}", out.pieces,
                       list_of(out.channels)),
           fmt::format("{} or more, for the clock's rate", least_pieces),
           "a longer recording, or a clock that is taken as it is");
}

Alignment aligned(const signals::Table& first, const signals::Table& other,
                  const AlignRequest& request) {
  const std::vector<Pair> all = common_pairs(first, other);
  Alignment out{.clock = {request.by == AlignBy::known ? request.shift : 0, 0}};
  const bool correlated = request.by == AlignBy::correlation || request.fit_clock;
  double known_at = request.known_at;
  if (request.by == AlignBy::event) known_at = align_by_event(all, request, out);
  if (!correlated) return out;

  const std::vector<Pair> pairs =
      request.channels.empty() ? chosen_pairs(all) : requested_pairs(all, request.channels);
  for (const Pair& p : pairs) out.channels.push_back(p.first.channel);
  if (same_samples(pairs)) {
    out.same = true;
    out.clock = {};
    out.correlation = 1;
    out.shift_uncertainty = out.rate_uncertainty = 0;
    return out;
  }
  double half_width = 0;
  if (request.by == AlignBy::correlation) {
    if (!(request.largest_shift > 0))
      refuse(fmt::format("a largest shift of {:g} s", request.largest_shift), "a time above 0 s",
             "1 s");
    const auto found = search(pairs, request.largest_shift, request.fit_clock);
    if (!found)
      refuse("recordings that overlap by less than half of the shorter one at every shift",
             "two recordings of one motion", "a greater limit of the shift");
    require_clear(*found, list_of(out.channels));
    half_width = found->half_width;
    known_at = 0.5 * (pairs.front().first.time.front() + pairs.front().first.time.back());
    const double width = std::max(longest_step(pairs), 0.25 * half_width);
    out.clock = refine(pairs, best_of(pairs, *found, list_of(out.channels)), width).clock;
  } else {
    half_width = own_width(pairs);
  }
  follow_clock(pairs, known_at, half_width, request, out);
  if (const auto reached = overlap_correlation(pairs, out.clock)) out.correlation = reached->r;
  return out;
}

}  // namespace

Alignment align(const signals::Table& first, const signals::Table& other,
                const AlignRequest& request) {
  try {
    return aligned(first, other, request);
  } catch (const Refusal& r) {
    config::fail({request.name.empty() ? "recording" : request.name, 0, 0}, "align", r.found,
                 r.expected, r.try_this);
  }
}

void reclock(signals::Table& table, const Clock& clock) {
  if (clock.shift == 0 && clock.rate == 0) return;
  for (signals::Series& s : table.series) {
    signals::Times times(s.time_ns.file());
    for (const std::int64_t t : s.time_ns)
      times.push_back(
          std::llround((static_cast<double>(t) - 1e9 * clock.shift) / (1 + clock.rate)));
    s.time_ns = std::move(times);
  }
}

}  // namespace sinew::analysis
