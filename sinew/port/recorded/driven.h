// port/recorded/driven.h - a body whose valves follow a log, whatever a controller decides:
// recorded commands for a simulated machine. It then has to move as the recorded one did, or the
// model differs from it.
#pragma once

#include <vector>

#include "sinew/signals/port.h"

namespace sinew::plant {

class Driven final : public signals::Port {
 public:
  // `body` outlives it; the edges come in ascending time.
  Driven(signals::Port& body, std::vector<signals::Edge> edges)
      : body_(body), edges_(std::move(edges)) {}

  signals::Status start(const signals::Scan& scan) noexcept override { return body_.start(scan); }
  // A controller's own edges go nowhere.
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
