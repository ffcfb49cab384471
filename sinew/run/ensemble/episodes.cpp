#include "sinew/run/ensemble/episodes.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sinew/host/side_by_side.h"
#include "sinew/run/ensemble/many.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/run/simulation/node_bounds.h"
#include "sinew/world/batch.h"

namespace sinew::run {

using signals::Tick;

// One episode: by itself, or in a lane of a batch.
class Episodes::Running {
 public:
  // Sets the run that the next step begins, and takes it.
  void set_next(std::unique_ptr<Ensemble::Member> next) { next_ = std::move(next); }
  std::unique_ptr<Ensemble::Member> take_next() { return std::move(next_); }

  void begin(std::shared_ptr<const Episode> episode, std::unique_ptr<Simulation> simulation,
             bool in_lane) {
    episode_ = std::move(episode);
    simulation_ = std::move(simulation);
    bounds_.reset();
    if (in_lane) bounds_.emplace();
    begins_ = true;
  }
  void end() { simulation_.reset(); }

  bool has_begun() const { return simulation_ || next_; }
  bool in_lane() const { return bounds_.has_value(); }
  bool ended() const { return simulation_->ended(); }
  std::string cause() const { return simulation_ ? simulation_->cause() : ""; }

  // Runs a step by itself.
  void step(std::span<const double> action) {
    if (begins_)
      episode_->begin(*simulation_);
    else
      episode_->step(*simulation_, action);
    begins_ = false;
  }

  // Prepares a step in a lane; turn() then runs it.
  void prepare(std::span<const double> action) {
    const Tick now = simulation_->tick();
    action_ = action;
    visits_ = commits_ = false;
    end_ = begins_ ? episode_->first() : now + episode_->length();
    next_part_ = begins_ ? end_ : now;
    acts_ = !begins_;
    begins_ = false;
  }

  // Visits the tick up to which the machine's nodes are committed. Returns the time to which they
  // must be committed for the next one, or Batch::finished after the step.
  double turn() noexcept {
    Simulation& s = *simulation_;
    if (visits_) s.advance_to(s.next() + 1);
    visits_ = true;
    while (s.ended() || s.next() >= std::min(next_part_, s.last())) {
      s.advance_to(next_part_);  // also after an early end, whose tick is the next one then
      if (s.tick() >= end_ || s.ended()) return last_nodes();
      if (acts_) episode_->act(s, action_);
      next_part_ += episode_->part();
    }
    return bounds_->before(s.controllers().scan(), s.next(), false,
                           s.controllers().boards().drives_at(s.next()));
  }

  void observe(std::span<double> observed, std::span<double> measured) {
    episode_->observe(*simulation_, observed, measured);
  }

 private:
  // Commits the nodes that observe() needs together with those of the other lanes.
  double last_nodes() noexcept {
    const bool commits = !std::exchange(commits_, true) && episode_->observes_truths(*simulation_);
    visits_ = false;
    return commits ? simulation_->time() : plant::Batch::finished;
  }

  std::unique_ptr<Ensemble::Member> next_;
  std::shared_ptr<const Episode> episode_;
  std::unique_ptr<Simulation> simulation_;
  std::optional<NodeBounds> bounds_;  // in a lane
  bool begins_ = false;               // its next step is the run to the first step's start

  // The present step in a lane.
  std::span<const double> action_;
  Tick end_ = 0, next_part_ = 0;
  bool acts_ = false, visits_ = false, commits_ = false;
};

// A batch of machines, lane k for its episode k.
class Episodes::Group {
 public:
  Group(int lanes, const plant::Setup& like) : like_(like), batch_(lanes, like) {}

  std::size_t width() const { return static_cast<std::size_t>(batch_.width()); }
  bool takes(const plant::Setup& setup) const {
    return plant::Batch::fits(setup) && plant::Batch::alike(setup, like_);
  }
  // Puts a machine at its start into lane k.
  plant::LegLane put(std::size_t k, const plant::Setup& setup) {
    batch_.replace(static_cast<int>(k), setup);
    batch_.park(static_cast<int>(k));
    return {batch_, static_cast<int>(k)};
  }

