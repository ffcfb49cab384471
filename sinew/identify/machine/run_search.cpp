#include "sinew/identify/machine/run_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "sinew/gas/delay.h"
#include "sinew/host/side_by_side.h"

namespace sinew::identify {

// --- residuals ---

using experiment::Experiment;

namespace {

std::vector<std::string> keys_of(std::span<const Parameter> parameters) {
  std::vector<std::string> out;
  for (const Parameter& one : parameters) out.push_back(one.name);
  return out;
}

}  // namespace

RunResiduals::RunResiduals(const Experiment& machine, const DrivenRun& run,
                           std::span<const Parameter> parameters, const RunFitOptions& options,
                           double until)
    : machine_(machine),
      numbers_(machine, keys_of(parameters)),
      run_(run),
      parameters_(parameters),
      options_(options),
      until_(until) {
  std::size_t sample = 0;
  for (const RunChannel& c : run.channels())
    for (const double value : c.value) {
      reading_.push_back(value);
      noise_.push_back(c.noise);
      bottom_.push_back(c.bottom);
      top_.push_back(c.top);
      const double t = run.time(sample);
      if (t >= options.from && t <= until_) fitted_.push_back(sample);
      ++sample;
    }
}

Experiment RunResiduals::machine(std::span<const double> p) const {
  Experiment out = machine_;
  (void)numbers_.set_unbounded(out, p);
  return out;
}

bool RunResiduals::operator()(std::span<const double> p, std::span<double> r) const {
  ++simulations_;
  std::vector<double> mean(run_.samples());
  Experiment tried = machine_;
  if (!numbers_.set_unbounded(tried, p) || !run_.predict(tried, mean, until_)) return false;
  std::size_t k = 0;
  for (const std::size_t s : fitted_) r[k++] = (mean[s] - reading_[s]) / noise_[s];
  for (const RunPrior& prior : options_.priors) {
    const auto i = static_cast<std::size_t>(
        std::ranges::find(parameters_, prior.key, &Parameter::name) - parameters_.begin());
    r[k++] = (p[i] - prior.value) / prior.standard_deviation;
  }
  return true;
}

bool RunResiduals::is_cut(std::size_t k, double residual) const {
  constexpr double near = 2;  // in units of the noise
  if (k >= fitted_.size()) return false;
  const std::size_t s = fitted_[k];
  const double mean = reading_[s] + noise_[s] * residual;
  return mean < bottom_[s] + near * noise_[s] || mean > top_[s] - near * noise_[s];
}

double RunResiduals::cost(std::span<const double> p) const {
  std::vector<double> r(count());
  if (!(*this)(p, r)) return unbounded;
  double sum = 0;
  for (const double x : r) sum += 0.5 * x * x;
  return std::isfinite(sum) ? sum : unbounded;
}

namespace {

constexpr double only_noise = 1.05;  // rms in noises, above which cells are changed
constexpr double tick = signals::tick_seconds;

// If the residuals are far above the noise, the search is in a wrong minimum: it restarts with the
// dead times that fit best while all other parameters are as at the start, then with all dead times
// shorter, or longer.
constexpr double other_dead_times[] = {0.8, 1.2, 0.6, 1.4};

// Returns trial values of a parameter, in addition to its current value.
std::vector<double> places_of(const Parameter& p, double at) {
  std::vector<double> out;
  if (at > 0 && p.low >= 0)
    for (const double times : {0.5, 0.75, 1.3, 2.0}) out.push_back(at * times);
  else
    for (const double step : {-1.0, -0.3, 0.3, 1.0}) out.push_back(at + step * p.scale);
  std::erase_if(out, [&](double x) { return x < p.low || x > p.high; });
  return out;
}

using TrialPoints = std::vector<std::vector<double>>;

// Moves each parameter except dead times, one by one, to the best of a few trial values.
void scan_numbers(const RunResiduals& residuals, std::span<const Parameter> parameters, int threads,
                  std::vector<double>& p) {
  double best = residuals.cost(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (is_dead_time(parameters[i])) continue;
    TrialPoints tried;
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

// Returns the number of whole ticks in a dead time. A dead time of whole ticks loses the pulses of
// its length, as a longer one does.
double ticks_in(double dead_time) {
  return std::floor((dead_time + gas::Shutter::simultaneous) / tick);
}

// Returns the other delay of the same valve; the number of parameters if it is not searched.
std::size_t partner_of(std::span<const Parameter> parameters, std::size_t i) {
  const auto valve = [](const std::string& key) { return key.substr(0, key.rfind('.')); };
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (k != i && is_dead_time(parameters[k]) &&
        valve(parameters[k].name) == valve(parameters[i].name))
      return k;
  return parameters.size();
}

// Returns trial points in the cells up to some ticks away, for one valve after the other. What a
// run determines best of a valve is how much longer it is open than its coil is on: so the
// difference of its two delays is kept where possible.
TrialPoints cells_around(std::span<const Parameter> parameters, const std::vector<double>& p,
                         int ticks) {
  constexpr double inset = 0.02 * tick;
  const auto cell = [&](std::size_t i, int by) {
    const double low = (ticks_in(p[i]) + by) * tick;
    return RunCell{low + inset, low + tick - inset};
  };
  TrialPoints out;
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

// Moves the dead times, valve after valve, to the cells that fit best while all else stays.
void scan_dead_times(const RunResiduals& residuals, std::span<const Parameter> parameters,
                     int threads, std::vector<double>& p) {
  constexpr int rounds = 4, far = 3;
  double best = residuals.cost(p);
  for (int round = 0; round < rounds; ++round) {
    const TrialPoints tried = cells_around(parameters, p, far);
    std::vector<double> cost(tried.size());
    host::side_by_side(
        tried.size(), [&](std::size_t k) { cost[k] = residuals.cost(tried[k]); }, nullptr, threads);
    const auto k = static_cast<std::size_t>(std::ranges::min_element(cost) - cost.begin());
    if (k == cost.size() || !(cost[k] < best)) return;
    best = cost[k];
    p = tried[k];
  }
}

// Tries the best few of these cells with a few steps each; returns false if none is better than
// `best`.
bool try_cells(const RunResiduals& residuals, std::span<const Parameter> parameters, int threads,
               RunSearched& best) {
  constexpr std::size_t worth_it = 6;
  constexpr int a_few_steps = 4, far = 3;
  TrialPoints tried = cells_around(parameters, best.p, far);
  if (tried.empty()) return false;
  const std::vector<double> cost = linearised_costs(residuals, parameters, best, tried, threads);
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

// Half the sum of squares by which a neighbouring cell must be worse to be excluded: four standard
// deviations.
constexpr double ruled_out = 8;

double half_square(const RunResiduals& residuals, const RunSearched& at) {
  return 0.5 * at.rms * at.rms * static_cast<double>(residuals.count());
}

// Moves to a neighbouring cell while that is better.
void settle_cells(const RunResiduals& residuals, std::span<const Parameter> parameters, int threads,
                  RunSearched& best) {
  constexpr int few_moves = 3, moves = 20, steps = 6;
  for (int move = 0; move < (best.rms > only_noise ? moves : few_moves); ++move) {
    const TrialPoints tried = cells_around(parameters, best.p, 1);
    if (tried.empty()) return;
    const std::vector<double> cost = linearised_costs(residuals, parameters, best, tried, threads);
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

// Returns the points in neighbouring cells that the run does not exclude even after all parameters
// are adjusted, the likely ones first.
TrialPoints open_places(const RunResiduals& residuals, std::span<const Parameter> parameters,
                        int threads, const RunSearched& at, double least) {
  TrialPoints tried = cells_around(parameters, at.p, 1), out;
  if (tried.empty()) return out;
  const std::vector<double> cost = linearised_costs(residuals, parameters, at, tried, threads);
  std::vector<std::size_t> order(tried.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return cost[k]; });
  for (const std::size_t k : order)
    if (cost[k] < least + ruled_out) out.push_back(tried[k]);
  return out;
}

// Searches the neighbouring cells that the run does not exclude, and those around them; the best
// becomes `best`. Cells beyond the maximum number widen their neighbours.
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

// Replaces a solution that fits worse than the start by the one next to the start, or by the start
// itself.
void keep_start(const RunResiduals& residuals, std::span<const Parameter> parameters,
                const std::vector<double>& start, int threads, RunSearched& best) {
  constexpr int steps = 15;
  const double rms = std::sqrt(2 * residuals.cost(start) / static_cast<double>(residuals.count()));
  if (!(rms < best.rms)) return;
  best = search_in_cells(residuals, parameters, start, steps, threads);
  if (rms < best.rms) best = {start, run_cells(parameters, start), rms};
}

}  // namespace

bool is_dead_time(const Parameter& number) { return number.name.ends_with("ing_delay"); }

std::vector<RunCell> run_cells(std::span<const Parameter> parameters, std::span<const double> p) {
  std::vector<RunCell> out(parameters.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_dead_time(parameters[i])) continue;
    const double below = ticks_in(p[i]) * tick;
    out[i] = {std::max(parameters[i].low, below + jump_clearance), below + tick - jump_clearance};
  }
  return out;
}

RunSearched search_run(const RunResiduals& beginning, const RunResiduals& whole,
                       std::span<const Parameter> parameters, const RunFitOptions& options,
                       int threads) {
  constexpr int most_steps = 15;
  const auto report = [&](const std::string& what, double rms) {
    if (options.progress)
      options.progress(fmt::format("{}: residuals of {:.4g} times the noise, {} + {} simulations",
                                   what, rms, beginning.simulations(), whole.simulations()));
  };
  const std::vector<double> start = starts_of(parameters);
  const auto search_from = [&](std::vector<double> p) {
    scan_numbers(beginning, parameters, threads, p);
    RunSearched found = search_in_cells(beginning, parameters, p, most_steps, threads);
    report("scanned and searched in the beginning", found.rms);
    for (int round = 0; round < options.rounds && found.rms > only_noise; ++round) {
      if (!try_cells(beginning, parameters, threads, found)) break;
      report("other dead times", found.rms);
    }
    return found;
  };
  RunSearched best = search_from(start);
  const auto search_again = [&](std::vector<double> p) {
    RunSearched found = search_from(std::move(p));
    if (found.rms < best.rms) best = std::move(found);
  };
  const bool others = std::ranges::any_of(parameters, is_dead_time);
  if (best.rms > far_above_noise && others) {
    std::vector<double> p = start;
    scan_dead_times(beginning, parameters, threads, p);
    report("begins again with the dead times that fit best", best.rms);
    search_again(std::move(p));
  }
  for (const double times : other_dead_times) {
    if (best.rms < far_above_noise || !others) break;
    report(fmt::format("begins again with dead times of {:.3g} times those at the start", times),
           best.rms);
    std::vector<double> p = start;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (is_dead_time(parameters[i]))
        p[i] = std::clamp(times * p[i], parameters[i].low, parameters[i].high);
    search_again(std::move(p));
  }
  best = search_in_cells(whole, parameters, best.p, most_steps, threads);
  report("searched in all of the run", best.rms);
  keep_start(whole, parameters, start, threads, best);
  settle_cells(whole, parameters, threads, best);
  search_open_cells(whole, parameters, threads, best);
  report("neighbouring dead times", best.rms);
  return best;
}

// --- steps ---

namespace {

// Adds `times` the column to a vector.
void add(std::span<const double> column, double times, std::vector<double>& to) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += times * column[k];
}

// Returns the point after a step from p with this damping, within the bounds.
std::vector<double> stepped(const RunTangent& t, std::span<const Parameter> parameters,
                            std::span<const RunCell> cells, const std::vector<double>& p,
                            double mu) {
  const std::size_t n = p.size();
  const std::vector<double> gradient = transposed_product(t.j, t.r);
  std::vector<std::size_t> free;
  const auto low = [&](std::size_t i) { return std::max(parameters[i].low, cells[i].low); };
  const auto high = [&](std::size_t i) { return std::min(parameters[i].high, cells[i].high); };
  for (std::size_t i = 0; i < n; ++i) {
    const double g = gradient[i];
    const bool held = (p[i] <= low(i) && g > 0) || (p[i] >= high(i) && g < 0);
    if (!held) free.push_back(i);
  }
  std::vector<double> q = p;
  // A parameter that meets a bound is held there, and the others continue without it.
  while (!free.empty()) {
    const Matrix j = t.j.chosen(free);
    Matrix a = transposed_product(j, j);
    double least = 0;
    for (std::size_t i = 0; i < a.rows(); ++i) least = std::max(least, 1e-12 * a(i, i));
    for (std::size_t i = 0; i < a.rows(); ++i) a(i, i) += mu * a(i, i) + least + 1e-300;
    std::vector<double> rest = t.r;  // with parameters that are held at bounds
    for (std::size_t i = 0; i < n; ++i)
      if (std::ranges::find(free, i) == free.end())
        add(t.j.column(i), (q[i] - p[i]) / parameters[i].scale, rest);
    const std::vector<double> s = solved(a, transposed_product(j, rest));  // downhill is -s
    std::vector<std::size_t> inside;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const std::size_t i = free[k];
      const double to = p[i] - s[k] * parameters[i].scale;
      q[i] = std::clamp(to, low(i), high(i));
      if (q[i] == to) inside.push_back(i);
    }
    if (inside.size() == free.size()) break;
    free = inside;
  }
  return q;
}

}  // namespace

bool run_tangent(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 std::span<const RunCell> cells, const std::vector<double>& p, int threads,
                 RunTangent& out, double by) {
  const std::size_t n = parameters.size();
  std::vector<std::vector<double>> moved(n + 1, std::vector<double>(residuals.count()));
  std::vector<char> evaluated(n + 1);
  std::vector<double> step(n);
  host::side_by_side(
      n + 1,
      [&](std::size_t i) {
        std::vector<double> q = p;
        if (i < n) {
          const double high = std::min(parameters[i].high, cells[i].high);
          step[i] = by * parameters[i].scale;
          if (p[i] + step[i] > high) step[i] = -step[i];
          q[i] += step[i];
        }
        evaluated[i] = residuals(q, moved[i]) ? 1 : 0;
      },
      nullptr, threads);
  if (!evaluated[n]) return false;
  out.r = moved[n];
  out.j = Matrix(residuals.count(), n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!evaluated[i]) continue;
    const double per_scale = parameters[i].scale / step[i];
    const std::span<double> column = out.j.column(i);
    for (std::size_t k = 0; k < column.size(); ++k)
      column[k] = (moved[i][k] - out.r[k]) * per_scale;
  }
  return true;
}

RunSearched search_in_cells(const RunResiduals& residuals, std::span<const Parameter> parameters,
                            const std::vector<double>& p, int steps, int threads) {
  // Factors on the last damping that helped.
  constexpr std::array<double, 4> dampings = {1e-3, 0.1, 10, 1e3};
  constexpr double nothing = 1e-3;  // share of half the sum of squares, far below the noise
  RunSearched out{p, run_cells(parameters, p), unbounded};
  for (std::size_t i = 0; i < p.size(); ++i)
    out.p[i] = std::clamp(out.p[i], std::max(parameters[i].low, out.cells[i].low),
                          std::min(parameters[i].high, out.cells[i].high));
  double mu = 1e-2, cost = unbounded;
  for (int step = 0; step < steps; ++step) {
    RunTangent t;
    if (!run_tangent(residuals, parameters, out.cells, out.p, threads, t)) break;
    cost = 0.5 * square(t.r);
    std::vector<std::vector<double>> to;
    std::vector<double> there(dampings.size());
    for (const double times : dampings)
      to.push_back(stepped(t, parameters, out.cells, out.p, mu * times));
    host::side_by_side(
        to.size(), [&](std::size_t k) { there[k] = residuals.cost(to[k]); }, nullptr, threads);
    const auto best = static_cast<std::size_t>(std::ranges::min_element(there) - there.begin());
    const double gained = cost - there[best];
    if (gained > 0) out.p = to[best], cost = there[best];
    mu = std::clamp(mu * (gained > 0 ? dampings[best] : 1e4), 1e-8, 1e8);
    if (gained < nothing && (gained >= 0 || mu > 1e4)) break;
  }
  out.rms = std::sqrt(2 * cost / static_cast<double>(residuals.count()));
  return out;
}

std::vector<double> linearised_costs(const RunResiduals& residuals,
                                     std::span<const Parameter> parameters, const RunSearched& at,
                                     const std::vector<std::vector<double>>& places, int threads) {
  std::vector<double> out(places.size(), unbounded);
  RunTangent t;
  if (!run_tangent(residuals, parameters, at.cells, at.p, threads, t)) return out;
  const Matrix basis = triangular(t.j).basis;
  host::side_by_side(
      places.size(),
      [&](std::size_t k) {
        std::vector<double> r(t.r.size());
        if (!residuals(places[k], r)) return;
        out[k] = 0.5 * std::max(0.0, square(r) - square(transposed_product(basis, r)));
      },
      nullptr, threads);
  return out;
}

}  // namespace sinew::identify
