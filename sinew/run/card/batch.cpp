#include "sinew/run/card/batch.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>

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

// A run of a batch with its controllers, which show what the walk has computed.
class Prepared {
 public:
  Prepared(const BatchedRun& run, const plant::Setup& setup)
      : run_(run),
        controllers_(*run.experiment, nullptr),
        last_(experiment::last_tick(*run.experiment)),
        recorder_(*run.experiment, controllers_, Recorder::Truths::given, last_, run.topics),
        walk_(plant::FlatLeg(setup), {controllers_.boards().each().front(), period()},
              {.last = last_,
               .first_sample = recorder_.next(0),
               .sample_period = recorder_.period()}) {}

  const BatchedRun& run() const { return run_; }
  const Walk& walk() const { return walk_; }
  Controllers& controllers() { return controllers_; }
  std::vector<Column> columns() const { return recorder_.columns(); }
  bool records_edges() const { return recorder_.records_edges(); }
  Tick last() const { return last_; }
  std::int32_t samples() const { return static_cast<std::int32_t>(last_ / recorder_.period() + 2); }
  std::int32_t edges() const {
    return static_cast<std::int32_t>(8 * controllers_.most_edges(last_));
  }
  // Its commands are those of this plan, at this place among all.
  void set_plan(std::shared_ptr<const PlanTable> plan, std::int64_t first) {
    plan_ = std::move(plan);
    walk_.set_plan(
        first, {nullptr, static_cast<std::int64_t>(plan_->commands().size()), plan_->vents_at()});
  }

  // Returns its outcome after the launch; nothing if it did not end as planned.
  std::optional<Outcome> outcome(const Walk& ended, const Batched& batched, std::size_t number);

 private:
  std::uint16_t period() const { return controllers_.scan().period; }
  void show(const Shown& shown) {
    controllers_.boards().show(shown.controller, shown.supervised,
                               {0, std::numeric_limits<Tick>::max()});
  }

  BatchedRun run_;
  Controllers controllers_;
  Tick last_;
  Recorder recorder_;
  Walk walk_;
  std::shared_ptr<const PlanTable> plan_;
};

std::optional<Outcome> Prepared::outcome(const Walk& ended, const Batched& batched,
                                         std::size_t number) {
  const control::Supervisor& supervisor = ended.board().supervisor;
  if (!ended.complete() || ended.status() != signals::Status::ok || ended.leg().failure() ||
      supervisor.state().fault != signals::Status::ok ||
      supervisor.supervised().trip.cause != control::Trip::Cause::none)
    return {};

  const std::size_t runs = batched.walks.size(), words = batched.wanted.size();
  std::array<std::uint64_t, words_of<Shown>> sample{};
  plant::Truths truths;
  Shown shown{};
  Tick t = ended.first_sample();
  for (std::int32_t s = 0; s < ended.samples(); ++s, t += recorder_.period()) {
    const std::size_t row = static_cast<std::size_t>(s) * words;
    for (std::size_t w = 0; w < words; ++w)
      sample[batched.wanted[w]] = batched.sample[(row + w) * runs + number];
    std::memcpy(static_cast<void*>(&shown), sample.data(), sizeof shown);
    truths.robot = shown.truth;
    show(shown);
    recorder_.sample(t, truths, plan_->desired_at(t));
  }
  for (std::int32_t k = 0; k < ended.edges(); ++k)
    recorder_.edge(PackedEdge::unpack(batched.edge[static_cast<std::size_t>(k) * runs + number]));

  show({{}, supervisor.state(), supervisor.supervised()});
  Outcome out{.status = ended.status()};
  add_end(*run_.experiment, controllers_, &recorder_, last_, out);
  out.unreachable_periods = plan_->unreachable_periods();
  out.nodes = ended.leg().nodes();
  return out;
}

// Returns the run, if a batch can hold it. What run() would throw is left to run().
std::unique_ptr<Prepared> prepare(const BatchedRun& run) {
  try {
    const Experiment& e = *run.experiment;
    if (!fits_batch(e)) return nullptr;
    return std::make_unique<Prepared>(run, planar_setup(e));
  } catch (const std::exception&) {
    return nullptr;
  }
}

// What all columns of the runs depend on, ascending.
std::vector<std::uint16_t> wanted_words(std::span<Prepared* const> runs) {
  std::map<std::vector<std::string>, bool> seen;  // names of the columns
  std::vector<std::uint16_t> all;
  for (Prepared* run : runs) {
    const std::vector<Column> columns = run->columns();
    std::vector<std::string> names;
    for (const Column& column : columns) names.push_back(column.topic.name);
    if (!seen.try_emplace(std::move(names), true).second) continue;
    Controllers controllers(*run->run().experiment, nullptr);
    const std::vector<std::uint16_t> more = words_behind(columns, controllers);
    all.insert(all.end(), more.begin(), more.end());
  }
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  return all;
}

// Gives each run its table of commands, and returns all of them.
std::vector<control::Command> set_plans(std::span<Prepared* const> runs, int threads) {
  std::map<std::string, std::vector<Prepared*>> sharing;
  for (Prepared* run : runs) sharing[run->run().plan].push_back(run);
  std::vector<std::vector<Prepared*>> groups;
  for (auto& [plan, of] : sharing) groups.push_back(std::move(of));
  std::vector<std::shared_ptr<const PlanTable>> tables(groups.size());
  host::side_by_side(
      groups.size(),
      [&](std::size_t g) {
        Prepared& first = *groups[g].front();
        tables[g] = std::make_shared<const PlanTable>(first.controllers(), first.last());
      },
      nullptr, threads);
  std::vector<control::Command> commands;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (Prepared* run : groups[g])
      run->set_plan(tables[g], static_cast<std::int64_t>(commands.size()));
    const auto& rows = tables[g]->commands();
    commands.insert(commands.end(), rows.begin(), rows.end());
  }
  return commands;
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

  const std::vector<control::Command> commands = set_plans(held, threads);
  const std::vector<std::uint16_t> wanted = wanted_words(held);
  Batched batched{.commands = commands, .wanted = wanted};
  std::vector<Walk> walks;
  for (Prepared* run : held) {
    walks.push_back(run->walk());
    batched.samples = std::max(batched.samples, run->samples());
    if (run->records_edges()) batched.edges = std::max(batched.edges, run->edges());
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
  for (std::size_t i = 0, k = 0; i < runs.size(); ++i)
    if (all[i]) out[i] = std::move(ended[k++]);
  return out;
}

}  // namespace sinew::run
