#include "sinew/host/realtime.h"

#include <algorithm>
#include <cerrno>
#include <cmath>

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

namespace sinew::host {

namespace {

constexpr std::int64_t second = 1'000'000'000;

std::int64_t tick_ns() noexcept {
  return static_cast<std::int64_t>(std::llround(1e9 * signals::tick_seconds));
}

}  // namespace

std::int64_t now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * second + now.tv_nsec;
}

void sleep_until_ns(std::int64_t instant) noexcept {
  timespec until{};
  until.tv_sec = instant / second;
  until.tv_nsec = instant % second;
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {}
}

void TickTimer::start() noexcept { start_ = now_ns(); }

bool TickTimer::wait_until(signals::Tick tick) noexcept {
  if (start_ < 0) start();
  const std::int64_t due = start_ + tick * tick_ns();
  sleep_until_ns(due);
  behind_ = (now_ns() - due) / tick_ns();
  if (behind_ < 0) behind_ = 0;
  return behind_ == 0;
}

Latency measure_latency(double seconds, double tick) {
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(seconds / tick)));
  const auto step = static_cast<std::int64_t>(std::llround(1e9 * tick));
  std::vector<double> late(count);
  std::int64_t due = now_ns();
  for (double& l : late) {
    due += step;
    sleep_until_ns(due);
    l = 1e-9 * static_cast<double>(now_ns() - due);
  }
  return latency_of(std::move(late));
}

Latency latency_of(std::vector<double> late) {
  if (late.empty()) return {};
  std::ranges::sort(late);
  // Last value within the share, so that for few wake-ups it is the worst.
  const auto at = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(late.size()));
    return late[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  return {at(0.5), at(0.999), late.back(), late.size()};
}

LatencyClass class_of(const Latency& latency, double tick) {
  if (latency.worst <= 0.5 * tick) return LatencyClass::real_time;
  return latency.most <= tick ? LatencyClass::usual : LatencyClass::unfit;
}

std::string describe_latency(const Latency& l, double tick) {
  const LatencyClass c = class_of(l, tick);
  const char* name = c == LatencyClass::real_time ? "real-time"
                     : c == LatencyClass::usual   ? "usual"
                                                  : "unfit";
  return fmt::format("{}: {} wake-ups, worst {:.0f} us, 99.9 % within {:.0f} us", name, l.count,
                     1e6 * l.worst, 1e6 * l.most);
}

namespace {

bool schedule(int policy, int with) noexcept {
  const sched_param wanted{.sched_priority = with};
  return ::pthread_setschedparam(::pthread_self(), policy, &wanted) == 0;
}

}  // namespace

// Pages allocated later are not locked: locked in advance, they would count against a limit that a
// run's log may exceed.
RealTime::RealTime() noexcept
    : has_priority_(schedule(SCHED_FIFO, priority)), locked_(::mlockall(MCL_CURRENT) == 0) {}

RealTime::~RealTime() {
  if (locked_) (void)::munlockall();
  if (has_priority_) (void)schedule(SCHED_OTHER, 0);
}

std::vector<std::string> problems(const RealTime& real_time) {
  std::vector<std::string> out;
  if (!real_time.has_priority())
    out.emplace_back(
        "SCHED_FIFO is not permitted: other programs may come before the loop; for the group "
        "iocard: echo '@iocard - rtprio 90' | sudo tee -a /etc/security/limits.d/sinew.conf, then "
        "log "
        "in again");
  if (!real_time.locked())
    out.emplace_back(
        "memory cannot be locked: a page that was put out costs milliseconds; for the group "
        "iocard: echo '@iocard - memlock unlimited' | sudo tee -a "
        "/etc/security/limits.d/sinew.conf, then log in again");
  return out;
}

}  // namespace sinew::host
