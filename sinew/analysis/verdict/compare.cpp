#include "sinew/analysis/verdict/compare.h"

#include <algorithm>
#include <bit>

#include "sinew/signals/tick.h"

namespace sinew::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t half_tick = signals::tick_nanoseconds / 2;

std::size_t within(const signals::Times& times, std::int64_t from, std::int64_t to) {
  const auto first = std::ranges::lower_bound(times, from);
  const auto last = std::ranges::upper_bound(times, to);
  return last > first ? static_cast<std::size_t>(last - first) : 0;
}

// Returns an empty pairing, stored in the same file as `like`.
PairedSamples paired_samples(Pairing how, Recording like) {
  const signals::PageFile file = like.time_ns->file();
  return {how, signals::Times(file), signals::Column(file)};
}

PairedSamples pair_together(Recording a, Recording b) {
  PairedSamples out = paired_samples(Pairing::together, a);
  std::size_t i = 0, k = 0;
  while (i < a.time_ns->size() && k < b.time_ns->size()) {
    const std::int64_t ta = (*a.time_ns)[i], tb = (*b.time_ns)[k];
    if (std::abs(tb - ta) > half_tick) {
      ++(ta < tb ? i : k);
      continue;
    }
    out.time_ns.push_back(ta);
    out.difference.push_back((*b.values)[k++] - (*a.values)[i++]);
  }
  return out;
}

// Interpolates linearly at `t`, which must be within `from`'s times; the search starts at sample
// `k` and leaves it there.
double straight_at(Recording from, std::int64_t t, std::size_t& k) {
  const auto& time = *from.time_ns;
  while (k + 1 < time.size() && time[k + 1] <= t) ++k;
  const double before = (*from.values)[k];
  if (time[k] == t || k + 1 == time.size()) return before;
  const double share =
      static_cast<double>(t - time[k]) / static_cast<double>(time[k + 1] - time[k]);
  return before + share * ((*from.values)[k + 1] - before);
}

PairedSamples pair_between(Recording sparse, Recording dense, double sign) {
  PairedSamples out = paired_samples(Pairing::between, sparse);
  std::size_t k = 0;
  for (std::size_t i = 0; i < sparse.time_ns->size(); ++i) {
    const std::int64_t t = (*sparse.time_ns)[i];
    if (t < dense.time_ns->front() || t > dense.time_ns->back()) continue;
    out.time_ns.push_back(t);
    out.difference.push_back(sign * (straight_at(dense, t, k) - (*sparse.values)[i]));
  }
  return out;
}

// Returns the state of a valve at `t`; updates `k`, the number of edges up to `t`.
double held_at(Recording edges, std::int64_t t, std::size_t& k) {
  while (k < edges.time_ns->size() && (*edges.time_ns)[k] <= t) ++k;
  return k > 0 ? (*edges.values)[k - 1] : 0.0;
}

bool same_samples(Recording a, Recording b) {
  const auto same_bits = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return *a.time_ns == *b.time_ns && std::ranges::equal(*a.values, *b.values, same_bits);
}

double span_of(Recording a, Recording b) {
  double low = none, high = none;
  for (const auto* values : {a.values, b.values})
    for (const double v : *values) {
      if (!std::isfinite(v)) continue;
      if (!(v >= low)) low = v;
      if (!(v <= high)) high = v;
    }
  return high > low ? high - low : 0;
}

// Returns the difference without its correlation. weight(i) is 1, or the duration of pair i.
template <class Weight>
Difference summed(Recording a, Recording b, const PairedSamples& met, Weight weight) {
  Difference out{.how = met.how, .same = same_samples(a, b), .span = span_of(a, b)};
  double sum = 0, square = 0, all = 0;
  for (std::size_t i = 0; i < met.difference.size(); ++i) {
    const double d = met.difference[i];
    if (!std::isfinite(d)) {
      ++out.gaps;
      continue;
    }
    ++out.samples;
    sum += d * weight(i);
    square += d * d * weight(i);
    all += weight(i);
    if (std::abs(d) <= std::abs(out.largest)) continue;
    out.largest = d == 0 ? 0.0 : d;
    out.at = static_cast<double>(met.time_ns[i]) / 1e9;
  }
  if (!(all > 0)) return out;
  out.rms = std::sqrt(square / all);
  out.bias = sum / all;
  return out;
}

// Returns the correlation of a and a + d at the times where they met.
double correlation(Recording a, const PairedSamples& met) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0, a0 = 0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < met.difference.size(); ++i) {
    const double d = met.difference[i], value = straight_at(a, met.time_ns[i], k);
    if (!std::isfinite(d) || !std::isfinite(value)) continue;
    if (n == 0) a0 = value;
    const double x = value - a0, y = x + d;
    n += 1, sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
  }
  const double va = n * saa - sa * sa, vb = n * sbb - sb * sb;
  return va > 0 && vb > 0 ? std::clamp((n * sab - sa * sb) / std::sqrt(va * vb), -1.0, 1.0) : none;
}

bool has_field(const signals::Series& series, const signals::Field& like) {
  return std::ranges::any_of(series.topic.fields, [&](const signals::Field& f) {
    return f.name == like.name && f.unit == like.unit;
  });
}

}  // namespace

std::string_view to_text(Pairing how) {
  switch (how) {
    case Pairing::together:
      return "together";
    case Pairing::between:
      return "between";
    case Pairing::held:
      return "held";
    case Pairing::never:
      break;
  }
  return "never";
}

