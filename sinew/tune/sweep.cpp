#include "sinew/tune/sweep.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <mutex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/shipped.h"
#include "sinew/host/side_by_side.h"

namespace sinew::tune {

Notes notes_of(const RunResult& result, const std::vector<std::string>& keys) {
  Notes out;
  if (!result.ok()) return out;
  for (const std::string& key : keys) {
    if (!result.summary.find(key)) out.lacks.push_back(key);
    if (std::ranges::find(result.differs, key) != result.differs.end()) out.differs.push_back(key);
  }
  const double* share = result.summary.find("unreachable_share");
  out.stop_reached = result.summary.find("trolley.stop_reached_s") != nullptr;
  out.no_air = result.no_air;
  out.out_of_reach = share && *share > 0;
  return out;
}

std::string to_text(const Notes& notes) {
  std::vector<std::string> words;
  if (!notes.lacks.empty())
    words.push_back(fmt::format("without {}", fmt::join(notes.lacks, ", ")));
  if (notes.stop_reached) words.emplace_back("reaches the end of the track");
  if (notes.no_air) words.emplace_back("uses no air");
  if (notes.out_of_reach) words.emplace_back("aims out of reach");
  if (!notes.differs.empty())
    words.push_back(fmt::format("differs in {}", fmt::join(notes.differs, ", ")));
  return fmt::format("{}", fmt::join(words, "; "));
}

std::string status_with(const Notes& notes, std::string_view status) {
  const std::string words = to_text(notes);
  if (words.empty()) return std::string(status);
  return status == "ok" ? words : fmt::format("{}; {}", status, words);
}

namespace {

// --- one point ---

struct Point {
  std::string experiment;
  std::vector<std::string> sets, cells;
};

void add_case(const Case& one, Point& out) {
  if (!one.experiment.empty()) out.experiment = one.experiment;
  out.sets.insert(out.sets.end(), one.sets.begin(), one.sets.end());
}

// The points of a sweep by their number. The sample's shares are drawn once, and the files of the
// runs are read once.
class Points {
 public:
  explicit Points(const Sweep& s, std::shared_ptr<run::Ensembles> runs = {})
      : sweep_(s),
        shares_(s.sample ? shares(*s.sample) : std::vector<double>{}),
        runs_(runs ? std::move(runs) : ensembles_of(s)) {}

  Point at(std::size_t index) const;
  run::Ensembles& runs() const { return *runs_; }

 private:
  void add_sampled(std::size_t index, Point& out) const;

