// run/simulation/simulation.h - a run that the caller controls: an experiment's machine, a robot or
// a test stand, and its controllers, advanced in any steps, read, changed, saved and restored.
//
//   Simulation s(buildable("experiments/walk-test-1.toml"));
//   s.advance_by(2.0);
//   double angle = s.read("/joint/hip/angle");
//   s.change("control.stiffness.hip", 3.0);       // from the next period start on
//   std::vector<std::byte> saved = s.save();
//   s.advance_by(1.0);
//   s.restore(saved);                             // back where it was, bit for bit
//
// The results equal those of run(), bit for bit, however the run is advanced, read and restored;
// run() is implemented with this class. Memory is allocated by the constructor, not while it
// advances.
//
// A save contains the state of the machine, the controllers, the commands in transit and the tick,
// but no log. It can be restored any number of times, also in another process, by the same
// version of the library on the same kind of computer, into a simulation of an experiment with the
// same values.
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
  // Starts a buildable experiment. `steering` may be null and must outlive this object. Throws
  // std::invalid_argument for a machine that exceeds the limits of the plant.
  explicit Simulation(const experiment::Experiment& experiment, Steering* steering = nullptr);

  // Starts the experiment with a machine in a lane of a batch.
  Simulation(const experiment::Experiment& experiment, const plant::LegLane& lane);

  // Starts the experiment's controllers with another body, for instance a recording, which must
  // outlive this object. Nothing is simulated then: there are no true values, and nothing to save.
  Simulation(const experiment::Experiment& experiment, signals::Port& body,
             Steering* steering = nullptr);

  // Starts the experiment's plan with an armed board at the end of a line, which must outlive this
  // object (remote_boards.h describes `lead`). Nothing is simulated then either.
  Simulation(const experiment::Experiment& experiment, plant::RemoteBoard& board, int lead,
             Steering* steering = nullptr);

  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // --- time ---

  // Returns the tick that it was advanced to; the events at that tick are still to come.
  signals::Tick tick() const noexcept { return tick_; }
  double time() const noexcept { return static_cast<double>(tick_) * signals::tick_seconds; }
  // Returns the next tick with an event.
  signals::Tick next() const noexcept { return loop_.at; }
  // Returns the tick of its regular end.
  signals::Tick last() const noexcept { return last_; }
  // Returns whether it has ended: the plan has ended, or something has failed.
  bool ended() const noexcept;

  // Runs all events before the tick; does nothing if it has passed.
  void advance_to(signals::Tick tick) noexcept;
  // Advances by seconds from the present tick, rounded to ticks.
  void advance_by(double seconds) noexcept;
  // Advances with a clock and a recorder (loop.h).
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
  // Leaves the body safe; returns the first status of the whole run that was not ok. To be called
  // once, at the end.
  signals::Status finish() noexcept { return run::finish(loop_, port()); }

  // --- reading: changes nothing ---

  // Names and units of everything that can be read: the channels of the log except the valves'
  // edges; "/foot/position.x" of a channel with two numbers.
  struct Channel {
    std::string name, unit;
    Column::Given given = Column::Given::always;  // when it has a value; NaN otherwise
  };
  const std::vector<Channel>& channels() const noexcept { return channels_; }
  // Returns the columns of its experiment.
  std::span<const Column> columns() const noexcept { return columns_; }
  // Return the present value of a channel, in its unit; by its number in channels(), or by its
  // name. Throw std::invalid_argument for an unknown channel.
  double read(std::size_t channel) noexcept;
  double read(std::string_view channel);
  // Writes the values of many channels, by their numbers, which is cheaper than one by one.
  // `values` and `channels` must have the same size.
  void read(std::span<const std::size_t> channels, std::span<double> values) noexcept;
  std::size_t find(std::string_view channel) const;
  // Returns whether one of these channels is a true value, to which the machine is advanced.
  bool is_true(std::span<const std::size_t> channels) const noexcept;

  // Return the true values now. Requires a simulated body.
  const plant::Truths& truths() noexcept;
  const plant::Truth& truth() noexcept { return truths().robot; }
  // Returns the part of the machine that was not finite, if any.
  air::Failure failure() const noexcept;
  // Returns why it ended before its plan; empty if it did not.
  std::string cause() const;

  // --- changing ---

  // Override a gain, stiffness or angle of the plan ("control.stiffness.hip", in SI) from the
  // start of the next period on, which may be this tick, or release it to the plan. An empty `leg`
  // means all legs. Throw std::invalid_argument for an unknown key or leg, or an invalid value.
  void change(std::string_view key, double value, std::string_view leg = {});
  void change(std::size_t setting, double value);  // for all legs, by the number in settings()
  void release(std::string_view key, std::string_view leg = {});
  const std::vector<gait::Setting>& settings() const noexcept { return controllers_.settings(); }
  // Returns the present value of a setting, by its number, whether planned or overridden, for the
  // first leg [its SI unit].
  double value_of(std::size_t setting) const noexcept {
    return gait::value_of(settings()[setting], controllers_.gait()->desired().front());
  }
  // Returns the number of a setting by its key; throws like change().
  std::size_t find_setting(std::string_view key) const;

  // --- saving ---

  // Returns the complete state as bytes.
  std::vector<std::byte> save();
  std::size_t save_size() const noexcept;
  // Throws std::invalid_argument, without changes, if the bytes are no save, incomplete or
  // corrupted, or belong to another experiment or version.
  void restore(std::span<const std::byte> saved);

  // --- the parts, for recorders ---

  // Return the experiment, its controllers, and a remote board and the simulated machine, nullptr
  // if they do not exist.
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
  void request_change(std::size_t setting, double value, int leg);
  int leg_number(std::string_view leg) const;  // -1: all legs
  std::uint64_t model();

  experiment::Experiment experiment_;
  std::optional<plant::Machine> machine_;
  std::optional<FaultyPort> faulty_;
  signals::Port* port_ = nullptr;
  Controllers controllers_;
  std::optional<RemoteBoards> remote_;  // its state is shown by the controllers' boards
  signals::Tick last_ = 0, tick_ = 0;
  LoopState loop_;

  std::vector<Column> columns_;
  std::vector<Channel> channels_;
  std::vector<std::pair<std::size_t, std::size_t>> column_of_;  // column, and number within it
  std::optional<std::uint64_t> model_;                          // calculated when first needed
  plant::Truths truths_;                                        // those read last
};

}  // namespace sinew::run
