#include "sinew/tune/sensitivity.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/tune/sample.h"
#include "sinew/tune/table.h"
#include "sinew/units/hash.h"

namespace sinew::tune {

namespace {

std::string three_digits(const std::string& number) {
  return number.empty() ? "" : fmt::format("{:.3g}", std::stod(number));
}

// Returns a row without the figure's name, with each interval after its number.
std::vector<std::string> shown(const std::vector<std::string>& headings,
                               const std::vector<std::string>& row) {
  std::vector<std::string> out{row[1]};
  for (std::size_t i = 2; i < row.size(); ++i) {
    out.push_back(three_digits(row[i]));
    if (i + 1 == row.size() || !headings[i + 1].ends_with(", low")) continue;
    out.push_back(fmt::format("{} to {}", three_digits(row[i + 1]), three_digits(row[i + 2])));
    i += 2;
  }
  return out;
}

std::vector<std::string> titles_of(const std::vector<std::string>& headings) {
  std::vector<std::string> out{""};
  for (std::size_t i = 2; i < headings.size(); ++i) {
    if (headings[i].ends_with(", high")) continue;
    out.push_back(headings[i].ends_with(", low") ? "95 %" : headings[i]);
  }
  return out;
}

}  // namespace

std::string text_of(const Design& design, const Sweep& runs, const FigureSensitivity& figure) {
  if (!figure.found) return figure.figure + ": too few runs have it, or it never changes\n";
  const Sensitivity& s = *figure.found;
  const std::vector<std::string> headings = sensitivity_headings(design.method);
  const std::vector<std::string> titles = titles_of(headings);
  std::vector<report::TextTable::Align> align(titles.size(), report::TextTable::Align::right);
  align.front() = report::TextTable::Align::left;
  report::TextTable table(titles, align);
  for (const auto& row : sensitivity_rows(design, runs, {figure})) table.add(shown(headings, row));
  return fmt::format("{}: mean {:.5g}, standard deviation {:.3g}{}\n{}", figure.figure, s.mean,
                     std::sqrt(s.variance),
                     s.left_out > 0 ? fmt::format(", {} left out", s.left_out) : "",
                     table.text("  "));
}

namespace {

// A column: its heading, and the number of an effect that it shows.
struct ShownNumber {
  const char* heading;
  Estimate Effect::*which;
  bool with_interval;
};

std::vector<ShownNumber> numbers(Method method) {
  if (method == Method::one_at_a_time)
    return {{"to the low end", &Effect::to_low, false},
            {"to the high end", &Effect::to_high, false}};
  if (method == Method::morris)
    return {{"mean size", &Effect::mean_size, true},
            {"mean", &Effect::mean, true},
            {"spread", &Effect::spread, false}};
  return {{"alone", &Effect::first, true}, {"with all others", &Effect::total, true}};
}

const char* to_text(Method method) {
  if (method == Method::one_at_a_time) return "one at a time";
  return method == Method::morris ? "morris" : "sobol";
}

std::string cell(double x) { return fmt::format("{:.6g}", x); }

// Returns the figures of a column, NaN for a run without one.
std::vector<double> column(const std::vector<Row>& rows, std::size_t index) {
  std::vector<double> out;
  for (const Row& row : rows)
    out.push_back(row.cells[index].empty() ? std::nan("") : std::stod(row.cells[index]));
  return out;
}

}  // namespace

Sweep sweep_of(const Design& design, Sweep base) {
  const auto refuse = [](const char* setting, std::string found, std::string expected,
                         std::string try_this = "") {
    config::fail({setting, 0, 0}, "", std::move(found), std::move(expected), std::move(try_this));
  };
  if (!base.sample || base.sample->ranges.empty())
    refuse("range", "none", "what is varied", "range=\"KEY=from:to unit\"");
  if (!base.axes.empty()) refuse("vary", base.axes.front().key, "ranges alone");
  if (base.largest) refuse("largest", base.largest->axis.key, "ranges alone");
  if (base.report.empty()) refuse("report", "no figure", "at least one", "report=\"duration_s\"");
  const std::size_t all = size(design);
  if (all > most_points)
    refuse("points", fmt::format("{} runs", all), fmt::format("at most {}", most_points));
  base.sample->points = all;
  base.sample->given = shares(design);
  return base;
}

std::vector<FigureSensitivity> sensitivities(const Design& design, const Sweep& runs,
                                             const std::vector<Row>& rows) {
  std::vector<FigureSensitivity> out;
  for (std::size_t i = 0; i < runs.report.size(); ++i)
    out.push_back({runs.report[i].heading(),
                   sensitivity(design, column(rows, runs.sample->ranges.size() + i))});
  return out;
}

std::vector<std::string> sensitivity_headings(Method method) {
  std::vector<std::string> out{"figure", "range"};
  for (const ShownNumber& n : numbers(method)) {
    out.emplace_back(n.heading);
    if (!n.with_interval) continue;
    out.push_back(fmt::format("{}, low", n.heading));
    out.push_back(fmt::format("{}, high", n.heading));
  }
  return out;
}

std::vector<std::vector<std::string>> sensitivity_rows(const Design& design, const Sweep& runs,
                                                       const std::vector<FigureSensitivity>& all) {
  std::vector<std::vector<std::string>> out;
  for (const FigureSensitivity& f : all)
    for (std::size_t i = 0; i < runs.sample->ranges.size(); ++i) {
      std::vector<std::string> row{f.figure, runs.sample->ranges[i].axis.heading()};
      for (const ShownNumber& n : numbers(design.method)) {
        const Estimate e = f.found ? f.found->effects[i].*n.which : Estimate{};
        const auto add = [&](double x) { row.push_back(f.found ? cell(x) : ""); };
        add(e.value);
        if (n.with_interval) add(e.low), add(e.high);
      }
      out.push_back(std::move(row));
    }
  return out;
}

std::string sensitivity_json(const Design& design, const Sweep& runs,
                             const std::vector<FigureSensitivity>& all) {
  Json out{{"format", "sinew.sensitivity/1"},
           {"method", to_text(design.method)},
           {"runs", size(design)},
           {"figures", Json::array()}};
  for (const FigureSensitivity& f : all) {
    Json figure{{"figure", f.figure}};
    if (f.found) {
      figure["mean"] = f.found->mean;
      figure["standard_deviation"] = std::sqrt(f.found->variance);
      figure["left_out"] = f.found->left_out;
      figure["ranges"] = Json::array();
      for (std::size_t i = 0; i < f.found->effects.size(); ++i) {
        Json range{{"range", runs.sample->ranges[i].axis.heading()}};
        for (const ShownNumber& n : numbers(design.method)) {
          const Estimate& e = f.found->effects[i].*n.which;
          range[n.heading] =
              n.with_interval ? Json::array({e.value, e.low, e.high}) : Json(e.value);
        }
        figure["ranges"].push_back(std::move(range));
      }
    }
    out["figures"].push_back(std::move(figure));
  }
  return out.text(2) + "\n";
}

namespace {

constexpr std::size_t resamples = 1000;
constexpr double morris_step = 2.0 / 3.0;  // levels are 0, 1/3, 2/3, 1

std::uint64_t draw(std::uint64_t seed, std::uint64_t what, std::uint64_t which) {
  return units::mix(units::mix(units::mix(seed ^ 0x5e5e) + what) + which);
}

// --- designs ---

std::vector<double> one_at_a_time(const Design& design) {
  const std::size_t d = design.ranges;
  std::vector<double> out(size(design) * d, 0.5);
  for (std::size_t i = 0; i < d; ++i) {
    out[(1 + 2 * i) * d + i] = 0;
    out[(2 + 2 * i) * d + i] = 1;
  }
  return out;
}

// Returns the points of the paths. A path begins at a random level and changes each range once, up
// or down, in a random order.
std::vector<double> paths(const Design& design) {
  const std::size_t d = design.ranges;
  std::vector<double> out;
  std::vector<std::size_t> order(d);
  for (std::size_t path = 0; path < design.count; ++path) {
    std::vector<double> at(d);
    for (std::size_t i = 0; i < d; ++i)
      at[i] = static_cast<double>(draw(design.seed, 2 * path, i) >> 62) / 3.0;
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t left = d; left > 1; --left)
      std::swap(order[left - 1], order[draw(design.seed, 2 * path + 1, left) % left]);
    out.insert(out.end(), at.begin(), at.end());
    for (const std::size_t i : order) {
      at[i] += at[i] < 0.5 ? morris_step : -morris_step;
      out.insert(out.end(), at.begin(), at.end());
    }
  }
  for (double& x : out) x = std::clamp(x, 0.0, 1.0);  // 1/3 + 2/3 may round to more than 1
  return out;
}

// Returns A, B and the AB_i of each row, row by row.
std::vector<double> rows(const Design& design) {
  const std::size_t d = design.ranges;
  const std::vector<double> both = tune::sobol_shares(2 * d, design.count, design.seed);
  std::vector<double> out;
  out.reserve(size(design) * d);
  for (std::size_t row = 0; row < design.count; ++row) {
    const auto a = both.begin() + static_cast<std::ptrdiff_t>(2 * d * row);
    const auto b = a + static_cast<std::ptrdiff_t>(d);
    out.insert(out.end(), a, b);
    out.insert(out.end(), b, b + static_cast<std::ptrdiff_t>(d));
    for (std::size_t i = 0; i < d; ++i) {
      out.insert(out.end(), a, b);
      out[out.size() - d + i] = b[static_cast<std::ptrdiff_t>(i)];
    }
  }
  return out;
}

// --- estimates ---

bool finite(std::span<const double> figures) {
  return std::ranges::all_of(figures, [](double x) { return std::isfinite(x); });
}

// Returns the complete blocks of figures: paths or rows.
std::vector<std::span<const double>> whole_blocks(std::span<const double> figures,
                                                  std::size_t length) {
  std::vector<std::span<const double>> out;
  for (std::size_t at = 0; at + length <= figures.size(); at += length)
    if (const auto block = figures.subspan(at, length); finite(block)) out.push_back(block);
  return out;
}

using Blocks = std::vector<std::span<const double>>;

// Returns statistics of the blocks with their intervals. of(blocks) must always return the same
// number of values.
std::vector<Estimate> bootstrap(const Blocks& blocks, std::uint64_t seed,
                                const std::function<std::vector<double>(const Blocks&)>& of) {
  const std::vector<double> values = of(blocks);
  std::vector<std::vector<double>> drawn(values.size());
  Blocks again(blocks.size());
  for (std::size_t k = 0; k < resamples; ++k) {
    for (std::size_t i = 0; i < again.size(); ++i)
      again[i] = blocks[draw(~seed, k, i) % blocks.size()];
    const std::vector<double> numbers = of(again);
    for (std::size_t v = 0; v < values.size(); ++v)
      if (std::isfinite(numbers[v])) drawn[v].push_back(numbers[v]);
  }
  std::vector<Estimate> out;
  for (std::size_t v = 0; v < values.size(); ++v) {
    std::vector<double>& d = drawn[v];
    std::ranges::sort(d);
    const auto at = [&](double share) {
      if (d.empty()) return values[v];
      return d[static_cast<std::size_t>(share * static_cast<double>(d.size() - 1))];
    };
    out.push_back({values[v], at(0.025), at(0.975)});
  }
  return out;
}

struct Moments {
  double mean = 0, variance = 0;
};
Moments moments(const std::vector<double>& x) {
  Moments out;
  const auto n = static_cast<double>(x.size());
  out.mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
  for (const double one : x) out.variance += (one - out.mean) * (one - out.mean) / n;
  return out;
}

std::optional<Sensitivity> of_ends(const Design& design, std::span<const double> f) {
  if (!std::isfinite(f[0])) return std::nullopt;
  Sensitivity out;
  std::vector<double> there;
  for (const double x : f)
    if (std::isfinite(x)) there.push_back(x);
  const Moments all = moments(there);
  out.mean = all.mean, out.variance = all.variance;
  out.left_out = f.size() - there.size();
  for (std::size_t i = 0; i < design.ranges; ++i) {
    const double low = f[1 + 2 * i] - f[0], high = f[2 + 2 * i] - f[0];
    out.effects.push_back({.to_low = {low, low, low}, .to_high = {high, high, high}});
  }
  return out;
}

// Estimates elementary effects of paths. The design gives the range and the direction of each step.
std::optional<Sensitivity> of_paths(const Design& design, std::span<const double> f) {
  const std::size_t d = design.ranges;
  const std::vector<double> at = paths(design);
  std::vector<double> effects(design.count * d, std::nan(""));  // indexed by path and range
  std::vector<double> there;
  for (std::size_t path = 0; path < design.count; ++path) {
    const std::span<const double> own = f.subspan(path * (d + 1), d + 1);
    if (!finite(own)) continue;
    there.insert(there.end(), own.begin(), own.end());
    for (std::size_t step = 0; step < d; ++step) {
      const double* from = &at[(path * (d + 1) + step) * d];
      std::size_t i = 0;
      while (from[i] == from[d + i]) ++i;
      effects[path * d + i] = (own[step + 1] - own[step]) / (from[d + i] - from[i]);
    }
  }
  const Blocks blocks = whole_blocks(effects, d);
  if (blocks.size() < 2) return std::nullopt;
  Sensitivity out;
  out.left_out = design.count - blocks.size();
  const Moments all = moments(there);
  out.mean = all.mean, out.variance = all.variance;
  for (std::size_t i = 0; i < d; ++i) {
    const std::vector<Estimate> e = bootstrap(blocks, design.seed, [&](const Blocks& some) {
      std::vector<double> one;
      double size = 0;
      for (const auto& block : some) one.push_back(block[i]), size += std::fabs(block[i]);
      const Moments m = moments(one);
      const auto n = static_cast<double>(one.size());
      return std::vector<double>{size / n, m.mean, std::sqrt(m.variance * n / (n - 1))};
    });
    out.effects.push_back({.mean_size = e[0], .mean = e[1], .spread = e[2]});
  }
  return out;
}

// Subtracts the mean first, which makes the estimate of S_i far more accurate.
std::vector<double> indices(const Blocks& rows, std::size_t i) {
  std::vector<double> ab;
  for (const auto& row : rows) ab.insert(ab.end(), {row[0], row[1]});
  const Moments m = moments(ab);
  double first = 0, total = 0;
  for (const auto& row : rows) {
    first += (row[1] - m.mean) * (row[2 + i] - row[0]);
    total += 0.5 * (row[0] - row[2 + i]) * (row[0] - row[2 + i]);
  }
  const double all = static_cast<double>(rows.size()) * m.variance;
  return {first / all, total / all};
}

std::optional<Sensitivity> of_rows(const Design& design, std::span<const double> f) {
  const Blocks blocks = whole_blocks(f, design.ranges + 2);
  if (blocks.size() < 2) return std::nullopt;
  Sensitivity out;
  out.left_out = design.count - blocks.size();
  std::vector<double> ab;
  for (const auto& row : blocks) ab.insert(ab.end(), {row[0], row[1]});
  const Moments m = moments(ab);
  out.mean = m.mean, out.variance = m.variance;
  if (!(m.variance > 0)) return std::nullopt;
  for (std::size_t i = 0; i < design.ranges; ++i) {
    const std::vector<Estimate> e =
        bootstrap(blocks, design.seed, [&](const Blocks& some) { return indices(some, i); });
    out.effects.push_back({.first = e[0], .total = e[1]});
  }
  return out;
}

}  // namespace

