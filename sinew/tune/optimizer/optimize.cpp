#include "sinew/tune/optimizer/optimize.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/units/quantity.h"

namespace sinew::tune {

namespace {

// Reports "generation 3 of 40: best trolley.mean_speed [in/s] = 6.21, 12 of 16 feasible".
class Reporter {
 public:
  Reporter(const Tuning& tuning, const run::Notices& notices)
      : tuning_(tuning), notices_(notices) {}

  void generation(const std::vector<Candidate>& candidates) {
    std::size_t feasible = 0;
    for (const Candidate& c : candidates) {
      feasible += c.evaluation.feasible() ? 1 : 0;
      if (!best_ || dominates(tuning_.goals, c.evaluation, *best_)) best_ = c.evaluation;
    }
    std::string best = fmt::format("violation {:.3g}", best_->violation);
    if (best_->feasible() && tuning_.goals.goals.size() == 1)
      best = fmt::format("{} = {:.6g}", tuning_.goals.goals.front().figure.heading(),
                         best_->goals.front());
    const bool one = best_->feasible() && tuning_.goals.goals.size() > 1;
    notices_.note(fmt::format("generation {} of {}: {}{} of {} feasible",
                              candidates.front().generation + 1, tuning_.generations,
                              one ? "" : "best " + best + ", ", feasible, candidates.size()));
  }

 private:
  const Tuning& tuning_;
  const run::Notices& notices_;
  std::optional<CandidateEvaluation> best_;
};

}  // namespace

Tuned optimize_and_store(const Tuning& tuning, const std::filesystem::path& file,
                         const StoredTuningOptions& options) {
  Results results(file, request_of(tuning));
  results.expect(points(tuning.runs));
  TuneOptions own = options.tune;
  own.runs.known = results.rows();
  // The file of a tuning with more generations is not made smaller.
  std::erase_if(own.runs.known, [&](const Row& row) { return row.point >= points(tuning.runs); });
  if (!own.runs.known.empty())
    options.notices.note(fmt::format("{}: {} of {} runs are there", file.string(),
                                     own.runs.known.size(), points(tuning.runs)));
  std::exception_ptr failure;
  const auto stop = [&] {
    if (options.ask_to_stop) options.ask_to_stop();
  };
  own.runs.done = [&](const Row& row) {
    if (!results.add(row)) stop();
  };
  Reporter reporter(tuning, options.notices);
  own.generation = [&](const std::vector<Candidate>& candidates) {
    if (options.tune.generation) options.tune.generation(candidates);
    reporter.generation(candidates);
    std::vector<CandidateRow> rows;
    for (const Candidate& c : candidates) rows.push_back(row_of(c));
    try {
      results.add_candidates(rows);
    } catch (...) {
      failure = std::current_exception();
      stop();
    }
  };
  Tuned out = optimize(tuning, own);
  results.throw_failure();
  if (failure) std::rethrow_exception(failure);
  return out;
}

namespace {

// Returns the index of a figure's cell in a row.
std::size_t cell_of(const Sweep& runs, const Figure& figure) {
  std::size_t at = headings(runs).size() - 1 - runs.report.size();
  for (const Figure& f : runs.report) {
    if (f.key == figure.key && f.unit == figure.unit) break;
    ++at;
  }
  return at;
}

// The runs of a generation, and the evaluation of its candidates.
class Generation {
 public:
  Generation(const Tuning& tuning, std::size_t number, const std::vector<double>& shares);

  const Sweep& runs() const { return runs_; }
  std::size_t first_point() const { return number_ * tuning_.runs_of_generation(); }
  std::size_t candidates() const { return candidates_; }

  // Throws if a known row does not belong to these candidates.
  std::vector<Candidate> evaluated(const std::vector<Row>& rows) const;

  // Throws if nothing can be evaluated: no run has figures, or none has one of the goals' or
  // limits'.
  void require_figures(const std::vector<Row>& rows) const;