PairedSamples pair_samples(Recording a, Recording b) {
  if (a.time_ns->empty() || b.time_ns->empty()) return {};
  const std::int64_t from = std::max(a.time_ns->front(), b.time_ns->front());
  const std::int64_t to = std::min(a.time_ns->back(), b.time_ns->back());
  const std::size_t of_a = within(*a.time_ns, from, to), of_b = within(*b.time_ns, from, to);

  PairedSamples out = pair_together(a, b);
  if (2 * out.time_ns.size() < std::min(of_a, of_b))
    out = of_a <= of_b ? pair_between(a, b, 1) : pair_between(b, a, -1);
  return out.time_ns.empty() ? PairedSamples{} : out;
}

PairedSamples pair_edges(Recording a, Recording b, std::int64_t from, std::int64_t to) {
  if (to <= from) return {};
  PairedSamples out = paired_samples(Pairing::held, a);
  std::size_t i = 0, k = 0;
  for (std::int64_t t = from; t < to;) {
    const double d = held_at(b, t, k) - held_at(a, t, i);
    if (out.time_ns.empty() || d != out.difference.back()) {
      out.time_ns.push_back(t);
      out.difference.push_back(d);
    }
    // Continues at the next edge of either.
    const auto next = [&](Recording of, std::size_t over) {
      return over < of.time_ns->size() ? (*of.time_ns)[over] : to;
    };
    t = std::min(next(a, i), next(b, k));
  }
  return out;
}

Difference difference(Recording a, Recording b, const PairedSamples& met) {
  Difference out = summed(a, b, met, [](std::size_t) { return 1.0; });
  out.correlation = correlation(a, met);
  return out;
}

Difference difference_of_edges(Recording a, Recording b, std::int64_t from, std::int64_t to) {
  const PairedSamples met = pair_edges(a, b, from, to);
  return summed(a, b, met, [&](std::size_t i) {
    const std::int64_t end = i + 1 < met.time_ns.size() ? met.time_ns[i + 1] : to;
    return static_cast<double>(end - met.time_ns[i]);
  });
}

bool is_edges(std::string_view topic) { return topic.ends_with("/open"); }

std::optional<Times> times_of(const signals::Table& table) {
  std::optional<Times> out;
  for (const signals::Series& s : table.series) {
    if (s.time_ns.empty() || is_edges(s.topic.name)) continue;
    if (!out) out = Times{s.time_ns.front(), s.time_ns.back()};
    out->first = std::min(out->first, s.time_ns.front());
    out->last = std::max(out->last, s.time_ns.back());
  }
  return out;
}

std::vector<ChannelDifference> differences(const signals::Table& a, const signals::Table& b) {
  const std::optional<Times> times_a = times_of(a), times_b = times_of(b);
  const Times both = times_a && times_b ? Times{std::max(times_a->first, times_b->first),
                                                std::min(times_a->last, times_b->last)}
                                        : Times{};
  std::vector<ChannelDifference> out;
  for (const signals::Series& sa : a.series) {
    const signals::Series* sb = b.find(sa.topic.name);
    if (!sb || signals::has_coarse_edges(sa.topic) || signals::has_coarse_edges(sb->topic))
      continue;
    for (std::size_t f = 0; f < sa.topic.fields.size(); ++f) {
      const signals::Field& field = sa.topic.fields[f];
      if (!has_field(*sb, field)) continue;
      const Recording ra{&sa.time_ns, &sa.columns[f]};
      const Recording rb{&sb->time_ns, b.column(sb->topic.name, field.name)};
      out.push_back({sa.topic.name, field.name, field.unit,
                     is_edges(sa.topic.name) ? difference_of_edges(ra, rb, both.first, both.last)
                                             : difference(ra, rb, pair_samples(ra, rb))});
    }
  }
  return out;
}

void shift(signals::Table& table, std::int64_t by) {
  for (signals::Series& s : table.series) {
    signals::Times shifted(s.time_ns.file());
    for (const std::int64_t t : s.time_ns) shifted.push_back(t - by);
    s.time_ns = std::move(shifted);
  }
}

std::vector<FigureRow> compare_figures(const std::vector<const Summary*>& summaries) {
  std::vector<FigureRow> out;
  for (std::size_t from = 0; from < summaries.size(); ++from)
    for (const Entry& e : summaries[from]->entries()) {
      const bool known = std::any_of(summaries.begin(), summaries.begin() + static_cast<long>(from),
                                     [&](const Summary* s) { return s->find(e.key); });
      if (known) continue;
      FigureRow row{e.key, {}};
      for (const Summary* s : summaries) {
        const double* value = s->find(e.key);
        row.values.push_back(value ? std::optional(*value) : std::nullopt);
      }
      out.push_back(std::move(row));
    }
  return out;
}

std::optional<double> relative_difference(double first, double other) {
  if (other == first) return 0.0;
  if (first == 0) return std::nullopt;
  return (other - first) / std::abs(first);
}

double size_of_change(const FigureRow& row) {
  double largest = 0;
  if (row.values.empty() || !row.values.front()) return largest;
  const double first = *row.values.front();
  for (const auto& value : row.values) {
    if (!value || *value == first) continue;
    largest =
        std::max(largest, std::abs(*value - first) / std::max(std::abs(first), std::abs(*value)));
  }
  return largest;
}

}  // namespace sinew::analysis
