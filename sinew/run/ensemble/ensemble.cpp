#include "sinew/run/ensemble/ensemble.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "sinew/analysis/summary.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/experiment/check.h"
#include "sinew/host/side_by_side.h"
#include "sinew/run/card/plan_table.h"
#include "sinew/run/ensemble/many.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/units/quantity.h"
#include "sinew/units/shell.h"

namespace sinew::run {
namespace {

// Figures that notes about a run need.
constexpr std::string_view of_notes[] = {"trolley.stop_reached_s", "unreachable_share"};

std::vector<std::string> with_notes(std::vector<std::string> figures) {
  for (const std::string_view key : of_notes) figures.emplace_back(key);
  return figures;
}

// Returns the value of a text in SI; nothing if it is not a quantity of that unit, or not a whole
// number if the unit is empty.
std::optional<double> value_of(const std::string& text, const std::string& unit,
                               double atmosphere) {
  if (unit.empty()) {
    int whole = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return whole;
  }
  const units::Parsed parsed = units::parse_quantity(text, unit, atmosphere);
  if (parsed.mistake) return {};
  return parsed.si;
}

std::string text_of(double value, const std::string& unit) {
  if (!unit.empty()) return units::format_quantity(value, unit);
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  return whole ? fmt::format("{:.0f}", value) : units::format_number(value);
}

// Throws config::Error as reading the file does.
void refuse_wrong(const experiment::Experiment& e, bool allow_unreachable) {
  experiment::refuse_contradictions("experiment", e);
  refuse_unbuildable(e);
  if (!allow_unreachable) experiment::refuse_unreachable(e);
}

// Gives the machine the parts of the experiment.
void describe(const experiment::Experiment& e, analysis::Machine& out) {
  analysis::replace_parts(out, e.actuators, e.valves);
  out.robot = e.robot;
  if (e.stand) {
    static_cast<robot::Stand&>(*out.stand) = *e.stand;
    out.stand->drive_period = e.stand->drive.period;
  }
  out.atmosphere = e.air.atmosphere;
  out.period = e.log.period;
  for (std::size_t i = 0; i < out.faults.size(); ++i) {
    out.faults[i].begin = e.faults[i].at;
    out.faults[i].end = experiment::end_of(e.faults[i]);
  }
}

std::string status_of(const experiment::Experiment& e, const Outcome& outcome) {
  if (outcome.ended_early()) return "ended early: " + cause_of(e, outcome);
  if (!outcome.table.complete) return "more valve edges than there was room for";
  return "ok";
}

// Adds judgements of the figures that are not part of the summary.
void compare_with_reported(const analysis::Machine& machine, RunResult& out) {
  for (const analysis::Verdict& v :
       analysis::compare(out.summary, machine.reported, machine.atmosphere))
    if (v.agreement == analysis::Verdict::Agreement::differs) out.differs.push_back(v.key);
}

}  // namespace

Ensemble::Ensemble(const std::string& experiment, const std::vector<std::string>& sets,
                   std::vector<std::string> parameters, std::vector<std::string> figures,
                   bool allow_unreachable)
    : own_(std::make_unique<config::Composer>()),
      files_(own_.get()),
      experiment_(experiment),
      sets_(sets),
      parameters_(std::move(parameters)),
      figures_(std::move(figures)),
      allow_unreachable_(allow_unreachable),
      start_(start({})) {
  for (auto key = parameters_.begin(); key != parameters_.end(); ++key)
    if (std::find(parameters_.begin(), key, *key) != key)
      config::fail({"parameters", 0, 0}, "", config::in_quotes(*key) + " twice",
                   "each parameter once");
  for (const std::string& key : unknown())
    config::fail({experiment, 0, 0}, key, "a parameter", "a number of the experiment",
                 "sinew show " + units::shell_word(experiment));
}

Ensemble::Ensemble(config::Composer& files, const std::string& experiment,
                   std::vector<std::string> sets, std::vector<std::string> parameters,
                   const std::vector<std::string>& values, std::vector<std::string> figures,
                   bool allow_unreachable)
    : files_(&files),
      experiment_(experiment),
      sets_(std::move(sets)),
      parameters_(std::move(parameters)),
      figures_(std::move(figures)),
      allow_unreachable_(allow_unreachable),
      start_(start(values)) {}

Ensemble::Start Ensemble::start(const std::vector<std::string>& values) const {
  std::unique_ptr<Member> first = read(values);
  experiment::Numbers numbers(first->experiment, parameters_);
  first->experiment.origins = {};  // a run does not need them, and copies the experiment
  return {std::move(first->experiment), std::move(first->machine), std::move(numbers), values};
}

std::vector<std::string> Ensemble::unknown() const {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (!start_.numbers.has(i)) out.push_back(parameters_[i]);
  return out;
}

// Reads the file with these values; without values, as it is.
std::unique_ptr<Ensemble::Member> Ensemble::read(const std::vector<std::string>& values) const {
  std::vector<std::string> sets = sets_;
  for (std::size_t i = 0; i < values.size(); ++i) sets.push_back(parameters_[i] + "=" + values[i]);
  const config::Node root = files_->compose(experiment_, sets);
  auto out = std::make_unique<Member>();
  out->machine = analysis::read_machine(root);
  out->experiment = buildable(root, experiment_);
  if (!allow_unreachable_) experiment::refuse_unreachable(out->experiment);
  return out;
}

std::unique_ptr<Ensemble::Member> Ensemble::spare() const {
  {
    const std::lock_guard lock(mutex_);
    if (!spare_.empty()) {
      std::unique_ptr<Member> out = std::move(spare_.back());
      spare_.pop_back();
      return out;
    }
  }
  return std::make_unique<Member>(Member{start_.experiment, start_.machine, nullptr, true});
}

// Returns whether the file is read for every run: if the atmosphere differs, to which pressures in
// the file may refer, or if a number determines others.
bool Ensemble::reads() const {
  if (std::ranges::find(parameters_, "air.atmosphere") != parameters_.end()) return true;
  const std::lock_guard lock(mutex_);
  return reads_;
}

// Returns the run with these values in SI without reading the file; null if it must be read.
std::unique_ptr<Ensemble::Member> Ensemble::set(std::span<const double> values) const {
  std::unique_ptr<Member> out = spare();
  if (!start_.numbers.set(out->experiment, values)) return nullptr;
  try {
    refuse_wrong(out->experiment, allow_unreachable_);
  } catch (const config::Error&) {
    return nullptr;  // the file's error names the place of each value
  }
  describe(out->experiment, out->machine);
  return out;
}

// Returns whether each parameter with a new value has been compared.
bool Ensemble::is_compared(std::span<const double> values) const {
  const std::lock_guard lock(mutex_);
  if (reads_) return false;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != start_.numbers.values()[i] && !(i < compared_.size() && compared_[i]))
      return false;
  return true;
}

