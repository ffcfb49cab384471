#include "sinew/identify/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sinew/identify/plan/design.h"

namespace sinew::identify {

namespace {

constexpr std::size_t fewest_levels = 3, most_levels = 8;
constexpr double worth_it = 0.999;  // of the error: a change that gains less is none

// A set of mounts that is being improved.
class Search {
 public:
  Search(const DesignSpace& space, const Knowledge& begin, const PlanOptions& options,
         std::size_t levels)
      : space_(space), begin_(begin), options_(options) {
    for (const double length : space.lengths()) {
      std::vector<double> pressures = space.even_pressures(length, levels);
      if (pressures.size() < 2) continue;  // hardly pulls there
      const Knowledge own = space.of(length, pressures);
      candidates_.push_back({length, std::move(pressures), own});
    }
  }

  // Adds the candidate that helps most; false where there is none left.
  bool add() {
    const auto best = best_candidate(chosen_);
    if (!best) return false;
    chosen_.push_back(candidates_[*best]);
    return true;
  }

  // Exchanges mounts and pressures as long as that helps.
  void improve() {
    for (int pass = 0; pass < 10; ++pass) {
      const double before = value(chosen_);
      for (std::size_t i = 0; i < chosen_.size(); ++i) exchange_mount(i);
      for (std::size_t i = 0; i < chosen_.size(); ++i) exchange_pressures(i);
      if (value(chosen_) > worth_it * before) return;
    }
  }

  double value() const { return value(chosen_); }

  // The mounts in the order in which each helps most, so that one may stop early.
  std::vector<PlannedMount> ordered() const {
    std::vector<Candidate> left = chosen_;
    Knowledge known = begin_;
    std::vector<PlannedMount> out;
    while (!left.empty()) {
      std::size_t best = 0;
      double least = 0;
      for (std::size_t i = 0; i < left.size(); ++i) {
        const double v = value_of(sum(known, left[i]));
        if (i > 0 && v >= least) continue;
        best = i;
        least = v;
      }
      known += left[best].own;
      PlannedMount mount{.length = left[best].length, .pressures = left[best].pressures};
      mount.time = options_.mount_time + static_cast<double>(mount.readings()) * options_.step_time;
      mount.after = space_.error(known);
      out.push_back(mount);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return out;
  }

 private:
  struct Candidate {
    double length = 0;
    std::vector<double> pressures;
    Knowledge own;
  };

  static Knowledge sum(Knowledge known, const Candidate& more) { return known += more.own; }

  double value_of(const Knowledge& known) const {
    return space_.error(known).of(options_.criterion);
  }

  double value(const std::vector<Candidate>& set) const {
    Knowledge known = begin_;
    for (const Candidate& c : set) known += c.own;
    return value_of(known);
  }

  // Of lengths that are not in the set: the best one to add.
  std::optional<std::size_t> best_candidate(const std::vector<Candidate>& set) const {
    Knowledge known = begin_;
    for (const Candidate& c : set) known += c.own;
    std::optional<std::size_t> best;
    double least = 0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (std::ranges::find(set, candidates_[i].length, &Candidate::length) != set.end()) continue;
      const double v = value_of(sum(known, candidates_[i]));
      if (best && v >= least) continue;
      best = i;
      least = v;
    }
    return best;
  }

  void exchange_mount(std::size_t at) {
    std::vector<Candidate> others = chosen_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
    const auto best = best_candidate(others);
    if (!best) return;
    others.insert(others.begin() + static_cast<std::ptrdiff_t>(at), candidates_[*best]);
    if (value(others) < worth_it * value(chosen_)) chosen_ = others;
  }

  // Pressures so near each other would say little of how force goes with pressure, were the law
  // another one.
  static bool are_spread(const std::vector<double>& pressures, double range) {
    const double least = 0.49 * range / static_cast<double>(pressures.size() - 1);
    for (std::size_t i = 1; i < pressures.size(); ++i)
      if (pressures[i] - pressures[i - 1] < least) return false;
    return true;
  }