 private:
  std::vector<Value> values(std::size_t candidate) const;
  Figures figures(const Row& row) const;
  void require_own(const Row& row, const std::vector<Value>& values) const;

  const Tuning& tuning_;
  std::size_t number_, candidates_;
  std::vector<double> shares_;  // for the tuned ranges
  Sweep runs_;
  std::vector<std::size_t> goals_, limits_;  // indices of cells
};

Generation::Generation(const Tuning& tuning, std::size_t number, const std::vector<double>& shares)
    : tuning_(tuning),
      number_(number),
      candidates_(shares.size() / tuning.tuned),
      shares_(shares),
      runs_(tuning.runs) {
  Sample& sample = *runs_.sample;
  sample.points = candidates_ * tuning.draws;
  const std::size_t drawn = tuning.drawn.size() / tuning.draws;
  for (double& share : shares_) share = std::clamp(share, 0.0, below_one);
  for (std::size_t c = 0; c < candidates_; ++c)
    for (std::size_t d = 0; d < tuning.draws; ++d) {
      const auto own = shares_.begin() + static_cast<std::ptrdiff_t>(c * tuning.tuned);
      const auto draw = tuning.drawn.begin() + static_cast<std::ptrdiff_t>(d * drawn);
      sample.given.insert(sample.given.end(), own, own + static_cast<std::ptrdiff_t>(tuning.tuned));
      sample.given.insert(sample.given.end(), draw, draw + static_cast<std::ptrdiff_t>(drawn));
    }
  for (const Goal& goal : tuning.goals.goals) goals_.push_back(cell_of(runs_, goal.figure));
  for (const Limit& limit : tuning.goals.limits) limits_.push_back(cell_of(runs_, limit.figure));
}

std::vector<Value> Generation::values(std::size_t candidate) const {
  std::vector<Value> out;
  for (std::size_t i = 0; i < tuning_.tuned; ++i)
    out.push_back(runs_.sample->ranges[i].at(shares_[candidate * tuning_.tuned + i]));
  return out;
}

Figures Generation::figures(const Row& row) const {
  Figures out{.ok = row.ok};
  const auto take = [&](const std::vector<std::size_t>& cells, std::vector<double>& to) {
    for (const std::size_t cell : cells) {
      out.ok = out.ok && !row.cells[cell].empty();
      to.push_back(units::split_number(row.cells[cell]).number);
    }
  };
  take(goals_, out.goals);
  take(limits_, out.limits);
  if (!runs_.cases.empty()) {
    const std::string& name = row.cells[runs_.sample->ranges.size()];
    for (const Case& one : runs_.cases)
      if (one.name == name) out.weight = one.weight;
  }
  return out;
}

void Generation::require_own(const Row& row, const std::vector<Value>& values) const {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (row.cells[i] != values[i].cell)
      throw std::runtime_error(fmt::format(
          "point {} has {} = {}; expected {}, which the method proposes here; try another file: "
          "another version of pagmo, or another kind of computer, wrote this one",
          row.point, runs_.sample->ranges[i].axis.heading(), row.cells[i], values[i].cell));
}

void Generation::require_figures(const std::vector<Row>& rows) const {
  if (std::ranges::none_of(rows, &Row::ok))
    throw std::runtime_error(fmt::format(
        "none of the first generation's {} runs has figures: {}; try ranges around what the "
        "experiment has",
        rows.size(), rows.front().cells.back()));
  const auto require = [&](const Figure& figure, std::size_t cell) {
    if (std::ranges::all_of(rows, [&](const Row& row) { return row.cells[cell].empty(); }))
      config::fail({figure.setting, 0, 0}, "", figure.key, "a figure that the runs have",
                   "another key of a run's summary.json");
  };
  for (std::size_t i = 0; i < goals_.size(); ++i) require(tuning_.goals.goals[i].figure, goals_[i]);
  for (std::size_t i = 0; i < limits_.size(); ++i)
    require(tuning_.goals.limits[i].figure, limits_[i]);
}

std::vector<Candidate> Generation::evaluated(const std::vector<Row>& rows) const {
  const std::size_t each = rows.size() / candidates_;
  std::vector<Candidate> out;
  for (std::size_t c = 0; c < candidates_; ++c) {
    Candidate one{.number = number_ * tuning_.method.population + c,
                  .generation = number_,
                  .values = values(c),
                  .evaluation = {}};
    std::vector<Figures> all;
    for (std::size_t i = c * each; i < (c + 1) * each; ++i) {
      require_own(rows[i], one.values);
      all.push_back(figures(rows[i]));
    }
    one.evaluation = evaluate(tuning_.goals, all);
    out.push_back(std::move(one));
  }
  return out;
}

// Returns the experiment's own values, followed by Sobol's sequence.
std::vector<double> first_generation(const Tuning& tuning) {
  std::vector<double> out = tuning.start;
  const std::vector<double> spread =
      sobol_shares(tuning.tuned, tuning.method.population - 1, tuning.method.seed);
  out.insert(out.end(), spread.begin(), spread.end());
  return out;
}

// Returns the known rows of a generation, with its own numbering of points.
std::vector<Row> known_of(const std::vector<Row>& known, std::size_t first, std::size_t count) {
  const auto begin = std::ranges::lower_bound(known, first, {}, &Row::point);
  const auto end = std::ranges::lower_bound(known, first + count, {}, &Row::point);
  std::vector<Row> out(begin, end);
  for (Row& row : out) row.point -= first;
  return out;
}

class Loop {
 public:
  Loop(const Tuning& tuning, const TuneOptions& options)
      : tuning_(tuning),
        options_(options),
        device_(options.dispatch ? options.runs.device : run::chosen(options.runs.device)),
        method_(tuning.method) {}