Design design_of(std::string_view method, std::size_t ranges, int count, int seed) {
  Design out{.ranges = ranges, .seed = static_cast<std::uint64_t>(seed)};
  if (method == "morris") out.method = Method::morris;
  if (method == "ends") out.method = Method::one_at_a_time;
  const int usual = out.method == Method::morris ? 20 : 256;
  out.count = static_cast<std::size_t>(count > 0 ? count : usual);
  if (count > 0 && out.method == Method::one_at_a_time)
    config::fail({"points", 0, 0}, "", std::to_string(count),
                 "a count for sobol or morris: ends runs both ends of each range once");
  if (out.method == Method::sobol && !std::has_single_bit(out.count))
    config::fail({"points", 0, 0}, "", std::to_string(count),
                 "a power of two, for which the points of the sequence are spread evenly",
                 std::to_string(std::min<std::size_t>(std::bit_ceil(out.count), 1U << 19)));
  return out;
}

std::size_t size(const Design& design) {
  if (design.method == Method::one_at_a_time) return 2 * design.ranges + 1;
  const std::size_t each = design.method == Method::morris ? 1 : 2;
  return design.count * (design.ranges + each);
}

std::vector<double> shares(const Design& design) {
  if (design.method == Method::one_at_a_time) return one_at_a_time(design);
  return design.method == Method::morris ? paths(design) : rows(design);
}

std::optional<Sensitivity> sensitivity(const Design& design, std::span<const double> figures) {
  if (figures.size() != size(design) || figures.empty()) return std::nullopt;
  if (design.method == Method::one_at_a_time) return of_ends(design, figures);
  return design.method == Method::morris ? of_paths(design, figures) : of_rows(design, figures);
}

}  // namespace sinew::tune
