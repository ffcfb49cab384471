#include "sinew/port/recorded/recorded.h"

#include <stdexcept>

namespace sinew::plant {

using signals::Status;

Recorded::Recorded(const robot::Robot& robot, const signals::Table& table)
    : period_(robot.low_level.pwm_ticks) {
  const std::int64_t period_ns = period_ * signals::tick_nanoseconds;
  std::size_t periods = 0;
  for (const robot::Sensor& sensor : robot.sensors) {
    const std::string topic = "/sensor/" + sensor.name + "/count";
    const signals::Series* series = table.find(topic);
    if (!series || series->time_ns.empty()) throw std::invalid_argument("the log has no " + topic);

    // The last sample of each period is used: it was recorded after the period's scan.
    std::vector<std::uint16_t> counts;
    for (std::size_t i = 0; i < series->time_ns.size(); ++i) {
      const auto p = static_cast<std::size_t>(series->time_ns[i] / period_ns);
      if (p > counts.size())
        throw std::invalid_argument(topic + " has no sample in period " +
                                    std::to_string(counts.size()) +
                                    "; a replay needs one per period of the low level");
      if (p == counts.size()) counts.push_back(0);
      counts.back() = static_cast<std::uint16_t>(series->columns[0][i]);
    }
    periods = counts.size();
    counts_.push_back(std::move(counts));
  }
  driven_.reserve(8 * (robot.muscles.size() + 1) * (periods + 2));
}

Status Recorded::start(const signals::Scan& scan) noexcept {
  if (scan.period != period_) return Status::invalid;
  for (const signals::Conversion& c : scan.conversions)
    if (c.channel.index >= counts_.size()) return Status::invalid;
  return Status::ok;
}

Status Recorded::drive(signals::Edge edge) noexcept {
  if (driven_.size() < driven_.capacity()) driven_.push_back(edge);
  return Status::ok;
}

signals::Reading Recorded::read(signals::Channel channel, signals::Tick now) noexcept {
  const std::vector<std::uint16_t>& counts = counts_[channel.index];
  const auto period = static_cast<std::size_t>(now / period_);
  if (period >= counts.size()) return {counts.back(), Status::ended};
  return {counts[period], Status::ok};
}

Status Recorded::stop(signals::Tick) noexcept { return Status::ok; }

}  // namespace sinew::plant