  Tuned run() {
    for (std::size_t g = 0; g < tuning_.generations && !out_.stopped; ++g) {
      const std::vector<double> shares = g == 0 ? first_generation(tuning_) : method_.ask();
      if (shares.empty()) {
        out_.converged = true;
        break;
      }
      step(Generation(tuning_, g, shares), shares, g == 0);
    }
    add_best();
    return std::move(out_);
  }

 private:
  void step(const Generation& generation, const std::vector<double>& shares, bool first) {
    const std::vector<Row> rows = rows_of(generation, first);
    if (rows.size() < points(generation.runs())) {
      out_.stopped = true;
      return;
    }
    if (first) generation.require_figures(rows);
    const std::vector<Candidate> evaluated = generation.evaluated(rows);
    std::vector<double> costs_of_all;
    for (const Candidate& c : evaluated) {
      const std::vector<double> own = costs(tuning_.goals, c.evaluation);
      costs_of_all.insert(costs_of_all.end(), own.begin(), own.end());
    }
    if (first)
      method_.begin(shares, costs_of_all);
    else
      method_.tell(costs_of_all);
    if (options_.generation) options_.generation(evaluated);
    out_.candidates.insert(out_.candidates.end(), evaluated.begin(), evaluated.end());
  }

  // Returns the rows of a generation; runs the unknown ones.
  std::vector<Row> rows_of(const Generation& generation, bool first) {
    const std::size_t from = generation.first_point();
    const Sweep& runs = generation.runs();
    Options own = options_.runs;
    own.progress = nullptr;
    own.checked = !first;
    own.device = device_;
    if (!ensembles_) ensembles_ = ensembles_of(runs);
    own.runs = ensembles_;
    own.known = known_of(options_.runs.known, from, points(runs));
    if (options_.runs.progress)
      *options_.runs.progress += static_cast<std::int64_t>(own.known.size());
    if (own.known.size() < points(runs) && options_.dispatch)
      own.dispatch = options_.dispatch(runs);
    own.done = [&](const Row& row) {
      if (options_.runs.progress) ++*options_.runs.progress;
      if (!options_.runs.done) return;
      Row numbered = row;
      numbered.point += from;
      options_.runs.done(numbered);
    };
    std::vector<Row> rows = sweep(runs, own);
    for (Row& row : rows) row.point += from;
    return rows;
  }