  const Sweep& sweep_;
  std::vector<double> shares_;
  std::shared_ptr<run::Ensembles> runs_;
};

void Points::add_sampled(std::size_t index, Point& out) const {
  const std::vector<Range>& ranges = sweep_.sample->ranges;
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    const Value value = ranges[r].at(shares_[index * ranges.size() + r]);
    out.sets.push_back(ranges[r].axis.set(value));
    out.cells.push_back(value.cell);
  }
}

Point Points::at(std::size_t index) const {
  const Sweep& s = sweep_;
  Point out{.experiment = s.experiment, .sets = s.sets, .cells = {}};
  const Grid grid(s.axes);
  const std::size_t cases = std::max<std::size_t>(1, s.cases.size());
  const std::size_t ahead = index / grid.size();  // index of sample and case
  if (!s.cases.empty()) add_case(s.cases[ahead % cases], out);
  if (s.sample) add_sampled(ahead / cases, out);
  if (!s.cases.empty()) out.cells.push_back(s.cases[ahead % cases].name);
  const std::vector<const Value*> values = grid.point(index % grid.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (s.axes[i].key == "experiment")
      out.experiment = experiment_path(s, values[i]->text);
    else
      out.sets.push_back(s.axes[i].set(*values[i]));
    out.cells.push_back(values[i]->cell);
  }
  return out;
}

// Returns whether a condition's key is missing; such a condition never holds.
bool lacks_condition(const Search& search, const std::vector<std::string>& lacks) {
  return std::ranges::any_of(search.where, [&](const Condition& c) {
    return std::ranges::find(lacks, c.key) != lacks.end();
  });
}

// Throws config::Error for a figure or a condition whose key is probably misspelt.
void refuse_misspelt(const Sweep& s, const analysis::Summary& summary) {
  for (const Figure& figure : s.report)
    analysis::refuse_misspelt(figure.key, summary, figure.setting);
  if (s.largest)
    for (const Condition& condition : s.largest->where)
      analysis::refuse_misspelt(condition.key, summary, condition.setting);
}

void add_report(const Sweep& s, const RunResult& result, std::vector<std::string>& cells) {
  for (const Figure& figure : s.report)
    cells.push_back(result.ok() ? figure.cell(result.summary, result.atmosphere) : "");
}

Row single(const Sweep& s, std::size_t index, Point point, const RunResult& result, bool first) {
  if (first && result.ok()) refuse_misspelt(s, result.summary);
  add_report(s, result, point.cells);
  Notes notes = notes_of(result, keys(s));
  point.cells.push_back(status_with(notes, result.status));
  return {index, std::move(point.cells), result.ok(), std::move(notes)};
}

std::string searched_status(const Search& search, const Largest& found, const RunResult& last,
                            const Notes& notes) {
  if (found.is == Largest::Is::to_the_end) return status_with(notes, "holds to the last value");
  if (found.is == Largest::Is::between) return status_with(notes, "ok");
  if (lacks_condition(search, notes.lacks)) return status_with({.lacks = notes.lacks}, "ok");
  return last.ok() ? "does not hold at the first value" : last.status;
}

// Runs a search; its row has the figures of the largest value that held.
Row searched(const Sweep& s, const Points& points, std::size_t index, bool first) {
  Point point = points.at(index);
  const Search& search = *s.largest;
  RunResult best, last;
  int runs = 0;
  const auto holds = [&](double number) {
    std::vector<std::string> sets = point.sets;
    sets.push_back(search.axis.set(search.axis.at(number)));
    last = points.runs().run_once(point.experiment, sets);
    if (++runs == 1 && first && last.ok()) refuse_misspelt(s, last.summary);
    const bool all = last.ok() && std::ranges::all_of(search.where, [&](const Condition& c) {
                       return c.holds(last.summary);
                     });
    if (all) best = last;
    return all;
  };
  std::vector<double> values;
  for (const Value& value : search.axis.values) values.push_back(*value.number);

  const Largest found = largest(values, search.halvings, holds);
  const bool any = found.is != Largest::Is::never;
  point.cells.push_back(any ? search.axis.at(found.value).cell : "");
  Notes notes = notes_of(any ? best : last, keys(s));
  std::string status = searched_status(search, found, last, notes);
  if (!any) notes = {.lacks = std::move(notes.lacks)};
  add_report(s, best, point.cells);
  point.cells.push_back(std::to_string(runs));
  point.cells.push_back(std::move(status));
  return {index, std::move(point.cells), any, std::move(notes)};
}

Row row_of(const Sweep& s, const Points& points, std::size_t index, bool first) {
  if (s.largest) return searched(s, points, index, first);
  Point point = points.at(index);
  const RunResult result = points.runs().run_once(point.experiment, point.sets);
  return single(s, index, std::move(point), result, first);
}

// Runs these points on threads, or on a card, and passes their rows to done(), one at a time.
// Begins no further one once it is stopped. A search runs by itself, since each run depends on the
// one before.
void run_points(const Sweep& s, const Points& points, std::span<const std::size_t> numbers,
                const Options& how, const std::function<void(Row)>& done) {
  std::atomic<std::size_t> taken{0};
  std::mutex mutex;
  const auto next = [&]() -> std::optional<std::size_t> {
    const std::size_t i = how.stop && how.stop->load() ? numbers.size() : taken++;
    if (i >= numbers.size()) return {};
    return numbers[i];
  };
  const auto hand_back = [&](Row row) {
    const std::lock_guard lock(mutex);
    done(std::move(row));
  };
  if (s.largest) {
    const auto search = [&](std::size_t) {
      while (const std::optional<std::size_t> index = next())
        hand_back(row_of(s, points, *index, false));
    };
    const std::size_t threads = std::min(static_cast<std::size_t>(how.threads), numbers.size());
    return host::side_by_side(threads, search, nullptr, how.threads);
  }
  const auto begin = [&](std::size_t index) {
    const Point point = points.at(index);
    return points.runs().begin(point.experiment, point.sets);
  };
  const auto result = [&](std::size_t index, const RunResult& its) {
    hand_back(single(s, index, points.at(index), its, false));
  };
  run::run_on(how.device, numbers.size(),
              {.next = next,
               .begin = begin,
               .done = result,
               .lanes = how.lanes,
               .stopped = [&] { return how.stop && how.stop->load(); },
               .notice = how.notice},
              how.threads);
}

// --- all points ---

// The rows of a sweep, in their order.
class Work {
 public:
  Work(const Sweep& s, const Options& options)
      : sweep_(s), points_(s, options.runs), options_(options), rows_(points(s)) {
    for (const Row& row : options.known)
      if (options.share.has(row.point)) rows_.at(row.point) = row;
    for (std::size_t i = options.share.i - 1; i < rows_.size(); i += options.share.n)
      if (!rows_[i]) to_do_.push_back(i);
    if (options.progress)
      *options.progress =
          static_cast<std::int64_t>(options.share.size(rows_.size()) - to_do_.size());
  }

