// run/simulation/faulty_port.h - a body whose sensors lie as the experiment's [[fault]] says. What
// moves, moves as it does without; only what read() answers differs. Faults of the air are the
// body's own.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/port.h"

namespace sinew::run {

// Noise and dropouts are hashes of (seed, fault, tick): the same in every run, however it is
// looked at.
class FaultyPort final : public signals::Port {
 public:
  // `body` outlives it. Every fault's sensor is there; faults of the air are passed over.
  FaultyPort(const experiment::Experiment& experiment, signals::Port& body);

  signals::Status start(const signals::Scan& scan) noexcept override { return body_.start(scan); }
  signals::Status drive(signals::Edge edge) noexcept override { return body_.drive(edge); }
  signals::Reading read(signals::Channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override { return body_.stop(now); }

  // The last counts of each channel that were handed out. Copied like bytes.
  struct State {
    std::array<std::uint16_t, robot::max_sensors> before{};
    std::array<bool, robot::max_sensors> answered{};
  };
  State state() const noexcept { return {before_, answered_}; }
  void restore(const State& state) noexcept {
    before_ = state.before;
    answered_ = state.answered;
  }

 private:
  struct Acting {
    experiment::Fault fault;
    std::size_t index = 0;  // in the experiment's list
    std::uint8_t channel = 0;
  };

  double drawn(std::size_t fault, signals::Tick now) const noexcept;
  signals::Reading spoil(const Acting&, signals::Reading, signals::Tick now) const noexcept;

  signals::Port& body_;
  std::vector<Acting> faults_;
  std::uint64_t seed_;
  double top_;                                              // of the converter [count]
  std::array<std::uint16_t, robot::max_sensors> before_{};  // last counts handed out
  std::array<bool, robot::max_sensors> answered_{};
};

}  // namespace sinew::run
