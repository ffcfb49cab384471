#include "sinew/run/simulation/wired_body.h"

#include "sinew/control/supervise/output_stage.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/remote_boards.h"

namespace sinew::run {

using signals::Reading;
using signals::Tick;

WiredBody::WiredBody(const experiment::Experiment& experiment)
    : experiment_(experiment),
      board_(only_board(experiment)),
      scan_(std::span(&board_, 1)),
      inverted_(control::OutputStage(board_.joint_controller, 0).inverted()),
      machine_(machine_setup(experiment)),
      port_(&machine_.port()),
      last_(at_rest()) {
  if (!experiment_.faults.empty()) port_ = &faulty_.emplace(experiment_, *port_);
}

// Returns the readings of one scan of an undriven machine: sensors are constant before a run.
std::vector<Reading> WiredBody::at_rest() const {
  plant::Machine machine(machine_setup(experiment_));
  std::vector<Reading> out(board_.channel.size());
  if (machine.port().start(scan_.scan()) != signals::Status::ok) return out;
  for (std::size_t i = 0; i < board_.joint_controller.conversions; ++i) {
    const signals::Conversion& c = board_.joint_controller.conversion[i];
    out[c.channel.index] = machine.port().read({board_.channel[c.channel.index]}, c.read);
  }
  return out;
}

plant::Wires WiredBody::wires() {
  return {[this](Tick tick, std::uint32_t open, bool current) { valves(tick, open, current); },
          [this](signals::Channel channel, Tick tick) { return read(channel, tick); }};
}

void WiredBody::start() {
  if (!started_) (void)port_->start(scan_.scan());
  started_ = true;
}

// Returns the body's time at a tick of a run. Each run continues at the state of the body after the
// previous one.
Tick WiredBody::at(Tick run) {
  start();
  if (begun_ + run < now_) begun_ = now_ - run;
  return now_ = begun_ + run;
}

void WiredBody::drive(Tick tick, std::uint32_t changed, std::uint32_t open) {
  for (std::uint8_t i = 0; i < board_.valve.size(); ++i)
    if (changed >> i & 1u) (void)port_->drive({tick, {board_.valve[i]}, (open >> i & 1u) != 0, 0});
}

// Applies the board's outputs. Closing edges of a tick come first. Without current an inverted
// valve is open, every other one shut. The body's time stands still between runs, when a board that
// was reset switches its coils off.
void WiredBody::valves(Tick tick, std::uint32_t open, bool current) {
  if (tick < 0 && !started_) return;
  tick = tick < 0 ? now_ : at(tick);
  if (!current) open = inverted_;
  drive(tick, open_ & ~open, open);
  drive(tick, open & ~open_, open);
  open_ = open;
}

Reading WiredBody::read(signals::Channel channel, Tick tick) {
  if (channel.index >= last_.size()) return {0, signals::Status::invalid};
  Reading& last = last_[channel.index];
  if (tick >= 0) last = port_->read({board_.channel[channel.index]}, at(tick));
  return last;
}

}  // namespace sinew::run
