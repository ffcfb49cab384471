#include "sinew/tune/optimizer/tuning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "sinew/config/changes.h"
#include "sinew/config/compose.h"
#include "sinew/config/node.h"
#include "sinew/config/reader.h"
#include "sinew/host/module.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/tune/optimizer/tuning.fields.h"
#include "sinew/units/quantity.h"
#include "sinew/units/shell.h"

namespace sinew::tune {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Cost of an infeasible candidate: far above all goals, and small enough to distinguish violations.
constexpr double infeasible = 1e12;

bool upper(Condition::Is is) { return is == Condition::Is::below || is == Condition::Is::at_most; }

bool holds(const Limit& limit, double value) {
  switch (limit.is) {
    case Condition::Is::below:
      return value < limit.limit;
    case Condition::Is::at_most:
      return value <= limit.limit;
    case Condition::Is::above:
      return value > limit.limit;
    case Condition::Is::at_least:
      return value >= limit.limit;
  }
  return false;
}

double violation(const Limit& limit, double value) {
  if (holds(limit, value)) return 0;
  const double scale = limit.limit != 0 ? std::fabs(limit.limit) : 1;
  return std::clamp(std::fabs(value - limit.limit) / scale, 1e-9, without_figures);
}

double violation(const Goals& goals, const Figures& run) {
  if (!run.ok) return without_figures * static_cast<double>(goals.limits.size() + 1);
  double out = 0;
  for (std::size_t i = 0; i < goals.limits.size(); ++i)
    out += violation(goals.limits[i], run.limits[i]);
  return out;
}

// Returns the worse of two values, by the goal's direction, ignoring NaN.
double worse(double a, double b, bool more_is_better) {
  if (std::isnan(a)) return b;
  return more_is_better ? std::min(a, b) : std::max(a, b);
}

double goal_over(const Goals& goals, std::size_t i, std::span<const Figures> runs) {
  double sum = 0, weight = 0, worst = nan;
  for (const Figures& run : runs) {
    if (!run.ok) continue;
    sum += run.weight * run.goals[i];
    weight += run.weight;
    worst = worse(worst, run.goals[i], goals.goals[i].maximize);
  }
  if (weight == 0) return nan;
  return goals.over == Goals::Over::mean ? sum / weight : worst;
}

double worst_of(const Limit& limit, std::size_t i, std::span<const Figures> runs) {
  double out = nan;
  for (const Figures& run : runs)
    if (run.ok) out = worse(out, run.limits[i], !upper(limit.is));
  return out;
}

// A run's violation and weight. mean_up_to() returns the mean of the smallest violations, up
// to that share of the weights.
struct Weighed {
  double violation = 0, weight = 0;
};
double mean_up_to(double share, std::vector<Weighed> runs) {
  std::ranges::stable_sort(runs, {}, &Weighed::violation);
  double left = 0, sum = 0;
  for (const Weighed& run : runs) left += run.weight;
  left *= share;
  const double all = left;
  // A rest such as that of a share of 0.95 after nineteen of twenty runs is a rounding error.
  for (const Weighed& run : runs) {
    if (left <= 1e-9 * all) break;
    sum += run.violation * std::min(left, run.weight);
    left -= run.weight;
  }
  return sum / all;
}

double cost(const Goal& goal, double value) { return goal.maximize ? -value : value; }

}  // namespace

CandidateEvaluation evaluate(const Goals& goals, std::span<const Figures> runs) {
  CandidateEvaluation out;
  for (std::size_t i = 0; i < goals.goals.size(); ++i)
    out.goals.push_back(goal_over(goals, i, runs));
  for (std::size_t i = 0; i < goals.limits.size(); ++i)
    out.limits.push_back(worst_of(goals.limits[i], i, runs));
  std::vector<Weighed> weighed;
  double all = 0, good = 0;
  for (const Figures& run : runs) {
    weighed.push_back({violation(goals, run), run.weight});
    all += run.weight;
    if (weighed.back().violation == 0) good += run.weight;
  }
  out.holds = good / all;
  out.violation = mean_up_to(goals.hold, std::move(weighed));
  return out;
}

std::vector<double> costs(const Goals& goals, const CandidateEvaluation& evaluation) {
  std::vector<double> out;
  for (std::size_t i = 0; i < goals.goals.size(); ++i)
    out.push_back(evaluation.feasible() ? std::clamp(cost(goals.goals[i], evaluation.goals[i]),
                                                     -0.5 * infeasible, 0.5 * infeasible)
                                        : infeasible * (1 + evaluation.violation));
  return out;
}

