// The cases of boards_test.cpp on the real firmware: the application with its interrupts, timers,
// watchdog and serial line in QEMU, a proxy on the line, the simulated machine at the wires.
//
// Host and board have clocks of their own. A seed fixes the fault, its place, its time by the
// board's clock and its duration; which byte of the line is affected first depends on the computer,
// so that a case is not the same to the tick each time. Times are the board's ticks, however slow
// the emulator is.
//
//   SINEW_GUARD_COUNT=40    so many cases; SINEW_GUARD_SEED=n: one case
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "sinew/port/hardware/emulated_board.h"
#include "sinew/run/simulation/wired_body.h"
#include "tests/firmware/images.h"
#include "tests/guards/board_cases.h"

namespace sinew::run {
namespace {

using signals::Tick;

constexpr int usual = 5;
constexpr int lead = 1;

// The emulator's line delivers single bytes; a portion ends at a pause, or with a telemetry.
std::ptrdiff_t read_portion(const plant::BoardLine& line, std::span<std::uint8_t> out,
                            double seconds) {
  constexpr std::size_t longest = 512;
  std::ptrdiff_t n = line.read(out, seconds);
  for (std::ptrdiff_t more = n; more > 0 && static_cast<std::size_t>(n) < longest; n += more)
    if (more = line.read(out.subspan(static_cast<std::size_t>(n)), 0.001); more < 0) return more;
  return n;
}

// A host's line: the proxy's output is delivered in as many pieces as the host reads.
class HostsLine {
 public:
  HostsLine(const plant::BoardLine& inner, Proxy& proxy) : inner_(inner), proxy_(&proxy) {}

  plant::BoardLine line() {
    return {[this](std::span<const std::uint8_t> bytes) { return proxy_->write(inner_, bytes); },
            [this](std::span<std::uint8_t> out, double seconds) { return read(out, seconds); },
            inner_.now};
  }

 private:
  std::ptrdiff_t read(std::span<std::uint8_t> out, double seconds) {
    if (waiting_.empty()) {
      std::vector<std::uint8_t> bytes(1'024);
      const std::ptrdiff_t n =
          proxy_->active() ? read_portion(inner_, bytes, seconds) : inner_.read(bytes, seconds);
      if (n < 0) return n;
      bytes.resize(static_cast<std::size_t>(n));
      waiting_ = proxy_->up(std::move(bytes));
    }
    const std::size_t n = std::min(out.size(), waiting_.size());
    std::copy_n(waiting_.begin(), n, out.begin());
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(n));
    return static_cast<std::ptrdiff_t>(n);
  }

  plant::BoardLine inner_;
  Proxy* proxy_;
  std::vector<std::uint8_t> waiting_;
};

struct Went {
  Told told;
  double robot_time = 0, wall_time = 0;  // [s]
};

double now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since).count();
}

Went run_case(const Case& c) {
  const double begin = now();
  WiredBody body(c.experiment);
  Monitor monitor(c.experiment);
  plant::EmulatedBoard board(
      firmware::image("application-mps2_an386"),
      monitor.at(body.wires(), static_cast<Tick>(1e4 * std::max(c.board_at, 0.0)), c.failure));
  Proxy proxy(c, monitor, false);
  HostsLine line(board.line(), proxy);
  plant::RemoteBoard remote(line.line(), 1, 100);
  remote.prepare(bench_configuration_of(c.experiment));
  proxy.starts();
  const Outcome out = run::run(c.experiment, {.board = &remote, .lead = lead});
  proxy.ends();

  // Whatever the state of the host, the board has as long as it may take to come to rest.
  constexpr double longest = 30;  // [s] of the wall
  std::vector<std::uint8_t> bytes(256);
  const plant::BoardLine inner = board.line();
  for (const double since = now(); !monitor.facts().at_rest() && now() < since + longest;)
    if (inner.read(bytes, 0.02) < 0) break;
  // One that hung identifies itself when it has restarted.
  for (int i = 0; i < 5 && c.board_at >= 0; ++i) (void)remote.wait_for_telemetry(0.1);
  return {judge(c, out, remote, monitor, proxy, lead), out.duration, now() - begin};
}

TEST(BoardsEmulated, WhateverFailsNoCaseIsUnsafe) {
  if (firmware::missing()) {
    std::printf("guard: 0 cases on the real firmware: %s\n", firmware::what_is_missing);
    GTEST_SKIP() << firmware::what_is_missing;
  }
  Sums sums;
  Went whole;
  int cases = 0;
  const Seeds all = seeds(usual);
  for (unsigned seed = all.first; seed <= all.last; ++seed, ++cases) {
    const Case c = draw_by_turns(seed);
    SCOPED_TRACE("SINEW_GUARD_SEED=" + std::to_string(seed));
    const Went went = run_case(c);
    sums.add(c, went.told);
    whole.robot_time += went.robot_time;
    whole.wall_time += went.wall_time;
  }
  sums.print();
  std::printf("guard: %d cases on the real firmware, %.0f s of robot time in %.0f s\n", cases,
              whole.robot_time, whole.wall_time);
}

}  // namespace
}  // namespace sinew::run