  // Runs the prepared steps of these episodes, of which those without a machine here are null.
  void run(std::span<Running* const> running) {
    for (std::size_t k = 0; k < running.size(); ++k)
      if (running[k] != nullptr) batch_.resume(static_cast<int>(k));
    const auto turn = [&](int k) noexcept { return running[static_cast<std::size_t>(k)]->turn(); };
    while (batch_.run(turn) >= 0) {}
  }

 private:
  plant::Setup like_;
  plant::Batch batch_;
};

Episodes::Episodes(std::shared_ptr<const Episode> definition,
                   std::shared_ptr<const Ensemble> ensemble, std::size_t count, int threads)
    : definition_(std::move(definition)),
      ensemble_(std::move(ensemble)),
      threads_(host::threads_of(threads)) {
  for (std::size_t i = 0; i < count; ++i) episodes_.push_back(std::make_unique<Running>());
  const experiment::Experiment& like = ensemble_->example();
  const int lanes = lanes_of(count, static_cast<std::size_t>(threads_), widest_lanes());
  if (lanes <= 2 || like.stand || !plant::Batch::fits(planar_setup(like))) return;
  while (groups_.empty() || groups_.size() * groups_[0]->width() < count)
    groups_.push_back(std::make_unique<Group>(lanes <= 4 ? 4 : 8, planar_setup(like)));
}

Episodes::~Episodes() = default;

std::size_t Episodes::width() const { return groups_.empty() ? 1 : groups_[0]->width(); }

void Episodes::begin(std::size_t i, int seed, std::span<const double> values) {
  Running& one = *episodes_.at(i);
  std::unique_ptr<Ensemble::Member> member = ensemble_->member(values);
  member->experiment.seed = seed;
  one.set_next(std::move(member));
}

// Starts the run that begins, in its lane if that holds it.
void Episodes::start(std::size_t i) {
  Running& one = *episodes_[i];
  std::unique_ptr<Ensemble::Member> member = one.take_next();
  if (!member) return;
  const experiment::Experiment& e = member->experiment;
  one.end();
  Group* const group = groups_.empty() ? nullptr : groups_[i / width()].get();
  const plant::Setup setup = group == nullptr || e.stand ? plant::Setup{} : planar_setup(e);
  const bool in_lane = group != nullptr && !e.stand && group->takes(setup);
  auto simulation = in_lane ? std::make_unique<Simulation>(e, group->put(i % width(), setup))
                            : std::make_unique<Simulation>(e);
  std::shared_ptr<const Episode> episode = definition_;
  if (parameters() > 0) episode = std::make_shared<const Episode>(definition_->of(*simulation));
  one.begin(std::move(episode), std::move(simulation), in_lane);
  ensemble_->keep(std::move(member));
}

void Episodes::step(std::span<const double> actions, const Results& results) {
  for (const auto& one : episodes_)
    if (!one->has_begun())
      throw std::invalid_argument(
          "episodes: found one that has not begun; expected begin() before");
  host::side_by_side((count() + width() - 1) / width(),
                     [&](std::size_t g) { step_group(g, actions, results); }, nullptr, threads_);
}

// Steps the episodes of a batch, or one that is by itself.
void Episodes::step_group(std::size_t g, std::span<const double> actions, const Results& results) {
  const Episode& like = *definition_;
  const std::size_t first = g * width(), end = std::min(count(), first + width());
  std::vector<Running*> in_lanes;
  for (std::size_t i = first; i < end; ++i) {
    start(i);
    Running& one = *episodes_[i];
    const std::span<const double> action = actions.subspan(i * like.actions(), like.actions());
    const bool in_lane = one.in_lane() && !one.ended();
    in_lanes.push_back(in_lane ? &one : nullptr);
    if (in_lane)
      one.prepare(action);
    else if (!one.ended())
      one.step(action);
  }
  if (!groups_.empty()) groups_[g]->run(in_lanes);
  for (std::size_t i = first; i < end; ++i) {
    Running& one = *episodes_[i];
    one.observe(results.observed.subspan(i * like.observations(), like.observations()),
                results.measured.subspan(i * like.measures(), like.measures()));
    results.ended[i] = one.ended();
    results.failed[i] = one.ended() && !one.cause().empty();
  }
}

std::string Episodes::cause(std::size_t i) const { return episodes_.at(i)->cause(); }

}  // namespace sinew::run
