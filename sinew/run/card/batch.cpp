#include "sinew/run/card/batch.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "sinew/host/side_by_side.h"
#include "sinew/run/card/plan_table.h"
#include "sinew/run/card/sampled.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/recorded_run.h"
#include "sinew/run/simulation/recorder.h"

namespace sinew::run {

using experiment::Experiment;
using signals::Tick;

namespace {

// Returns a recorder for the topics of a run, which is given the true values of each sample.
Recorder recorder_of(const BatchedRun& run, const Controllers& controllers, Tick last) {
  const std::vector<Column> all = columns(*run.experiment);
  return {*run.experiment, all, controllers, Recorder::Truths::given, last, run.topics};
}

// Returns whether a walk ended as planned.
bool ended_well(const Walk& walk) {
  const control::Supervisor& supervisor = walk.board().supervisor;
  return walk.complete() && walk.status() == signals::Status::ok && !walk.leg().failure() &&
         supervisor.state().fault == signals::Status::ok &&
         supervisor.supervised().trip.cause == control::Trip::Cause::none;
}

// A run of a batch.
class Prepared {
 public:
  Prepared(const BatchedRun& run, const plant::Setup& setup)
      : run_(run), last_(experiment::last_tick(*run.experiment)) {
    const Controllers controllers(*run.experiment, nullptr);
    const Recorder recorder = recorder_of(run_, controllers, last_);
    period_ = recorder.period();
    samples_ = static_cast<std::int32_t>(last_ / period_ + 2);
    if (recorder.records_edges())
      edges_ = static_cast<std::int32_t>(8 * controllers.most_edges(last_));
    plan_rows_ = static_cast<std::size_t>(last_ / controllers.scan().period + 1);
    for (const Column& column : recorder.columns()) columns_ += column.topic.name + '\n';
    walk_.emplace(plant::FlatLeg(setup),
                  SingleBoard{controllers.boards().each().front(), controllers.scan().period},
                  Walk::Timing{last_, recorder.next(0), period_});
  }

  const BatchedRun& run() const { return run_; }
  // Returns the names of its columns.
  const std::string& columns() const { return columns_; }
  Tick last() const { return last_; }
  // Return the largest number of its samples and edges, and the memory of its plan's table [byte].
  std::int32_t samples() const { return samples_; }
  std::int32_t edges() const { return edges_; }
  std::size_t plan_size() const { return plan_rows_ * PlanTable::row_size; }

  // Returns its walk with the commands of this plan; `first` is the index of the first of them in
  // Batched::commands.
  Walk take_walk(std::shared_ptr<const PlanTable> plan, std::int64_t first) {
    plan_ = std::move(plan);
    Walk out = *walk_;
    walk_.reset();
    out.set_plan(first,
                 {nullptr, static_cast<std::int64_t>(plan_->commands().size()), plan_->vents_at()});
    return out;
  }

  // Returns its outcome after the launch, in which it has ended well.
  Outcome outcome(const Walk& ended, const Batched& batched, std::size_t number) const;