  // Each pressure of a mount for each that is not among them.
  void exchange_pressures(std::size_t at) {
    const std::vector<double> all =
        space_.even_pressures(chosen_[at].length, space_.pressures().size());
    for (std::size_t k = 0; k < chosen_[at].pressures.size(); ++k)
      for (const double p : all) {
        std::vector<double> pressures = chosen_[at].pressures;
        if (std::ranges::find(pressures, p) != pressures.end()) continue;
        pressures[k] = p;
        std::ranges::sort(pressures);
        if (!are_spread(pressures, all.back() - all.front())) continue;
        std::vector<Candidate> set = chosen_;
        set[at] = {set[at].length, pressures, space_.of(set[at].length, pressures)};
        if (value(set) < worth_it * value(chosen_)) chosen_ = set;
      }
  }

  const DesignSpace& space_;
  const Knowledge& begin_;
  const PlanOptions& options_;
  std::vector<Candidate> candidates_, chosen_;
};

// The mounts that reach the error with that many pressures each.
std::vector<PlannedMount> mounts_with(const DesignSpace& space, const Knowledge& begin,
                                      const PlanOptions& options, std::size_t levels,
                                      std::size_t fewest) {
  Search search(space, begin, options, levels);
  const auto most = static_cast<std::size_t>(options.most);
  std::size_t count = 0;
  while (count < most && (count < fewest || search.value() > options.error) && search.add()) {
    ++count;
    if (count >= fewest) search.improve();
  }
  return search.ordered();
}

bool is_better(const MeasurementPlan& plan, const MeasurementPlan& than,
               const PlanOptions& options) {
  if (plan.reached != than.reached) return plan.reached;
  if (plan.reached) return plan.time() < than.time();
  return plan.after().of(options.criterion) < worth_it * than.after().of(options.criterion);
}

}  // namespace

double MeasurementPlan::time() const {
  double out = 0;
  for (const PlannedMount& m : mounts) out += m.time;
  return out;
}

std::size_t MeasurementPlan::readings() const {
  std::size_t out = 0;
  for (const PlannedMount& m : mounts) out += m.readings();
  return out;
}

PlanRegion region_of(const ExpectedMuscle& muscle) {
  const double longest = muscle.scales.rest_length, free = free_length(muscle);
  const double top = muscle.scales.top_pressure;
  return {.shortest = free + 0.1 * (longest - free),
          .longest = longest,
          .lowest = top / 6,
          .highest = top};
}

std::vector<MeasuredMount> mounts_of(std::span<const StaticPoint> points) {
  std::vector<MeasuredMount> out;
  std::vector<double> lengths;
  for (const StaticPoint& p : points) lengths.push_back(p.length);
  if (lengths.empty()) return out;
  const std::vector<int> group =
      mount_groups(lengths, 5e-4, widest_mount * *std::ranges::max_element(lengths));
  out.resize(static_cast<std::size_t>(*std::ranges::max_element(group)) + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    MeasuredMount& mount = out[static_cast<std::size_t>(group[i])];
    mount.length += points[i].length;
    mount.points.push_back(points[i]);
  }
  for (MeasuredMount& mount : out) mount.length /= static_cast<double>(mount.points.size());
  return out;
}

MeasurementPlan plan_measurements(const ExpectedMuscle& muscle, const PlanRegion& region,
                                  const PlanOptions& options,
                                  std::span<const MeasuredMount> measured) {
  const DesignSpace space(muscle, region, options);
  Knowledge begin = space.before();
  for (const MeasuredMount& mount : measured) begin += space.of(mount);
  MeasurementPlan best{.region = region, .before = space.error(begin)};
  best.reached = best.before.of(options.criterion) <= options.error &&
                 measured.size() >= static_cast<std::size_t>(options.fewest);
  if (best.reached) return best;
  const auto fewest =
      std::max<std::ptrdiff_t>(1, options.fewest - static_cast<std::ptrdiff_t>(measured.size()));
  const MeasurementPlan none = best;
  for (std::size_t levels = fewest_levels; levels <= most_levels; ++levels) {
    MeasurementPlan plan = none;
    plan.mounts = mounts_with(space, begin, options, levels, static_cast<std::size_t>(fewest));
    plan.reached = plan.after().of(options.criterion) <= options.error;
    if (best.mounts.empty() || is_better(plan, best, options)) best = std::move(plan);
  }
  return best;
}

}  // namespace sinew::identify
