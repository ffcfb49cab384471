// run/simulation/simulation.h - a run that a caller holds: an experiment's machine, a robot or a
// test stand, and its controllers, advanced by any amount, read, changed, saved and restored.
//
//   Simulation s(buildable("experiments/walk-test-1.toml"));
//   s.advance_by(2.0);
//   double angle = s.read("/joint/hip/angle");
//   s.change("control.stiffness.hip", 3.0);       // from the next period start on
//   std::vector<std::byte> saved = s.save();
//   s.advance_by(1.0);
//   s.restore(saved);                             // back where it was, bit for bit
//
// However it is cut into advances, read and restored: the same bits as run(), which is written on
// it. Memory is taken when it is made, not while it advances.
//
// A save is the state of the machine, the controllers, the commands on their way and the tick; no
// log. It can be restored any number of times, also in another process, by the same version of the
// library on the same kind of computer, into a simulation of an experiment with the same values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/controllers/controllers.h"
#include "sinew/run/simulation/faulty_port.h"
#include "sinew/run/simulation/loop.h"
#include "sinew/run/simulation/remote_boards.h"
#include "sinew/world/machine.h"

namespace sinew::run {

class Simulation {
 public:
  // The experiment, a buildable one, at its start. `steering` may be null and outlives this. Throws
  // std::invalid_argument for a machine that no plant can hold.
  explicit Simulation(const experiment::Experiment& experiment, Steering* steering = nullptr);

  // The experiment in a machine that goes side by side with others, at its start.
  Simulation(const experiment::Experiment& experiment, const plant::LegLane& lane);

  // The experiment's controllers before another body, which outlives this: a recorded one, for
  // instance. Nothing is simulated then: no truth, and nothing to save.
  Simulation(const experiment::Experiment& experiment, signals::Port& body,
             Steering* steering = nullptr);

  // The experiment's plan before a board at the end of a line, which is armed and outlives this
  // (remote_boards.h has `lead`). Nothing is simulated then either.
  Simulation(const experiment::Experiment& experiment, plant::RemoteBoard& board, int lead,
             Steering* steering = nullptr);

  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // --- time ---

  // The tick that it has been advanced to: what happens at it has not happened yet.
  signals::Tick tick() const noexcept { return tick_; }
  double time() const noexcept { return static_cast<double>(tick_) * signals::tick_seconds; }
  // The next tick at which anything happens.
  signals::Tick next() const noexcept { return loop_.at; }
  // The tick at which it ends, if nothing ends it before.
  signals::Tick last() const noexcept { return last_; }
  // Is there nothing left to advance? The plan has come to its end, or something has failed.
  bool ended() const noexcept;

  // Runs all that happens before the tick; an earlier one changes nothing.
  void advance_to(signals::Tick tick) noexcept;
  // Advances by seconds from where it stands, rounded to ticks.
  void advance_by(double seconds) noexcept;
  // Advances under a clock, and with somebody who records (loop.h).
  template <class Clock, class Watch>
  void advance(signals::Tick until, Clock& clock, Watch& watch) noexcept {
    if (tick_ < last_ && until > tick_) {
      until = until < last_ ? until : last_;
      controllers_.visit([&](auto& high_level) {
        if (remote_)
          run::advance(loop_, *remote_, high_level, port(), clock, watch, until);
        else
          run::advance(loop_, controllers_.boards(), high_level, port(), clock, watch, until);
      });
      tick_ = loop_.at < until ? loop_.at : until;
      if (remote_ && tick_ == last_)
        for (const signals::Edge& edge : remote_->last_edges(last_)) watch.edge(edge);
    }
  }
  // Leaves the body safe; answers the first status of the whole run that was not ok. Once, when no
  // more is to come.
  signals::Status finish() noexcept { return run::finish(loop_, port()); }

  // --- looking: changes nothing ---

