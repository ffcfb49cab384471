// run/controllers/controllers.h - what controls an experiment's machine, for the loop: boards and
// high level of a robot, or drive and schedule of a test stand.
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
  // The two levels of a robot: its boards, and what gives them set points.
  struct OfRobot {
    Boards joint;
    HighLevel gait;
  };
  // The two levels of a test stand: its drive, and the set points that it follows.
  struct OfStand {
    Drive joint;
    DriveSchedule gait;
  };

  // `steering` may be null and outlives this.
  Controllers(const experiment::Experiment& experiment, Steering* steering);
  Controllers(const Controllers&) = delete;
  Controllers& operator=(const Controllers&) = delete;

  // Calls work(joint controller, gait controller), as the loop needs them.
  template <class Work>
  auto visit(const Work& work) {
    return std::visit([&](auto& of) { return work(of.joint, of.gait); }, of_);
  }
  // Return the part's own; nullptr of the other one.
  OfRobot* robot() noexcept { return std::get_if<OfRobot>(&of_); }
  const OfRobot* robot() const noexcept { return std::get_if<OfRobot>(&of_); }
  const OfStand* stand() const noexcept { return std::get_if<OfStand>(&of_); }

  // Returns when which channel is converted, the phase, and whether tick t is what is seen.
  signals::Scan scan() const noexcept;
  control::Phase phase() const noexcept;
  bool knows(signals::Tick t) const noexcept { return !robot() || robot()->joint.knows(t); }
  // Returns the tick of the first sample where one is taken every `period`: of a robot where the
  // last law of a period has run, if it is a period of its laws.
  signals::Tick first_sample(signals::Tick period) const noexcept;
  // Returns how many edges of a valve there can be before the tick `end`.
  std::size_t most_edges(signals::Tick end) const noexcept;

  // Calls use(snapshot) with what there is at a time [s]; `truths` may be null.
  template <class Use>
  void look(double time, const plant::Truths* truths, const Use& use) const {
    if (const OfStand* of = stand())
      return use(Snapshot{.time = time, .true_of = truths, .drive = &of->joint});
    const MachineSeen seen = robot()->joint.seen();
    const gait::MachineMeasured measured = robot()->gait.believe(seen);
    use(Snapshot{.time = time,
                 .true_of = truths,
                 .seen = &seen,
                 .measured = &measured,
                 .desired = robot()->gait.desired()});
  }

  // Return the counters of all boards, and of what their supervisors rejected.
  SeenTotals seen_totals() const;
  SupervisedTotals supervised_totals() const;

  // Returns what can be changed on the way, by number; nothing of a stand.
  const std::vector<gait::Setting>& settings() const noexcept;

  // Everything that their future depends on, copied like bytes: how many they are, and both ways.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  std::variant<OfRobot, OfStand> of_;
};

}  // namespace sinew::run
