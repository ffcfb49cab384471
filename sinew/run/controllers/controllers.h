// run/controllers/controllers.h - what controls an experiment's machine, for the loop: its boards,
// and above them the high level of a robot or the drive of a test stand.
#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/boards.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/controllers/drive.h"
#include "sinew/run/controllers/high_level.h"

namespace sinew::run {

class Controllers {
 public:
  // `steering` may be null and outlives this.
  Controllers(const experiment::Experiment& experiment, Steering* steering);
  Controllers(const Controllers&) = delete;
  Controllers& operator=(const Controllers&) = delete;

  // Calls work(high level) with that of the robot or of the stand.
  template <class Work>
  auto visit(const Work& work) {
    return std::visit(work, high_level_);
  }
  // Returns the boards.
  Boards& boards() noexcept { return boards_; }
  // Return the high level of a robot, and that of a stand; nullptr if the machine is the other one.
  HighLevel* gait() noexcept { return std::get_if<HighLevel>(&high_level_); }
  const HighLevel* gait() const noexcept { return std::get_if<HighLevel>(&high_level_); }
  const Drive* drive() const noexcept { return std::get_if<Drive>(&high_level_); }

  // Returns when which channel is converted, the phase, and whether tick t is what is seen.
  signals::Scan scan() const noexcept { return boards_.scan(); }
  control::Phase phase() const noexcept { return boards_.seen().phase; }
  bool knows(signals::Tick t) const noexcept { return boards_.knows(t); }
  // Returns the tick of the first sample where one is taken every `period`: of a robot where the
  // last law of a period has run, if it is a period of its laws.
  signals::Tick first_sample(signals::Tick period) const noexcept;
  // Returns how many edges of a valve there can be before the tick `end`.
  std::size_t most_edges(signals::Tick end) const noexcept;

  // Calls use(snapshot) with what there is at a time [s]; `truths` may be null.
  template <class Use>
  void look(double time, const plant::Truths* truths, const Use& use) const {
    const MachineSeen seen = boards_.seen();
    Snapshot snapshot{.time = time, .true_of = truths, .seen = &seen, .drive = drive()};
    if (snapshot.drive != nullptr) return use(snapshot);
    const gait::MachineMeasured measured = gait()->believe(seen);
    snapshot.measured = &measured;
    snapshot.desired = gait()->desired();
    use(snapshot);
  }

  // Return the counters of all boards, and of what their supervisors rejected.
  SeenTotals seen_totals() const { return boards_.seen_totals(); }
  SupervisedTotals supervised_totals() const { return boards_.supervised_totals(); }

  // Returns what can be changed on the way, by number; nothing of a stand.
  const std::vector<gait::Setting>& settings() const noexcept;

  // Everything that their future depends on, copied like bytes: how many they are, and both ways.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  Boards boards_;
  std::variant<HighLevel, Drive> high_level_;
};

}  // namespace sinew::run