  void add_best() {
    std::vector<CandidateEvaluation> evaluated;
    for (const Candidate& c : out_.candidates) evaluated.push_back(c.evaluation);
    out_.best = front(tuning_.goals, evaluated);
  }

  const Tuning& tuning_;
  const TuneOptions& options_;
  const run::Device device_;                   // for all generations
  std::shared_ptr<run::Ensembles> ensembles_;  // shared by all generations
  OptimizerMethod method_;
  Tuned out_;
};

const char* to_text(MethodKind kind) { return kind == MethodKind::cmaes ? "cmaes" : "nsga2"; }

void add_columns(const Tuning& tuning, StudyRequest& out) {
  using Role = Column::Role;
  const std::vector<Range>& ranges = tuning.runs.sample->ranges;
  for (std::size_t i = tuning.tuned; i < ranges.size(); ++i)
    out.columns[i].role = Role::circumstance;
  const auto add = [&](const Figure& figure, Role role) {
    out.columns[cell_of(tuning.runs, figure)].role = role;
    out.of_candidates.push_back({figure.heading(), true, role});
  };
  for (std::size_t i = 0; i < tuning.tuned; ++i)
    out.of_candidates.push_back({ranges[i].axis.heading(), true, Role::parameter});
  for (const Goal& goal : tuning.goals.goals)
    add(goal.figure, goal.maximize ? Role::maximize : Role::minimize);
  for (const Limit& limit : tuning.goals.limits) {
    // A goal with a limit keeps the role of a goal.
    const Role before = out.columns[cell_of(tuning.runs, limit.figure)].role;
    add(limit.figure, Role::limit);
    if (before != Role::figure) out.columns[cell_of(tuning.runs, limit.figure)].role = before;
  }
}

}  // namespace

Tuned optimize(const Tuning& tuning, const TuneOptions& options) {
  return Loop(tuning, options).run();
}

StudyRequest request_of(const Tuning& tuning) {
  StudyRequest out = request_of(tuning.runs);
  out.title = tuning.title;
  std::string own =
      fmt::format("method = {}, population {}, seed {}, step {}\n", to_text(tuning.method.kind),
                  tuning.method.population, tuning.method.seed, tuning.method.step);
  own += fmt::format("tuned = {}\ndraws = {}, {}\n", tuning.tuned, tuning.draws,
                     fmt::join(tuning.drawn, " "));
  for (const Goal& goal : tuning.goals.goals)
    own += fmt::format("{} = {} [{}]\n", goal.maximize ? "maximize" : "minimize", goal.figure.key,
                       goal.figure.unit);
  for (const Limit& limit : tuning.goals.limits) own += fmt::format("where = {}\n", limit.text);
  own += fmt::format("over = {}, hold = {}\n",
                     tuning.goals.over == Goals::Over::mean ? "mean" : "worst", tuning.goals.hold);
  // Inserted after the line of the version, by which studies of different versions are
  // distinguished.
  out.text.insert(out.text.find('\n') + 1, own);
  add_columns(tuning, out);
  return out;
}

CandidateRow row_of(const Candidate& candidate) {
  const CandidateEvaluation& evaluated = candidate.evaluation;
  CandidateRow out{.number = candidate.number,
                   .generation = candidate.generation,
                   .feasible = evaluated.feasible(),
                   .violation = evaluated.violation,
                   .holds = evaluated.holds,
                   .cells = {}};
  for (const Value& value : candidate.values) out.cells.push_back(value.cell);
  const auto add = [&](const std::vector<double>& numbers) {
    for (const double number : numbers)
      out.cells.push_back(std::isfinite(number) ? fmt::format("{:.9g}", number) : "");
  };
  add(evaluated.goals);
  add(evaluated.limits);
  return out;
}

}  // namespace sinew::tune
