// run/controllers/controllers.h - the controllers of an experiment's machine, as the loop uses
// them: its boards, and above them the high level of a robot or the drive of a test stand.
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
  // `steering` may be null and must outlive this object.
  Controllers(const experiment::Experiment& experiment, Steering* steering);
  Controllers(const Controllers&) = delete;
  Controllers& operator=(const Controllers&) = delete;

  // Calls work(high level) with the HighLevel of a robot or the Drive of a stand.
  template <class Work>
  auto visit(const Work& work) {
    return std::visit(work, high_level_);
  }
  Boards& boards() noexcept { return boards_; }
  const Boards& boards() const noexcept { return boards_; }
  // Return the high level of a robot, and that of a stand; nullptr if the machine is the other
  // kind.
  HighLevel* gait() noexcept { return std::get_if<HighLevel>(&high_level_); }
  const HighLevel* gait() const noexcept { return std::get_if<HighLevel>(&high_level_); }
  const Drive* drive() const noexcept { return std::get_if<Drive>(&high_level_); }

  // Returns the scan of conversions.
  signals::Scan scan() const noexcept { return boards_.scan(); }
  // Returns the tick of the first sample if one is taken every `period`. For a robot it is that of
  // the scan's last reading, at which the last law runs, or the next multiple of `period` if that
  // is no multiple of the scan's: earlier there are no readings. For a stand it is 0.
  signals::Tick first_sample(signals::Tick period) const noexcept;
  // Returns the largest number of edges that a valve can have before the tick `end`.
  std::size_t most_edges(signals::Tick end) const noexcept;

  // Calls use(snapshot) with the state at a time [s]; `truths` may be null.
  template <class Use>
  void with_snapshot(double time, const plant::Truths* truths, const Use& use) const {
    const MachineState state = boards_.state();
    Snapshot snapshot{.time = time, .true_of = truths, .controller = &state, .drive = drive()};
    if (snapshot.drive != nullptr) return use(snapshot);
    const gait::MachineMeasured measured = gait()->measure(state);
    snapshot.measured = &measured;
    snapshot.desired = gait()->desired();
    use(snapshot);
  }

  // Returns the settings that can be changed during a run, by number; empty for a stand.
  const std::vector<gait::Setting>& settings() const noexcept;

  // Return the size of the complete state in bytes; copy it out and in.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  Boards boards_;
  std::variant<HighLevel, Drive> high_level_;
};

}  // namespace sinew::run
