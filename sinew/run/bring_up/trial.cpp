#include "sinew/run/bring_up/trial.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/control/link/texts.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

using signals::Tick;

namespace {

constexpr double edge = 0.05;  // [s] part at both ends of a stage over which means are taken

double mean(const std::vector<Sample>& samples, std::size_t channel, double from, double to) {
  double sum = 0;
  int n = 0;
  for (const Sample& s : samples)
    if (s.time >= from && s.time <= to) {
      sum += s.counts[channel];
      ++n;
    }
  return n > 0 ? sum / n : std::nan("");
}

// Throws if the board has no sensors or those of another robot, as it does after a reset.
Sample sample_of(const link::Telemetry& telemetry, std::size_t channels, double time) {
  if (telemetry.channels != channels)
    throw plant::BoardError(
        fmt::format("the board reports {} sensors; expected {}: it was reset, or another program "
                    "is at its line; the same command continues from here",
                    telemetry.channels, channels));
  Sample out{.time = time};
  for (std::size_t i = 0; i < telemetry.channels; ++i) {
    out.counts.push_back(telemetry.controller.reading[i].counts);
    out.status.push_back(telemetry.controller.reading[i].status);
  }
  return out;
}

link::CommandFor command_of(const Stage& stage, std::size_t joints, Tick from) {
  constexpr std::uint8_t good_for = 3;  // [periods] a frame may be lost, and the next one as well
  link::CommandFor out{
      .from = from, .periods = good_for, .joints = static_cast<std::uint8_t>(joints)};
  for (std::size_t j = 0; j < joints; ++j) {
    control::JointCommand& c = out.joint[j];
    c.enabled = c.open_loop = true;
    if (j < stage.duties.size()) c.duties = stage.duties[j];
  }
  return out;
}

// A run in progress, from command to command.
class Run {
 public:
  Run(plant::RemoteBoard& board, const link::Configuration& configuration, int lead)
      : board_(&board),
        joints_(configuration.joint_controller.joints),
        channels_(link::channels_of(configuration.joint_controller)),
        period_(configuration.joint_controller.period),
        lead_(lead) {}

  // Executes a stage. Returns false if the run has ended.
  bool run_stage(const Stage& stage, Recording& out, const std::function<bool()>& stops) {
    const Tick begun = now_;
    for (;;) {
      const double time = signals::tick_seconds * static_cast<double>(now_ - begun);
      if (time >= stage.seconds - 1e-9) return true;
      if (stops && stops()) {
        (void)board_->shut_down();
        throw Stopped{};
      }
      if (!send(command_of(stage, joints_, now_ == 0 ? 0 : now_ + lead_ * period_)) ||
          !next_telemetry())
        return false;
      out.samples.push_back(
          sample_of(*telemetry_, channels_, time + signals::tick_seconds * period_));
      if (stage.ends && stage.ends(out.samples.back())) return true;
    }
  }
  // Ends the run. Returns whether the board has reported that it is at rest.
  bool end() {
    link::CommandFor last = command_of({}, joints_, now_ + lead_ * period_);
    last.ends = true;
    if (!send(last)) return false;
    // A vent may take as long as the safety's limit, and telemetry continues meanwhile.
    constexpr double longest = 30;  // [s]
    for (const double until = board_->now() + longest; next_telemetry();)
      if (board_->now() >= until) return false;
    return board_->why() == plant::RemoteBoard::Why::over;
  }
  std::string problem() const {
    using Why = plant::RemoteBoard::Why;
    if (board_->why() == Why::over && board_->fault() != control::BoardFault::none)
      return link::to_text(board_->fault());
    if (board_->why() == Why::closed) return "the line to the board is gone";
    return "the board is not heard any more";
  }

 private:
  bool send(const link::CommandFor& command) { return board_->command(command); }
  bool next_telemetry() {
    constexpr double silence = 1.5;  // [s]
    const double until = board_->now() + silence;
    do {
      telemetry_ = board_->next(until - board_->now());
    } while (telemetry_ != nullptr && telemetry_->tick <= now_);
    if (telemetry_ != nullptr) now_ = telemetry_->tick;
    return telemetry_ != nullptr;
  }

  plant::RemoteBoard* board_;
  std::size_t joints_, channels_;
  Tick period_, lead_, now_ = 0;
  const link::Telemetry* telemetry_ = nullptr;
};

}  // namespace

double Recording::before(std::size_t channel) const { return mean(samples, channel, 0, edge); }

double Recording::after(std::size_t channel) const {
  return mean(samples, channel, seconds() - edge, seconds());
}

Trial run_trial(plant::RemoteBoard& board, const link::Configuration& configuration, int lead,
                const std::vector<Stage>& stages, End end, const std::function<bool()>& stops) {
  const std::string found = plant::fault_found(board.prepare(configuration));
  Run run(board, configuration, lead);
  Trial out{.found = found};
  out.stages.resize(stages.size());
  for (std::size_t i = 0; i < stages.size(); ++i)
    if (!run.run_stage(stages[i], out.stages[i], stops)) {
      out.problem = run.problem();
      return out;
    }
  if (end == End::at_once ? !board.shut_down() : !run.end()) out.problem = run.problem();
  return out;
}

Recording listen(plant::RemoteBoard& board, const link::Configuration& configuration,
                 double seconds) {
  const double period = signals::tick_seconds * configuration.joint_controller.period;
  const auto wait_for_telemetry = [&] {
    const link::Telemetry* telemetry = board.wait_for_telemetry(1.0);
    if (telemetry == nullptr)
      throw plant::BoardError("the board does not report what its sensors read");
    return telemetry;
  };
  // The scan restarts somewhere within a period: that period lacks the earlier conversions, and one
  // more period may have been on the line already.
  for (int i = 0; i < 2; ++i) (void)wait_for_telemetry();
  Recording out;
  while (out.seconds() < seconds) {
    const link::Telemetry* telemetry = wait_for_telemetry();
    const double time = period * static_cast<double>(out.samples.size());
    out.samples.push_back(
        sample_of(*telemetry, link::channels_of(configuration.joint_controller), time));
  }
  return out;
}

}  // namespace sinew::run