// Compares an experiment whose numbers were set with one that was read: a number may determine
// others that the file does not give.
void Ensemble::compare(const Member& set, const Member& read,
                       std::span<const double> values) const {
  const bool equal = experiment::same_values(set.experiment, read.experiment);
  const std::lock_guard lock(mutex_);
  reads_ = reads_ || !equal;
  compared_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != start_.numbers.values()[i]) compared_[i] = true;
}

std::unique_ptr<Ensemble::Member> Ensemble::member(std::span<const double> values,
                                                   const std::vector<std::string>& texts) const {
  std::unique_ptr<Member> out = member_with(values, texts);
  out->values = texts;
  return out;
}

std::unique_ptr<Ensemble::Member> Ensemble::member_with(
    std::span<const double> values, const std::vector<std::string>& texts) const {
  std::shared_ptr<const analysis::Selection> selection = this->selection();
  std::unique_ptr<Member> out;
  if (texts == start_.values)
    return std::make_unique<Member>(
        Member{start_.experiment, start_.machine, std::move(selection)});
  if (!reads() && values.size() == parameters_.size()) out = set(values);
  if (!out) {
    out = read(texts);
  } else if (!is_compared(values)) {
    std::unique_ptr<Member> same = read(texts);
    compare(*out, *same, values);
    out = std::move(same);
  }
  out->selection = std::move(selection);
  return out;
}

