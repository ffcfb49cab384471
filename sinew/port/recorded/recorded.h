// port/recorded/recorded.h - a log as a body: it returns the readings of that run, whatever it is
// commanded. The same controller must then decide the same edges.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/robot/robot.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"

namespace sinew::plant {

class Recorded final : public signals::Port {
 public:
  // Throws std::invalid_argument, naming the topic, where the table lacks a sensor's counts or has
  // fewer than one per period.
  Recorded(const robot::Robot& robot, const signals::Table& table);

  signals::Status start(const signals::Scan& scan) noexcept override;
  signals::Status drive(signals::Edge edge) noexcept override;
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override;

  // Returns the edges that it was told to drive.
  const std::vector<signals::Edge>& driven() const { return driven_; }

 private:
  std::vector<std::vector<std::uint16_t>> counts_;  // [channel][period]
  std::vector<signals::Edge> driven_;               // reserved before the run
  signals::Tick period_;
};

}  // namespace sinew::plant