  // Runs the first point in the caller's thread, which throws its refusal.
  void first() {
    if (!to_do_.empty()) done(row_of(sweep_, points_, to_do_[next_++], true));
  }

  // Runs the others, here or elsewhere.
  void others() {
    const auto points = std::span<const std::size_t>(to_do_).subspan(next_);
    const auto take = [this](Row row) { done(std::move(row)); };
    if (!options_.dispatch)
      run_points(sweep_, points_, points, options_, take);
    else if (!points.empty() && !(options_.stop && options_.stop->load()))
      options_.dispatch(points, take);
  }

  // Returns all completed rows, including those after a gap if it was stopped.
  std::vector<Row> finish() {
    std::vector<Row> out;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!rows_[i]) continue;
      if (i >= reported_ && options_.row) options_.row(*rows_[i]);
      out.push_back(std::move(*rows_[i]));
    }
    return out;
  }

 private:
  void done(Row row) {
    const std::size_t index = row.point;
    if (options_.done) options_.done(row);
    rows_[index] = std::move(row);
    if (options_.progress) ++*options_.progress;
    for (; reported_ < rows_.size() && (rows_[reported_] || !options_.share.has(reported_));
         ++reported_)
      if (options_.row && rows_[reported_]) options_.row(*rows_[reported_]);
  }

  const Sweep& sweep_;
  const Points points_;
  const Options& options_;
  std::vector<std::optional<Row>> rows_;
  std::vector<std::size_t> to_do_;  // points of the share that are not known
  std::size_t next_ = 0;            // index in to_do_
  std::size_t reported_ = 0;        // points whose rows were passed to Options::row
};

}  // namespace

std::string experiment_path(const Sweep& s, const std::string& file) {
  const auto beside = (std::filesystem::path(s.experiment).parent_path() / file).lexically_normal();
  std::error_code none;
  const std::string shipped =
      std::filesystem::exists(beside, none) ? "" : config::find_shipped(file);
  return shipped.empty() ? beside.string() : shipped;
}

std::vector<std::string> keys(const Sweep& s) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& key) {
    if (std::ranges::find(out, key) == out.end()) out.push_back(key);
  };
  for (const Figure& figure : s.report) add(figure.key);
  if (s.largest)
    for (const Condition& condition : s.largest->where) add(condition.key);
  return out;
}

std::vector<std::string> headings(const Sweep& s) {
  std::vector<std::string> out;
  if (s.sample)
    for (const Range& range : s.sample->ranges) out.push_back(range.axis.heading());
  if (!s.cases.empty()) out.push_back("case");
  for (const Axis& axis : s.axes) out.push_back(axis.heading());
  if (s.largest) out.push_back("largest " + s.largest->axis.heading());
  for (const Figure& figure : s.report) out.push_back(figure.heading());
  if (s.largest) out.push_back("runs");
  out.push_back("status");
  return out;
}

Share parse_share(std::string_view text) {
  Share out;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto read = [&](std::size_t from, std::size_t to, std::size_t& number) {
    const auto [end, error] = std::from_chars(text.data() + from, text.data() + to, number);
    return error == std::errc{} && end == text.data() + to;
  };
  const bool numbers =
      slash < text.size() && read(0, slash, out.i) && read(slash + 1, text.size(), out.n);
  if (!numbers || out.i < 1 || out.i > out.n || out.n > most_points)
    config::fail({"shard", 0, 0}, "", config::in_quotes(text),
                 fmt::format("i/n, i from 1 to n, n at most {}", most_points), "shard=1/3");
  return out;
}

std::shared_ptr<run::Ensembles> ensembles_of(const Sweep& s) {
  return std::make_shared<run::Ensembles>(keys(s), s.allow_unreachable);
}

std::size_t points(const Sweep& s) {
  return (s.sample ? s.sample->points : 1) * std::max<std::size_t>(1, s.cases.size()) *
         Grid(s.axes).size();
}

std::vector<Row> sweep(const Sweep& s, const Options& options) {
  if (!options.checked) check(s);
  Options its = options;
  if (!options.dispatch) its.device = run::chosen(options.device);
  Work work(s, its);
  if (!options.checked) work.first();
  work.others();
  return work.finish();
}

struct Runner::Drawn {
  explicit Drawn(const Sweep& s) : sweep(s), points(sweep) {}

  const Sweep sweep;
  const Points points;
};

Runner::Runner(const Sweep& s) : drawn_(std::make_unique<Drawn>(s)) {}
Runner::~Runner() = default;

void Runner::run(std::span<const std::size_t> points, int threads,
                 const std::function<void(Row)>& done, const run::Device& device) const {
  run_points(drawn_->sweep, drawn_->points, points, {.threads = threads, .device = device}, done);
}

}  // namespace sinew::tune