  // Names of all that can be read, with their units: the channels of the log but the valves' edges;
  // "/foot/position.x" of one with two numbers.
  struct Channel {
    std::string name, unit;
    Column::Given given = Column::Given::always;  // when it has a value; NaN else
  };
  const std::vector<Channel>& channels() const noexcept { return channels_; }
  // Value of a channel now, in its unit; by its number in channels(), or by its name. Throws
  // std::invalid_argument for a channel that there is not.
  double read(std::size_t channel) noexcept;
  double read(std::string_view channel);
  // Values of many channels, by their numbers, at once: cheaper than one by one. `values` is as
  // long as `channels`.
  void read(std::span<const std::size_t> channels, std::span<double> values) noexcept;
  std::size_t find(std::string_view channel) const;

  // Return the true values now. The body has to be a simulated one.
  const plant::Truths& truths() noexcept;
  const plant::Truth& truth() noexcept { return truths().robot; }
  // Returns what of the machine was no number any more.
  air::Failure failure() const noexcept;
  // Returns why it has ended before its plan did, in words; empty where it has not.
  std::string cause() const;

  // --- changing ---

  // Sets gain, stiffness or angle in place of the plan's ("control.stiffness.hip", in SI) from the
  // next period start on, which may be this tick; and gives it back to the plan. `leg`: whose;
  // empty: every leg's. Throws std::invalid_argument for a key or a leg that there is not, or a
  // value that it cannot have.
  void change(std::string_view key, double value, std::string_view leg = {});
  void change(std::size_t setting, double value);  // by its number in settings(), of every leg
  void release(std::string_view key, std::string_view leg = {});
  const std::vector<gait::Setting>& settings() const noexcept { return controllers_.settings(); }
  // Returns what a setting, by its number, is at now, the plan's or what was set in its place; of
  // the first leg  [its SI unit].
  double value_of(std::size_t setting) const noexcept {
    return gait::value_of(settings()[setting], controllers_.gait()->desired().front());
  }
  // Returns the number of a setting by its key; throws as change() does.
  std::size_t find_setting(std::string_view key) const;

  // --- saving ---

  // Everything that the future depends on, as bytes.
  std::vector<std::byte> save();
  std::size_t save_size() const noexcept;
  // Throws std::invalid_argument, and changes nothing, for what is no save, is cut off or spoilt,
  // or is of another experiment or another version.
  void restore(std::span<const std::byte> saved);

  // --- the parts, for whoever records ---

  // Returns what is run; what controls it; a board far away and the simulated machine, nullptr
  // where there is none.
  const experiment::Experiment& experiment() const noexcept { return experiment_; }
  const Controllers& controllers() const noexcept { return controllers_; }
  const RemoteBoards* remote() const noexcept { return remote_ ? &*remote_ : nullptr; }
  plant::Machine* machine() noexcept { return machine_ ? &*machine_ : nullptr; }

 private:
  // `machine` is a setup or a lane.
  template <class Machine>
  Simulation(const experiment::Experiment& experiment, const Machine& machine, Steering* steering);

  signals::Port& port() noexcept { return *port_; }
  void list_channels();
  void wish(std::size_t setting, double value, int leg);
  int leg_number(std::string_view leg) const;  // -1: every leg's
  std::uint64_t model();

  experiment::Experiment experiment_;
  std::optional<plant::Machine> machine_;
  std::optional<FaultyPort> faulty_;
  signals::Port* port_ = nullptr;
  Controllers controllers_;
  std::optional<RemoteBoards> remote_;  // shown by the controllers' boards
  signals::Tick last_ = 0, tick_ = 0;
  LoopState loop_;

  std::vector<Column> columns_;
  std::vector<Channel> channels_;
  std::vector<std::pair<std::size_t, std::size_t>> column_of_;  // and which of its numbers
  std::optional<std::uint64_t> model_;                          // once it was needed
  plant::Truths truths_;                                        // the last ones
};

}  // namespace sinew::run
