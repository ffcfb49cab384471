// A board on a line that loses, changes, doubles, cuts and delays bytes, a board that is reset,
// sensors and air that fail: in all cases no muscle is open to both sides, the valves come to rest,
// and the reactions that docs/reference/supervision.md promises occur in time. Without a fault
// there is no reaction.
//
// The board is its program, in a thread of this process that waits for the host in each period.
// boards_emulated_test.cpp has the real firmware.
//
//   SINEW_GUARD_COUNT=1000    so many cases, and 10 h without a fault; SINEW_GUARD_SEED=n: one case
#include <gtest/gtest.h>

#include <cstdio>

#include "sinew/run/simulation/test_board.h"
#include "sinew/run/simulation/wired_body.h"
#include "tests/guards/board_cases.h"

namespace sinew::run {
namespace {

constexpr int usual = 60;

Told run_case(const Case& c) {
  WiredBody body(c.experiment);
  Monitor monitor(c.experiment);
  BoardInThread board(monitor.at(body.wires()));
  Proxy proxy(c, monitor, true);
  bool runs = false, was_reset = false;
  board.spoil = [&](std::vector<std::uint8_t>& bytes) {
    bytes = proxy.up(std::move(bytes));
    const double t = signals::tick_seconds * static_cast<double>(monitor.now());
    if (!runs || c.board_at < 0 || t < c.board_at || std::exchange(was_reset, true)) return;
    board.resets = true;
    monitor.board_suffers();
  };
  const plant::BoardLine inner = board.line();
  plant::RemoteBoard remote(
      {[&](std::span<const std::uint8_t> bytes) { return proxy.write(inner, bytes); }, inner.read,
       inner.now},
      1, 100);
  remote.prepare(bench_configuration_of(c.experiment));
  runs = true;
  proxy.starts();
  const Outcome out = run::run(c.experiment, {.board = &remote, .lead = 0});

  // Whatever the state of the host, the board has as long as it may take to come to rest.
  runs = false;
  proxy.ends();
  std::vector<std::uint8_t> bytes(256);
  for (int i = 0; i < 1'000 && !monitor.facts().at_rest(); ++i) (void)inner.read(bytes, 0.02);
  return judge(c, out, remote, monitor, proxy, 0);
}

TEST(Boards, WhateverFailsNoCaseIsUnsafe) {
  Sums sums;
  const Seeds all = seeds(usual);
  for (unsigned seed = all.first; seed <= all.last; ++seed) {
    const Case c = draw(seed);
    sums.add(c, run_case(c));
  }
  sums.print();
}

// Ten hours for a count of a thousand.
TEST(Boards, WhereNothingFailsNothingIsTripped) {
  const double wanted = 0.036 * guard_count(usual) * guard_count(usual);  // [s]
  double seconds = 0;
  for (unsigned seed = 1; seconds < wanted; ++seed) {
    experiment::Experiment e = board_scripts()[seed % board_scripts().size()];
    e.seed = static_cast<int>(seed);
    WiredBody body(e);
    Monitor monitor(e);
    BoardInThread board(monitor.at(body.wires()));
    plant::RemoteBoard remote(board.line(), 1, 100);
    remote.prepare(bench_configuration_of(e));
    const Outcome out = run::run(e, {.board = &remote, .lead = 0});
    ASSERT_FALSE(out.ended_early()) << "seed " << seed << ": " << cause_of(e, out);
    ASSERT_FALSE(was_noticed(out, remote, false)) << "seed " << seed;
    ASSERT_FALSE(monitor.facts().both_open) << "seed " << seed;
    seconds += out.duration;
  }
  std::printf("guard: %.0f s of robot time, nothing tripped, held or rejected\n", seconds);
}

}  // namespace
}  // namespace sinew::run
