#include "sinew/host/beat.h"

#include <time.h>

#include <cerrno>
#include <cmath>

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

void Beat::start() noexcept { start_ = now_ns(); }

bool Beat::wait_until(signals::Tick tick) noexcept {
  if (start_ < 0) start();
  const std::int64_t due = start_ + tick * tick_ns();
  sleep_until_ns(due);
  behind_ = (now_ns() - due) / tick_ns();
  if (behind_ < 0) behind_ = 0;
  return behind_ == 0;
}

}  // namespace sinew::host