std::unique_ptr<Ensemble::Member> Ensemble::member(const std::vector<std::string>& values) const {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const auto value = value_of(values[i], units()[i], start_.experiment.air.atmosphere))
      numbers.push_back(*value);
  return member(numbers, values);
}

std::unique_ptr<Ensemble::Member> Ensemble::member(std::span<const double> values) const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < values.size(); ++i) texts.push_back(text_of(values[i], units()[i]));
  return member(values, texts);
}

// Finds the parameters that change what the gait controller uses: each is changed by itself.
void Ensemble::find_plan_parameters() const {
  experiment::Experiment start = start_.experiment;
  start.robot = as_controlled(start.robot);
  std::vector<bool> found;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    std::vector<double> values = start_.numbers.values();
    values[i] += units()[i].empty() ? 1.0 : 1e-3 * (1.0 + std::abs(values[i]));
    experiment::Experiment changed = start_.experiment, of_plan = start;
    const bool is_set = start_.numbers.set_unbounded(changed, values);
    of_plan.robot = as_controlled(std::move(changed.robot));
    of_plan.plan = std::move(changed.plan);
    found.push_back(!is_set || !experiment::same_values(of_plan, start));
  }
  of_plan_ = std::move(found);
}

std::shared_ptr<const analysis::Selection> Ensemble::selection() const {
  const std::lock_guard lock(mutex_);
  return selection_;
}

// Returns the chosen device; the card of an earlier call stays open.
Device Ensemble::device_of(const Device& wanted, std::size_t rows) const {
  if (wanted.kind == Device::Kind::automatic && rows < fewest_on_card)
    return {.kind = Device::Kind::cpu};
  const std::lock_guard lock(mutex_);
  if (wanted.card || !(device_ == wanted) || !device_.card) device_ = chosen(wanted);
  return device_;
}

std::string Ensemble::plan_of(const Member& member) const {
  const bool are_read = reads();  // then a key may determine others
  const std::lock_guard lock(mutex_);
  if (of_plan_.empty()) find_plan_parameters();
  if (are_read) of_plan_.assign(parameters_.size(), true);
  std::string out = fmt::format("{} ", static_cast<const void*>(this));
  for (std::size_t i = 0; i < of_plan_.size() && i < member.values.size(); ++i)
    if (of_plan_[i]) out += member.values[i] + '\n';
  return out;
}

// Returns the figures of a run: the wanted ones from the topics that it recorded, or all of them.
// If these topics are too few, it is run again, and later runs record more. The topics that show
// whether a muscle took air are recorded by all runs after the first one that took none.
analysis::Summary Ensemble::figures_of(const Member& member, const Outcome& outcome,
                                       bool& no_air) const {
  const analysis::Machine& machine = member.machine;
  signals::TopicNames of_air;
  const auto uses_no_air = [&](const signals::Table& table) {
    return !outcome.took_air && !analysis::unused_air(table, machine, &of_air).empty();
  };
  if (member.selection) no_air = uses_no_air(outcome.table);
  if (member.selection && std::ranges::includes(member.selection->topics(), of_air))
    if (auto figures = member.selection->figures(outcome.table, machine))
      return std::move(*figures);
  Outcome again;
  if (member.selection) again = run::run(member.experiment);
  const signals::Table& table = member.selection ? again.table : outcome.table;
  no_air = uses_no_air(table);
  if (!figures_.empty() && !parameters_.empty()) {
    analysis::Selection selection(with_notes(figures_), table, machine);
    selection.add(of_air);
    const std::lock_guard lock(mutex_);
    if (selection_) selection.add(selection_->topics());
    if (!selection_ || selection_->topics() != selection.topics())
      selection_ = std::make_shared<const analysis::Selection>(std::move(selection));
  }
  analysis::Summary whole = analysis::summarize(table, machine);
  check_figures(whole);
  return whole;
}