bool dominates(const Goals& goals, const CandidateEvaluation& a, const CandidateEvaluation& b) {
  if (!a.feasible() || !b.feasible()) return a.violation < b.violation;
  bool better = false;
  for (std::size_t i = 0; i < goals.goals.size(); ++i) {
    const double of_a = cost(goals.goals[i], a.goals[i]), of_b = cost(goals.goals[i], b.goals[i]);
    if (of_a > of_b) return false;
    better = better || of_a < of_b;
  }
  return better;
}

std::vector<std::size_t> front(const Goals& goals,
                               std::span<const CandidateEvaluation> evaluation) {
  const auto before = [&](std::size_t a, std::size_t b) {
    for (std::size_t i = 0; i < goals.goals.size(); ++i) {
      const double of_a = cost(goals.goals[i], evaluation[a].goals[i]);
      const double of_b = cost(goals.goals[i], evaluation[b].goals[i]);
      if (of_a != of_b) return of_a < of_b;
    }
    return a < b;
  };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < evaluation.size(); ++i)
    if (evaluation[i].feasible()) order.push_back(i);
  std::ranges::sort(order, before);
  // A later candidate in this order cannot dominate an earlier one.
  std::vector<std::size_t> out;
  for (const std::size_t i : order) {
    const bool beaten = std::ranges::any_of(out, [&](std::size_t j) {
      return dominates(goals, evaluation[j], evaluation[i]) ||
             evaluation[j].goals == evaluation[i].goals;
    });
    if (!beaten) out.push_back(i);
  }
  return out;
}

namespace {

const SinewMethods* methods() {
  void* module = host::open_module("sinew_pagmo.so");
  if (!module)
    throw std::runtime_error(
        "this program was built without pagmo, which tuning needs; try: apt-get install "
        "libpagmo-dev, then cmake --preset release && cmake --build --preset all");
  const auto get =
      reinterpret_cast<const SinewMethods* (*)()>(host::function_of(module, "sinew_methods_1"));
  if (!get)
    throw std::runtime_error(
        "sinew_pagmo.so is of another version of Sinew; build and install both again");
  return get();
}

}  // namespace

OptimizerMethod::OptimizerMethod(const MethodParameters& parameters)
    : parameters_(parameters), methods_(methods()), method_(nullptr, methods_->end) {
  method_.reset(methods_->make(&parameters));
  if (!method_) throw std::runtime_error("pagmo refuses this method");
}

void OptimizerMethod::check(bool success) const {
  if (!success)
    throw std::runtime_error(std::string("pagmo: ") + methods_->error_text(method_.get()));
}

void OptimizerMethod::begin(const std::vector<double>& points, const std::vector<double>& costs) {
  check(methods_->begin(method_.get(), points.data(), costs.data()));
}

std::vector<double> OptimizerMethod::ask() {
  std::vector<double> out(parameters_.population * parameters_.dimensions);
  std::size_t count = 0;
  check(methods_->ask(method_.get(), out.data(), &count));
  out.resize(count * parameters_.dimensions);
  return out;
}

void OptimizerMethod::tell(const std::vector<double>& costs) {
  check(methods_->tell(method_.get(), costs.data()));
}

