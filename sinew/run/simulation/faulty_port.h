// run/simulation/faulty_port.h - a body with sensor faults, as in the experiment's [[fault]]. Its
// motion is unaffected; only the readings of read() differ. Faults of the air act in the body.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/port.h"

namespace sinew::run {

// Noise and dropouts are hashes of (seed, fault, tick), so that they are the same in every run,
// independent of the times of other readings.
class FaultyPort final : public signals::Port {
 public:
  // `body` must outlive this object. Every fault must have a sensor; faults of the air are ignored.
  FaultyPort(const experiment::Experiment& experiment, signals::Port& body);

  signals::Status start(const signals::Scan& scan) noexcept override { return body_.start(scan); }
  signals::Status drive(signals::Edge edge) noexcept override { return body_.drive(edge); }
  signals::Reading read(signals::Channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override { return body_.stop(now); }

  // The last counts of each channel that were returned. Copied as bytes.
  struct State {
    std::array<std::uint16_t, robot::max_sensors> before{};
    std::array<bool, robot::max_sensors> has_counts{};
  };
  const State& state() const noexcept { return state_; }
  void restore(const State& state) noexcept { state_ = state; }

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
  double top_;  // highest count of the converter
  State state_;
};

}  // namespace sinew::run