// Returns the figures of the experiment as it was read first; none if it ends early.
analysis::Summary Ensemble::figures_as_it_is() const {
  const Outcome outcome = run::run(start_.experiment);
  if (outcome.ended_early()) return {};
  return analysis::summarize(outcome.table, start_.machine);
}

// Checks the wanted figures with those of a whole run. A figure that this run lacks is not refused
// if the experiment as it is has it.
void Ensemble::check_figures(const analysis::Summary& whole) const {
  std::vector<std::string> doubtful = figures_;
  std::erase_if(doubtful,
                [&](const std::string& key) { return analysis::nearest_key(key, whole).empty(); });
  if (doubtful.empty()) return;
  const analysis::Summary as_it_is = figures_as_it_is();
  try {
    for (const std::string& key : doubtful)
      if (!as_it_is.exists(key)) analysis::refuse_misspelt(key, whole, "figures");
  } catch (const config::Error&) {
    const std::lock_guard lock(mutex_);
    misspelt_ = std::current_exception();
  }
}

std::exception_ptr Ensemble::misspelt() const {
  const std::lock_guard lock(mutex_);
  return misspelt_;
}

RunResult Ensemble::result(std::unique_ptr<Member> member, const Outcome& outcome) const {
  RunResult out{.status = status_of(member->experiment, outcome)};
  out.atmosphere = member->machine.atmosphere;
  if (out.ok()) {
    out.summary = figures_of(*member, outcome, out.no_air);
    compare_with_reported(member->machine, out);
  }
  keep(std::move(member));
  return out;
}

void Ensemble::keep(std::unique_ptr<Member> member) const {
  if (!member->is_set) return;
  const std::lock_guard lock(mutex_);
  spare_.push_back(std::move(member));
}

std::vector<std::string> Ensemble::run(std::span<const double> values, std::span<double> figures,
                                       const Options& options) const {
  const std::size_t width = parameters_.size(), wide = figures_.size();
  const std::size_t rows =
      width > 0 ? values.size() / width : figures.size() / std::max<std::size_t>(1, wide);
  if (values.size() != rows * width || figures.size() != rows * wide)
    throw std::invalid_argument(
        fmt::format("found {} values and room for {} figures; expected {} and {} for each run",
                    values.size(), figures.size(), width, wide));
  const Device device = device_of(options.device, rows);
  std::ranges::fill(figures, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::string> status(rows, "not run");
  std::atomic<std::size_t> taken{0};
  const auto next = [&]() -> std::optional<std::size_t> {
    if ((options.stop && options.stop->load()) || misspelt()) return {};
    const std::size_t row = taken++;
    if (row >= rows) return {};
    return row;
  };
  const auto begin = [&](std::size_t row) {
    // The ensemble outlives its runs, so that they need not own a share.
    return BegunRun{{std::shared_ptr<void>(), this}, member(values.subspan(row * width, width))};
  };
  const auto done = [&](std::size_t row, const RunResult& result) {
    status[row] = result.status;
    for (std::size_t i = 0; i < wide; ++i)
      if (const double* figure = result.summary.find(figures_[i]))
        figures[row * wide + i] = *figure;
    if (options.progress) ++*options.progress;
  };
  run_on(device, rows,
         {.next = next,
          .begin = begin,
          .done = done,
          .lanes = options.lanes,
          .stopped = [&] { return options.stop && options.stop->load(); },
          .notice = options.notice},
         host::threads_of(options.threads));
  // Checks the names of the figures where no run has figures.
  const bool is_stopped = options.stop && options.stop->load();
  if (rows > 0 && !is_stopped && std::ranges::find(status, "ok") == status.end())
    if (const analysis::Summary as_it_is = figures_as_it_is(); !as_it_is.entries().empty())
      check_figures(as_it_is);
  if (const std::exception_ptr wrong = misspelt()) std::rethrow_exception(wrong);
  return status;
}

}  // namespace sinew::run
