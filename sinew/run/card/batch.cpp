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

// Returns a recorder whose true values are given, for the topics of a run.
Recorder recorder_of(const BatchedRun& run, const Controllers& controllers, Tick last) {
  return {*run.experiment, controllers, Recorder::Truths::given, last, run.topics};
}

// A run of a batch with its controllers, which show what the walk has computed.
class Prepared {
 public:
  Prepared(const BatchedRun& run, const plant::Setup& setup)
      : run_(run),
        controllers_(*run.experiment, nullptr),
        last_(experiment::last_tick(*run.experiment)) {
    const Recorder recorder = recorder_of(run_, controllers_, last_);
    period_ = recorder.period();
    records_edges_ = recorder.records_edges();
    for (const Column& column : recorder.columns()) columns_ += column.topic.name + '\n';
    walk_.emplace(plant::FlatLeg(setup),
                  SingleBoard{controllers_.boards().each().front(), controllers_.scan().period},
                  Walk::Timing{last_, recorder.next(0), period_});
  }

  const BatchedRun& run() const { return run_; }
  const Controllers& controllers() const { return controllers_; }
  // Returns the names of its columns.
  const std::string& columns() const { return columns_; }
  Tick last() const { return last_; }
  // Return room for its samples and edges.
  std::int32_t samples() const { return static_cast<std::int32_t>(last_ / period_ + 2); }
  std::int32_t edges() const {
    return records_edges_ ? static_cast<std::int32_t>(8 * controllers_.most_edges(last_)) : 0;
  }

  // Returns its walk with the commands of this plan, which begin at this place among all.
  Walk take_walk(std::shared_ptr<const PlanTable> plan, std::int64_t first) {
    plan_ = std::move(plan);
    Walk out = *walk_;
    walk_.reset();
    out.set_plan(first,
                 {nullptr, static_cast<std::int64_t>(plan_->commands().size()), plan_->vents_at()});
    return out;
  }

  // Returns its outcome after the launch; nothing if it did not end as planned.
  std::optional<Outcome> outcome(const Walk& ended, const Batched& batched, std::size_t number);

 private:
  void show(const Shown& shown) {
    controllers_.boards().show(shown.controller, shown.supervised,
                               {0, std::numeric_limits<Tick>::max()});
  }

  BatchedRun run_;
  Controllers controllers_;
  Tick last_, period_ = 0;
  bool records_edges_ = false;
  std::string columns_;
  std::optional<Walk> walk_;
  std::shared_ptr<const PlanTable> plan_;
};

std::optional<Outcome> Prepared::outcome(const Walk& ended, const Batched& batched,
                                         std::size_t number) {
  const control::Supervisor& supervisor = ended.board().supervisor;
  if (!ended.complete() || ended.status() != signals::Status::ok || ended.leg().failure() ||
      supervisor.state().fault != signals::Status::ok ||
      supervisor.supervised().trip.cause != control::Trip::Cause::none)
    return {};

  Recorder recorder = recorder_of(run_, controllers_, last_);
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

  show({{}, supervisor.state(), supervisor.supervised()});
  Outcome out{.status = ended.status()};
  add_end(*run_.experiment, controllers_, &recorder, last_, out);
  out.unreachable_periods = plan_->unreachable_periods();
  out.nodes = ended.leg().nodes();
  return out;
}

// Returns the run, if a batch can hold it. What run() would throw is left to run().
std::unique_ptr<Prepared> prepare(const BatchedRun& run) {
  try {
    if (run.experiment == nullptr || !fits_batch(*run.experiment)) return nullptr;
    return std::make_unique<Prepared>(run, planar_setup(*run.experiment));
  } catch (const std::exception&) {
    return nullptr;
  }
}

// What all columns of the runs depend on, ascending.
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
  std::vector<const Prepared*> firsts;  // of each group with a plan of its own
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
        tables[g] = std::make_shared<const PlanTable>(firsts[g]->controllers(), firsts[g]->last());
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

// Throws if a run of the launch has other bits than by itself: then none can be trusted.
void compare_with_alone(const BatchedRun& of, const Outcome& launched) {
  if (!same_bits(launched.table, run(*of.experiment, {.topics = of.topics}).table))
    throw std::runtime_error(
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
    batched.walks[i].run(launch, static_cast<std::int64_t>(i), [](bool x) { return x; });
}

std::vector<std::optional<Outcome>> run_batch(std::span<const BatchedRun> runs,
                                              const Launcher& launch, int threads) {
  std::vector<std::unique_ptr<Prepared>> all(runs.size());
  const auto each = [&](std::size_t count, const auto& work) {
    host::side_by_side(count, work, nullptr, threads);
  };
  each(runs.size(), [&](std::size_t i) { all[i] = prepare(runs[i]); });
  std::vector<Prepared*> held;
  for (const auto& run : all)
    if (run) held.push_back(run.get());
  std::vector<std::optional<Outcome>> out(runs.size());
  if (held.empty()) return out;

  std::vector<Walk> walks;
  const std::vector<control::Command> commands = take_walks(held, threads, walks);
  const std::vector<std::uint16_t> wanted = wanted_words(held);
  Batched batched{.walks = {}, .commands = commands, .wanted = wanted, .sample = {}, .edge = {}};
  for (const Prepared* run : held) {
    batched.samples = std::max(batched.samples, run->samples());
    batched.edges = std::max(batched.edges, run->edges());
  }
  batched.walks = walks;
  std::vector<std::uint64_t> sample(walks.size() * wanted.size() *
                                    static_cast<std::size_t>(batched.samples));
  std::vector<std::uint32_t> edge(walks.size() * static_cast<std::size_t>(batched.edges));
  batched.sample = sample;
  batched.edge = edge;
  launch(batched);

  std::vector<std::optional<Outcome>> ended(held.size());
  each(held.size(), [&](std::size_t i) { ended[i] = held[i]->outcome(walks[i], batched, i); });
  const auto first = std::ranges::find_if(ended, [](const auto& its) { return its.has_value(); });
  if (first != ended.end())
    compare_with_alone(held[static_cast<std::size_t>(first - ended.begin())]->run(), **first);
  for (std::size_t i = 0, k = 0; i < runs.size(); ++i)
    if (all[i]) out[i] = std::move(ended[k++]);
  return out;
}

}  // namespace sinew::run
