#include "sinew/identify/machine/run_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include "sinew/host/side_by_side.h"

namespace sinew::identify {

namespace {

constexpr double only_noise =
    1.05;  // rms of what is left, in noises, above which cells are changed
constexpr double tick = signals::tick_seconds;

// Where far more than noise is left, the search has run into a valley that is not the right one: it
// begins again with all dead times shorter, or longer.
constexpr double far_above_noise = 5;
constexpr double other_dead_times[] = {0.8, 1.2, 0.6, 1.4};

// Where a number is tried, besides where it is.
std::vector<double> places_of(const Parameter& p, double at) {
  std::vector<double> out;
  if (at > 0 && p.low >= 0)
    for (const double times : {0.5, 0.75, 1.3, 2.0}) out.push_back(at * times);
  else
    for (const double step : {-1.0, -0.3, 0.3, 1.0}) out.push_back(at + step * p.scale);
  std::erase_if(out, [&](double x) { return x < p.low || x > p.high; });
  return out;
}

using Places = std::vector<std::vector<double>>;

// Moves each number but dead times by itself to the best of a few places around where it is.
void scan_numbers(const RunResiduals& residuals, std::span<const Parameter> parameters, int threads,
                  std::vector<double>& p) {
  double best = residuals.cost(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (is_dead_time(parameters[i])) continue;
    Places tried;
    for (const double x : places_of(parameters[i], p[i])) {
      tried.push_back(p);
      tried.back()[i] = x;
    }
    std::vector<double> cost(tried.size());
    host::side_by_side(
        tried.size(), [&](std::size_t k) { cost[k] = residuals.cost(tried[k]); }, nullptr, threads);
    for (std::size_t k = 0; k < tried.size(); ++k)
      if (cost[k] < best) best = cost[k], p = tried[k];
  }
}

// The other delay of the same valve; the number of parameters where it is not searched.
std::size_t partner_of(std::span<const Parameter> parameters, std::size_t i) {
  const auto valve = [](const std::string& key) { return key.substr(0, key.rfind('.')); };
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (k != i && is_dead_time(parameters[k]) &&
        valve(parameters[k].name) == valve(parameters[i].name))
      return k;
  return parameters.size();
}

// Places in the cells some ticks around, of one valve after the other. What a run shows best is how
// much longer a valve is open than its coil is on, so the delays' difference is kept where it can
// be.
Places cells_around(std::span<const Parameter> parameters, const std::vector<double>& p,
                    int ticks) {
  constexpr double inset = 0.02 * tick;
  const auto cell = [&](std::size_t i, int by) {
    const double low = (std::floor(p[i] / tick) + by) * tick;
    return RunCell{low + inset, low + tick - inset};
  };
  Places out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_dead_time(parameters[i])) continue;
    const std::size_t k = partner_of(parameters, i);
    if (k < i) continue;
    const bool alone = k == p.size();
    for (int a = -ticks; a <= ticks; ++a)
      for (int b = alone ? 0 : -ticks; b <= (alone ? 0 : ticks); ++b) {
        if (a == 0 && b == 0) continue;
        const RunCell of = cell(i, a), other = alone ? of : cell(k, b);
        const double at = alone ? p[i] : p[k];
        const double from = std::max(of.low - p[i], other.low - at);
        const double to = std::min(of.high - p[i], other.high - at);
        const double shift = from <= to ? std::clamp(0.0, from, to) : 0.5 * (from + to);
        std::vector<double> q = p;
        q[i] = std::clamp(p[i] + shift, of.low, of.high);
        if (!alone) q[k] = std::clamp(at + shift, other.low, other.high);
        if (of.low > 0 && other.low > 0) out.push_back(std::move(q));
      }
  }
  return out;
}

// The best few of them, searched a little; false where none is better than `best`.
bool try_cells(const RunResiduals& residuals, std::span<const Parameter> parameters, int threads,
               RunSearched& best) {
  constexpr std::size_t worth_it = 6;
  constexpr int a_few_steps = 4, far = 3;
  Places tried = cells_around(parameters, best.p, far);
  if (tried.empty()) return false;
  const std::vector<double> cost = made_up_costs(residuals, parameters, best, tried, threads);
  std::vector<std::size_t> order(tried.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return cost[k]; });
  order.resize(std::min(order.size(), worth_it));
  std::vector<RunSearched> found(order.size());
  host::side_by_side(
      order.size(),
      [&](std::size_t k) {
        found[k] = search_in_cells(residuals, parameters, tried[order[k]], a_few_steps, 1);
      },
      nullptr, threads);
  const auto nearest = std::ranges::min_element(found, {}, &RunSearched::rms);
  if (nearest->rms >= best.rms) return false;
  best = *nearest;
  return true;
}

// Half the sum of squares by which a neighbouring cell has to be worse, to be ruled out: four
// standard deviations.
constexpr double ruled_out = 8;

double half_square(const RunResiduals& residuals, const RunSearched& at) {
  return 0.5 * at.rms * at.rms * static_cast<double>(residuals.count());
}