namespace {

// Returns the place of the key, the file alone if it lacks the key, and no place if the tuning was
// not read from a file.
config::Location where(const TuningFile& file, const char* key) {
  const config::Origin* origin = config::find_origin(file.origins, key);
  if (origin && origin->where.line > 0) return origin->where;
  const config::Origin* title = config::find_origin(file.origins, "title");
  return {title ? title->where.file : "", 0, 0};
}

[[noreturn]] void refuse(const TuningFile& file, const char* key, std::string found,
                         std::string expected, std::string try_this = "") {
  config::fail(where(file, key), key, std::move(found), std::move(expected), std::move(try_this));
}

void add_goals(const TuningFile& file, const std::vector<std::string>& texts, const char* key,
               bool maximize, Goals& out) {
  for (const std::string& text : texts)
    for (Figure& figure : parse_figures(text, place_of(file.places, key, text))) {
      for (const Goal& goal : out.goals)
        if (goal.figure.key == figure.key)
          refuse(file, key, figure.key + " twice", "each figure as one goal");
      out.goals.push_back({std::move(figure), maximize});
    }
}

// Parses "key < 5 deg"; the figure is shown in degrees.
Limit limit_of(const TuningFile& file, const std::string& text) {
  Condition condition = parse_condition(text, place_of(file.places, "where", text));
  const std::string si = analysis::unit_of_key(condition.key);
  const std::size_t number = text.find_first_of("0123456789.", text.find_first_of("<>"));
  const std::size_t end = text.find_first_not_of("0123456789.eE+-", number);
  const std::string unit = end == text.npos ? "" : std::string(trimmed(text.substr(end)));
  Limit out{.figure = {condition.key, unit.empty() ? si : unit},
            .is = condition.is,
            .limit = condition.limit,
            .text = text,
            .si = condition.limit};
  out.figure.setting = std::move(condition.setting);
  if (out.figure.unit != si) out.limit = units::convert(condition.limit, si, out.figure.unit);
  return out;
}

Goals goals_of(const TuningFile& file) {
  Goals out{.goals = {}, .limits = {}, .over = file.over, .hold = file.hold};
  add_goals(file, file.maximize, "maximize", true, out);
  add_goals(file, file.minimize, "minimize", false, out);
  if (out.goals.empty())
    refuse(file, "maximize", "no goal", "a key of summary.json, here or in minimize",
           "maximize = [\"trolley.mean_speed_m_per_s [in/s]\"]");
  for (const std::string& text : file.where) out.limits.push_back(limit_of(file, text));
  return out;
}

// Refuses limits of one figure that exclude every value.
void refuse_contradictions(const TuningFile& file, const std::vector<Limit>& limits) {
  const auto upper = [](const Limit& l) {
    return l.is == Condition::Is::below || l.is == Condition::Is::at_most;
  };
  for (const Limit& low : limits)
    for (const Limit& high : limits) {
      if (low.figure.key != high.figure.key) continue;
      if (upper(low) || !upper(high)) continue;
      const bool open = low.is == Condition::Is::above || high.is == Condition::Is::below;
      if (low.si > high.si || (open && low.si == high.si))
        refuse(file, "where", fmt::format("\"{}\" and \"{}\"", low.text, high.text),
               "limits that a number can keep together");
    }
}

MethodParameters method_of(const TuningFile& file, const Tuning& tuning) {
  using Method = TuningFile::Method;
  const std::size_t goals = tuning.goals.goals.size();
  const bool several =
      file.method == Method::nsga2 || (file.method == Method::automatic && goals > 1);
  if (!several && goals > 1)
    refuse(file, "method", "\"cmaes\" with several goals", "\"nsga2\", or one goal and limits");
  if (several && goals == 1)
    refuse(file, "method", "\"nsga2\" with one goal", "\"cmaes\", or several goals");
  // At least the number of runs that two threads execute in lanes.
  const auto usual = static_cast<std::size_t>(4 + 3 * std::log(tuning.tuned));
  std::size_t population = std::max<std::size_t>(16, (usual + 3) / 4 * 4);
  if (several) population = 48;
  if (file.population > 0) population = static_cast<std::size_t>(file.population);
  if (population < 5) refuse(file, "population", std::to_string(population), "5 or more");
  if (several && population % 4 != 0)
    refuse(file, "population", std::to_string(population), "a multiple of 4, for nsga2");
  return {.kind = several ? MethodKind::nsga2 : MethodKind::cmaes,
          .dimensions = tuning.tuned,
          .costs = goals,
          .population = population,
          .seed = static_cast<std::uint64_t>(file.tuner_seed),
          .step = file.step};
}

void refuse_twice(const TuningFile& file, const Sample& sample) {
  for (std::size_t i = 0; i < sample.ranges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sample.ranges[i].axis.key == sample.ranges[j].axis.key)
        refuse(file, "tune", sample.ranges[i].axis.key + " twice", "each key once");
}

void add_ranges(const TuningFile& file, Tuning& out) {
  Sample sample{.ranges = {}, .given_later = true};
  for (const std::string& text : file.tune)
    sample.ranges.push_back(parse_range(text, place_of(file.places, "tune", text)));
  out.tuned = sample.ranges.size();
  if (out.tuned == 0)
    refuse(file, "tune", "none", "what is tuned", "tune = [\"KEY=from:to unit\"]");
  for (const std::string& text : file.spread)
    sample.ranges.push_back(parse_range(text, place_of(file.places, "spread", text)));
  refuse_twice(file, sample);
  const std::size_t drawn = sample.ranges.size() - out.tuned;
  if ((drawn > 0) != (file.draws > 0))
    refuse(file, drawn > 0 ? "spread" : "draws", drawn > 0 ? "no draws" : "no spread",
           "both, or neither of them", "draws = 8, and spread = [\"KEY=from:to unit\"]");
  if (drawn > 0) {
    out.draws = static_cast<std::size_t>(file.draws);
    out.drawn = sobol_shares(drawn, out.draws, static_cast<std::uint64_t>(file.spread_seed));
  }
  out.runs.sample = std::move(sample);
}

void refuse_cases_twice(const TuningFile& file) {
  for (std::size_t i = 0; i < file.cases.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (file.cases[i].name == file.cases[j].name)
        refuse(file, "case", config::in_quotes(file.cases[i].name) + " twice",
               "a name of its own for each case");
}

void add_figure(const Figure& figure, std::vector<Figure>& out) {
  const auto same = [&](const Figure& f) { return f.key == figure.key && f.unit == figure.unit; };
  if (std::ranges::none_of(out, same)) out.push_back(figure);
}

void add_report(const TuningFile& file, Tuning& out) {
  std::vector<Figure>& report = out.runs.report;
  for (const Goal& goal : out.goals.goals) add_figure(goal.figure, report);
  for (const Limit& limit : out.goals.limits) add_figure(limit.figure, report);
  for (const std::string& text : file.report)
    for (const Figure& figure : parse_figures(text, place_of(file.places, "report", text)))
      add_figure(figure, report);
}

// Returns the number of an element of a list, if it is written in the range's own unit.
std::optional<double> element_of(const Range& range, const config::Node& root) {
  const config::Node* node = config::value_at(root, range.axis.key);
  if (!node) return std::nullopt;
  const std::string text = config::written(*node);
  const auto [number, unit, error] = units::split_number(text);
  if (error != std::errc{} || unit != range.axis.unit) return std::nullopt;
  return number;
}

std::optional<double> number_of(const Range& range, const config::Origins& origins,
                                double atmosphere) {
  const config::Origin* origin = config::find_origin(origins, range.axis.key);
  if (!origin) return std::nullopt;
  const std::string unit = origin->unit.empty() ? "1" : origin->unit;
  const units::Parsed parsed = units::parse_quantity(origin->text, unit, atmosphere);
  if (parsed.mistake) return std::nullopt;
  return range.axis.unit.empty() ? parsed.si
                                 : units::convert(parsed.si, unit, range.axis.unit, atmosphere);
}

// Sets the atmospheric pressure, and the shares of the experiment's values in the tuned ranges; the
// middle if a value is not a number within its range.
void add_start(Tuning& tuning) {
  const config::Node root = config::compose(tuning.runs.experiment, tuning.runs.sets);
  const experiment::Experiment e = run::buildable(root, tuning.runs.experiment);
  tuning.atmosphere = e.air.atmosphere;
  for (std::size_t i = 0; i < tuning.tuned; ++i) {
    const Range& range = tuning.runs.sample->ranges[i];
    const std::optional<double> number = range.axis.key.ends_with(']')
                                             ? element_of(range, root)
                                             : number_of(range, e.origins, e.air.atmosphere);
    const double share = number ? range.share_of(*number) : 0.5;
    tuning.start.push_back(share >= 0 && share <= 1 ? std::min(share, below_one) : 0.5);
  }
}

}  // namespace

TuningFile load_tuning_file(const std::string& path) {
  const config::Node root = config::compose(path);
  if (const std::string_view kind = config::format_kind(root); kind != "tuning")
    config::fail({path, 0, 0}, "format", config::in_quotes(kind),
                 config::in_quotes(config::newest_format("tuning")),
                 kind == "plan" ? "sinew sweep " + units::shell_word(path) : "");
  TuningFile out;
  config::Reader reader(root);
  std::string format;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  fields(reader, out);
  reader.finish();
  out.origins = reader.origins();
  out.places = places_of(root);
  const auto present = [](std::vector<std::string>& texts) {
    for (std::string& text : texts) text = config::with_present_key(text);
  };
  for (const auto list : {&TuningFile::set, &TuningFile::tune, &TuningFile::spread})
    present(out.*list);
  for (Case& one : out.cases) present(one.sets);
  const auto find_file = [&](const std::string& key, std::string& file) {
    if (file.empty()) return;
    const config::Location where = config::find_origin(out.origins, key)->where;
    file = config::file_of(config::make_text("", file, where), key);
  };
  find_file("experiment", out.experiment);
  for (std::size_t i = 0; i < out.cases.size(); ++i)
    find_file(fmt::format("case[{}].experiment", i), out.cases[i].experiment);
  return out;
}

Tuning tuning_of(const std::string& path, const TuningFile& file) {
  Tuning out{.file = path, .title = file.title, .goals = goals_of(file)};
  refuse_contradictions(file, out.goals.limits);
  refuse_cases_twice(file);
  out.runs = {.experiment = file.experiment, .sets = file.set, .cases = file.cases};
  out.runs.places = file.places;
  out.runs.allow_unreachable = file.allow_unreachable;
  if (file.seeds > 0)
    out.runs.axes.push_back(
        seeds(file.seeds, place_of(file.places, "seeds", std::to_string(file.seeds))));
  add_ranges(file, out);
  add_report(file, out);
  out.method = method_of(file, out);
  out.generations = static_cast<std::size_t>(file.generations);
  out.runs.sample->points = out.generations * out.method.population * out.draws;

  check(out.runs);
  add_start(out);
  return out;
}

Tuning load_tuning(const std::string& path, const std::vector<std::string>& sets, int generations) {
  TuningFile file = load_tuning_file(path);
  file.set.insert(file.set.end(), sets.begin(), sets.end());
  if (generations > 0) file.generations = generations;
  return tuning_of(path, file);
}

}  // namespace sinew::tune
