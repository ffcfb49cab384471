#include "sinew/run/simulation/faulty_port.h"

#include <algorithm>
#include <cmath>

#include "sinew/robot/sensing.h"

namespace sinew::run {

using signals::Reading;
using signals::Status;
using signals::Tick;

FaultyPort::FaultyPort(const experiment::Experiment& e, signals::Port& body)
    : body_(body), seed_(static_cast<std::uint64_t>(e.seed)), top_(e.robot.converter.top()) {
  for (std::size_t i = 0; i < e.faults.size(); ++i)
    if (const experiment::Fault& fault = e.faults[i]; is_of_sensor(fault.what))
      faults_.push_back(
          {fault, i, static_cast<std::uint8_t>(robot::find_sensor(e.robot, fault.of))});
}

// Returns a random number of a fault. Its index follows those of the sensors' own noise, from 0 on.
double FaultyPort::drawn(std::size_t fault, Tick now) const noexcept {
  constexpr int first = 1000;
  return robot::noise(seed_, first + static_cast<int>(fault), now);
}

Reading FaultyPort::spoil(const Acting& acting, Reading r, Tick now) const noexcept {
  const auto& [fault, i, channel] = acting;
  const auto counts = [&](double value) {
    return static_cast<std::uint16_t>(std::clamp(value, 0.0, top_) + 0.5);
  };
  using enum experiment::Fault::What;
  switch (fault.what) {
    case open:
      return {counts(top_), r.status};
    case shorted:
      return {0, r.status};
    case stuck:
      return {state_.has_counts[channel] ? state_.before[channel] : r.counts, r.status};
    case offset:
    case slip:
      return {counts(r.counts + fault.amount), r.status};
    case noise:
      return {counts(r.counts + fault.amount * drawn(i, now)), r.status};
    case dropout: {
      // The fractional part of a sum of uniform numbers is uniform.
      const double n = drawn(i, now);
      const bool lost = !(n - std::floor(n) >= fault.amount);
      return lost ? Reading{state_.before[channel], Status::late} : r;
    }
    default:
      break;  // a fault of the air
  }
  return r;
}

Reading FaultyPort::read(signals::Channel channel, Tick now) noexcept {
  Reading r = body_.read(channel, now);
  if (r.status == Status::ended || r.status == Status::fault) return r;
  const double time = static_cast<double>(now) * signals::tick_seconds;
  for (const Acting& f : faults_)
    if (f.channel == channel.index && experiment::acts(f.fault, time)) r = spoil(f, r, now);
  if (r.status == Status::ok) {
    state_.before[channel.index] = r.counts;
    state_.has_counts[channel.index] = true;
  }
  return r;
}

}  // namespace sinew::run