// Goes to a neighbouring cell as long as that is better.
void settle_cells(const RunResiduals& residuals, std::span<const Parameter> parameters, int threads,
                  RunSearched& best) {
  constexpr int few_moves = 3, moves = 20, steps = 6;
  for (int move = 0; move < (best.rms > only_noise ? moves : few_moves); ++move) {
    const Places tried = cells_around(parameters, best.p, 1);
    if (tried.empty()) return;
    const std::vector<double> cost = made_up_costs(residuals, parameters, best, tried, threads);
    const auto k = static_cast<std::size_t>(std::ranges::min_element(cost) - cost.begin());
    if (cost[k] > half_square(residuals, best) - 1) return;
    const RunSearched there = search_in_cells(residuals, parameters, tried[k], steps, threads);
    if (there.rms >= best.rms) return;
    best = there;
  }
}

bool same_cells(const std::vector<RunCell>& a, const std::vector<RunCell>& b) {
  return std::ranges::equal(a, b, [](const RunCell& x, const RunCell& y) {
    return x.low == y.low || std::abs(x.low - y.low) < 0.5 * tick;
  });
}

// The places around that one which the run does not rule out, by what the numbers can make up for;
// the likely ones first.
Places open_places(const RunResiduals& residuals, std::span<const Parameter> parameters,
                   int threads, const RunSearched& at, double least) {
  Places tried = cells_around(parameters, at.p, 1), out;
  if (tried.empty()) return out;
  const std::vector<double> cost = made_up_costs(residuals, parameters, at, tried, threads);
  std::vector<std::size_t> order(tried.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return cost[k]; });
  for (const std::size_t k : order)
    if (cost[k] < least + ruled_out) out.push_back(tried[k]);
  return out;
}

// Searches the cells around that the run does not rule out, and those around these; the best of all
// becomes `best`. Cells beyond so many widen those that they are beside.
void search_open_cells(const RunResiduals& residuals, std::span<const Parameter> parameters,
                       int threads, RunSearched& best) {
  constexpr std::size_t most = 16;
  constexpr int steps = 3;
  std::vector<RunSearched> all{best};
  std::vector<std::vector<RunCell>> known{best.cells};
  double least = half_square(residuals, best);
  for (std::size_t from = 0; from < all.size(); ++from)
    for (const auto& place : open_places(residuals, parameters, threads, all[from], least)) {
      const std::vector<RunCell> cells = run_cells(parameters, place);
      if (std::ranges::any_of(known, [&](const auto& k) { return same_cells(k, cells); })) continue;
      if (all.size() == most) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
          all[from].cells[i].low = std::min(all[from].cells[i].low, cells[i].low);
          all[from].cells[i].high = std::max(all[from].cells[i].high, cells[i].high);
        }
        continue;
      }
      known.push_back(cells);
      RunSearched there = search_in_cells(residuals, parameters, place, steps, threads);
      if (half_square(residuals, there) > least + ruled_out) continue;
      least = std::min(least, half_square(residuals, there));
      all.push_back(std::move(there));
    }
  const auto first = std::ranges::min_element(all, {}, &RunSearched::rms);
  std::iter_swap(all.begin(), first);
  best = all.front();
  best.others.assign(all.begin() + 1, all.end());
}

}  // namespace

bool is_dead_time(const Parameter& number) { return number.name.ends_with("ing_delay"); }

std::vector<RunCell> run_cells(std::span<const Parameter> parameters, std::span<const double> p) {
  std::vector<RunCell> out(parameters.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_dead_time(parameters[i])) continue;
    const double below = std::floor(p[i] / tick) * tick;
    out[i] = {std::max(parameters[i].low, below + off_the_jump), below + tick - off_the_jump};
  }
  return out;
}

RunSearched search_run(const RunResiduals& beginning, const RunResiduals& whole,
                       std::span<const Parameter> parameters, const RunFitOptions& options,
                       int threads) {
  constexpr int most_steps = 15;
  const auto tell = [&](const std::string& what, double rms) {
    if (options.progress)
      options.progress(fmt::format("{}: {:.4g} times the noise left, {} + {} simulations", what,
                                   rms, beginning.simulations(), whole.simulations()));
  };
  std::vector<double> start;
  for (const Parameter& one : parameters) start.push_back(one.start);
  const auto search_from = [&](std::vector<double> p) {
    scan_numbers(beginning, parameters, threads, p);
    RunSearched found = search_in_cells(beginning, parameters, p, most_steps, threads);
    tell("scanned and searched in the beginning", found.rms);
    for (int round = 0; round < options.rounds && found.rms > only_noise; ++round) {
      if (!try_cells(beginning, parameters, threads, found)) break;
      tell("other dead times", found.rms);
    }
    return found;
  };
  RunSearched best = search_from(start);
  const bool others = std::ranges::any_of(parameters, is_dead_time);
  for (const double times : other_dead_times) {
    if (best.rms < far_above_noise || !others) break;
    tell(fmt::format("begins again with dead times of {:.3g} times those at the start", times),
         best.rms);
    std::vector<double> p = start;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (is_dead_time(parameters[i]))
        p[i] = std::clamp(times * p[i], parameters[i].low, parameters[i].high);
    RunSearched found = search_from(p);
    if (found.rms < best.rms) best = std::move(found);
  }
  best = search_in_cells(whole, parameters, best.p, most_steps, threads);
  tell("searched in all of the run", best.rms);
  settle_cells(whole, parameters, threads, best);
  search_open_cells(whole, parameters, threads, best);
  tell("beside neighbouring dead times", best.rms);
  return best;
}

}  // namespace sinew::identify
