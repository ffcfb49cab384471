// port/recorded/recorded.h - a log as a plant: it returns the readings of that run, independent of
// the commands. The same controller must then decide the same edges.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/robot/robot.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"

namespace sinew::plant {

class Recorded final : public signals::Port {
 public:
  // Throws std::invalid_argument with the topic's name if the table lacks a sensor's counts or has
  // fewer than one per period.
  Recorded(const robot::Robot& robot, const signals::Table& table);

  signals::Status start(const signals::Scan& scan) noexcept override;
  signals::Status drive(signals::Edge edge) noexcept override;
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override;

  // Returns the edges that drive() was called with.
  const std::vector<signals::Edge>& driven() const { return driven_; }

 private:
  std::vector<std::vector<std::uint16_t>> counts_;  // [channel][period]
  std::vector<signals::Edge> driven_;               // allocated before the run
  signals::Tick period_;
};

// A plant whose valves follow the edges of a log and ignore the controller: recorded commands for a
// simulated machine. A motion that differs from the recorded one is a fault of the model.
class Driven final : public signals::Port {
 public:
  // `body` must outlive this object; the edges are in ascending order of time.
  Driven(signals::Port& body, std::vector<signals::Edge> edges)
      : body_(body), edges_(std::move(edges)) {}

  signals::Status start(const signals::Scan& scan) noexcept override { return body_.start(scan); }
  // Ignores the controller's own edges.
  signals::Status drive(signals::Edge) noexcept override { return status_; }
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override {
    catch_up(now);
    return body_.read(channel, now);
  }
  signals::Status stop(signals::Tick now) noexcept override { return body_.stop(now); }

  // Drives all recorded edges up to a tick.
  void catch_up(signals::Tick now) noexcept {
    for (; next_ < edges_.size() && edges_[next_].at <= now; ++next_) {
      const signals::Status driven = body_.drive(edges_[next_]);
      if (status_ == signals::Status::ok) status_ = driven;
    }
  }

 private:
  signals::Port& body_;
  std::vector<signals::Edge> edges_;
  std::size_t next_ = 0;
  signals::Status status_ = signals::Status::ok;
};

}  // namespace sinew::plant