 private:
  BatchedRun run_;
  Tick last_, period_ = 0;
  std::int32_t samples_ = 0, edges_ = 0;
  std::size_t plan_rows_ = 0;
  std::string columns_;
  std::optional<Walk> walk_;
  std::shared_ptr<const PlanTable> plan_;
};

// The recorder reads from controllers that are set to the values of each sample.
Outcome Prepared::outcome(const Walk& ended, const Batched& batched, std::size_t number) const {
  Controllers controllers(*run_.experiment, nullptr);
  const auto show = [&](const Shown& shown) {
    controllers.boards().show(shown.controller, shown.supervised,
                              {0, std::numeric_limits<Tick>::max()});
  };
  Recorder recorder = recorder_of(run_, controllers, last_);
  const std::size_t runs = batched.walks.size(), words = batched.wanted.size();
  std::array<std::uint64_t, words_of<Shown>> sample{};
  plant::Truths truths;
  Shown shown{};
  Tick t = ended.first_sample();
  for (std::int32_t s = 0; s < ended.samples(); ++s, t += period_) {
    const std::size_t row = static_cast<std::size_t>(s) * words;
    for (std::size_t w = 0; w < words; ++w)
      sample[batched.wanted[w]] = batched.sample[(row + w) * runs + number];
    std::memcpy(static_cast<void*>(&shown), sample.data(), sizeof shown);
    truths.robot = shown.truth;
    show(shown);
    recorder.sample(t, truths, plan_->desired_at(t));
  }
  for (std::int32_t k = 0; k < ended.edges(); ++k)
    recorder.edge(PackedEdge::unpack(batched.edge[static_cast<std::size_t>(k) * runs + number]));

  const control::Supervisor& supervisor = ended.board().supervisor;
  show({{}, supervisor.state(), supervisor.supervised()});
  Outcome out{.status = ended.status()};
  add_end(*run_.experiment, controllers, &recorder, last_, out);
  out.unreachable_periods = plan_->unreachable_periods();
  out.nodes = ended.leg().nodes();
  out.took_air = ended.leg().took_air();
  return out;
}

// Returns the run; nullptr if a batch cannot run it, or if it is refused: then run() throws.
std::unique_ptr<Prepared> prepare(const BatchedRun& run) {
  try {
    if (run.experiment == nullptr || !fits_batch(*run.experiment)) return nullptr;
    return std::make_unique<Prepared>(run, planar_setup(*run.experiment));
  } catch (const std::exception&) {
    return nullptr;
  }
}

// Returns the words of Shown that the columns of all runs depend on, ascending.
std::vector<std::uint16_t> wanted_words(std::span<Prepared* const> runs) {
  std::set<std::string> seen;
  std::vector<std::uint16_t> all;
  for (const Prepared* run : runs) {
    if (!seen.insert(run->columns()).second) continue;
    Controllers controllers(*run->run().experiment, nullptr);
    const Recorder recorder = recorder_of(run->run(), controllers, run->last());
    const std::vector<std::uint16_t> more = words_behind(recorder.columns(), controllers);
    all.insert(all.end(), more.begin(), more.end());
  }
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  return all;
}

// Moves the walks of the runs to `walks`, each with its table of commands, and returns the
// commands.
std::vector<control::Command> take_walks(std::span<Prepared* const> runs, int threads,
                                         std::vector<Walk>& walks) {
  std::map<std::string, std::size_t> group_of;
  std::vector<const Prepared*> firsts;  // one run of each group with a plan of its own
  std::vector<std::size_t> groups;
  for (const Prepared* run : runs) {
    const auto [at, is_new] = group_of.try_emplace(run->run().plan, firsts.size());
    if (is_new) firsts.push_back(run);
    groups.push_back(at->second);
  }
  std::vector<std::shared_ptr<const PlanTable>> tables(firsts.size());
  host::side_by_side(
      firsts.size(),
      [&](std::size_t g) {
        const Experiment& e = *firsts[g]->run().experiment;
        tables[g] = std::make_shared<const PlanTable>(e, Controllers(e, nullptr));
      },
      nullptr, threads);
  std::vector<control::Command> commands;
  std::vector<std::int64_t> places;
  for (const auto& table : tables) {
    places.push_back(static_cast<std::int64_t>(commands.size()));
    commands.insert(commands.end(), table->commands().begin(), table->commands().end());
  }
  walks.reserve(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i)
    walks.push_back(runs[i]->take_walk(tables[groups[i]], places[groups[i]]));
  return commands;
}

// Returns whether two tables have the same bits.
bool same_bits(const signals::Table& a, const signals::Table& b) {
  const auto same = [](const auto& x, const auto& y) {
    bool all = x.size() == y.size();
    for (std::size_t i = 0; all && i < x.size(); ++i) {
      const auto p = x[i], q = y[i];
      all = std::memcmp(&p, &q, sizeof p) == 0;
    }
    return all;
  };
  bool all = a.series.size() == b.series.size();
  for (std::size_t s = 0; all && s < a.series.size(); ++s) {
    all = same(a.series[s].time_ns, b.series[s].time_ns) &&
          a.series[s].columns.size() == b.series[s].columns.size();
    for (std::size_t c = 0; all && c < a.series[s].columns.size(); ++c)
      all = same(a.series[s].columns[c], b.series[s].columns[c]);
  }
  return all;
}

// Throws if a run of the launch has other bits than run(): then none of its runs can be trusted.
void compare_with_alone(const BatchedRun& of, const Outcome& launched) {
  const Outcome alone = run(*of.experiment, {.topics = of.topics});
  if (!same_bits(launched.table, alone.table) || launched.nodes != alone.nodes ||
      launched.duration != alone.duration)
    throw WrongBits(
        "found other bits than the processor's in a run that was launched together with others; "
        "expected the same; use the processor instead (device cpu), and report it with the output "
        "of `sinew doctor`");
}

}  // namespace

bool fits_batch(const Experiment& e) {
  if (e.stand || !e.faults.empty() || measures(e.plan) || !e.robot.legs.empty()) return false;
  if (experiment::last_tick(e) >= PackedEdge::latest) return false;
  const plant::Setup setup = planar_setup(e);
  return plant::FlatLeg::fits(setup) && boards_of(e).size() == 1;
}

void launch_on_processor(const Batched& batched) {
  const Launch launch{
      batched.commands.data(),
      {batched.wanted.data(), static_cast<std::int32_t>(batched.wanted.size()), batched.samples,
       batched.edges, static_cast<std::int64_t>(batched.walks.size()), batched.sample.data(),
       batched.edge.data()}};
  for (std::size_t i = 0; i < batched.walks.size(); ++i)
    batched.walks[i].run(launch, static_cast<std::int64_t>(i), true, [](bool x) { return x; });
}

namespace {

// One launch, with its memory.
class Part {
 public:
  // Takes the walks of these runs, with room for their samples and edges.
  Part(std::span<Prepared* const> runs, std::span<const std::uint16_t> wanted, int threads)
      : runs_(runs), threads_(threads), commands_(take_walks(runs, threads, walks_)) {
    batched_.walks = walks_;
    batched_.commands = commands_;
    batched_.wanted = wanted;
    for (const Prepared* run : runs) {
      batched_.samples = std::max(batched_.samples, run->samples());
      batched_.edges = std::max(batched_.edges, run->edges());
    }
    sample_.resize(walks_.size() * wanted.size() * static_cast<std::size_t>(batched_.samples));
    edge_.resize(walks_.size() * static_cast<std::size_t>(batched_.edges));
    batched_.sample = sample_;
    batched_.edge = edge_;
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  // Runs them, and passes the outcomes of those that ended well to done(number, outcome) from
  // threads, after the first and the last have been compared with run().
  template <class Done>
  void run(const Launcher& launcher, const Done& done) {
    launcher.launch(batched_);
    const auto finish = [&](std::size_t i) { return runs_[i]->outcome(walks_[i], batched_, i); };
    std::vector<std::size_t> ended;
    for (std::size_t i = 0; i < walks_.size(); ++i)
      if (ended_well(walks_[i])) ended.push_back(i);
    if (ended.empty()) return;
    compare_with_alone(runs_[ended.front()]->run(), finish(ended.front()));
    if (ended.size() > 1) compare_with_alone(runs_[ended.back()]->run(), finish(ended.back()));
    host::side_by_side(
        ended.size(), [&](std::size_t k) { done(ended[k], finish(ended[k])); }, nullptr, threads_);
  }

 private:
  std::span<Prepared* const> runs_;
  int threads_;
  std::vector<Walk> walks_;
  std::vector<control::Command> commands_;
  Batched batched_{};
  std::vector<std::uint64_t> sample_;
  std::vector<std::uint32_t> edge_;
};

// Returns how many of the runs, from the first on, fit in this memory [byte]; at least 1. Each
// takes as much as the largest of them.
std::size_t runs_in(std::size_t memory, std::span<Prepared* const> runs, std::size_t words) {
  std::set<std::string> plans;
  std::size_t of_plans = 0, largest = 0, count = 0;
  for (const Prepared* run : runs) {
    const auto samples = static_cast<std::size_t>(run->samples());
    largest = std::max(largest, sizeof(Walk) + samples * words * sizeof(std::uint64_t) +
                                    static_cast<std::size_t>(run->edges()) * sizeof(std::uint32_t));
    if (plans.insert(run->run().plan).second) of_plans += run->plan_size();
    if (of_plans + (count + 1) * largest > memory) break;
    ++count;
  }
  return std::max<std::size_t>(1, count);
}

}  // namespace

void run_batch(std::span<const BatchedRun> runs, const Launcher& launcher, int threads,
               const std::function<bool()>& stopped,
               const std::function<void(std::size_t, Outcome)>& done) {
  std::vector<std::unique_ptr<Prepared>> all(runs.size());
  host::side_by_side(
      runs.size(), [&](std::size_t i) { all[i] = prepare(runs[i]); }, nullptr, threads);
  std::vector<Prepared*> held;
  std::vector<std::size_t> place;  // their numbers in `runs`
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i]) continue;
    held.push_back(all[i].get());
    place.push_back(i);
  }
  if (held.empty()) return;

  const std::vector<std::uint16_t> wanted = wanted_words(held);
  for (std::size_t first = 0, count = 0; first < held.size() && !stopped(); first += count) {
    const std::span<Prepared* const> rest = std::span<Prepared* const>(held).subspan(first);
    count = runs_in(launcher.memory(), rest, wanted.size());
    Part(rest.first(count), wanted, threads).run(launcher, [&](std::size_t i, Outcome outcome) {
      done(place[first + i], std::move(outcome));
    });
    for (std::size_t i = 0; i < count; ++i) all[place[first + i]].reset();
  }
}

}  // namespace sinew::run
