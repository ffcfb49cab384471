// run/card/walk.h - one run of a plain leg as a block of bytes: machine, board and loop. The same
// source is compiled for the processor and for graphics cards (kernel.cu), with the same bits.
//
//   the loop             run/simulation/loop.h
//   the machine          world/flat_leg.h
//   the low level        run/controllers/board.h
//   the gait controller  a table of its commands, computed before the run (plan_table.h): so the
//                        plan must not depend on measured values
//   the recorder         the samples and edges that are kept, here
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "sinew/control/joint/command.h"
#include "sinew/run/controllers/board.h"
#include "sinew/run/simulation/loop.h"
#include "sinew/run/simulation/node_bounds.h"
#include "sinew/signals/tick.h"
#include "sinew/world/flat_leg.h"

namespace sinew::run {

// All values that a sample can contain, one after the other in memory.
struct Shown {
  plant::Truth truth;
  control::ControllerState controller;
  control::Supervised supervised;
};
static_assert(std::is_trivially_copyable_v<Shown> && sizeof(Shown) % sizeof(std::uint64_t) == 0);
static_assert(sizeof(plant::Truth) % sizeof(std::uint64_t) == 0);
static_assert(sizeof(control::ControllerState) % sizeof(std::uint64_t) == 0);

// Number of 8-byte words of a value.
template <class T>
inline constexpr std::size_t words_of = sizeof(T) / sizeof(std::uint64_t);

// An edge in 32 bits.
struct PackedEdge {
  static constexpr std::uint32_t tick_bits = 25, latest = (1u << tick_bits) - 1;

  // Return the bits of an edge before the tick `latest`, and the edge of these bits.
  static constexpr std::uint32_t pack(const signals::Edge& edge) {
    return static_cast<std::uint32_t>(edge.at) |
           static_cast<std::uint32_t>(edge.valve.index) << 25 |
           static_cast<std::uint32_t>(edge.open) << 31;
  }
  static constexpr signals::Edge unpack(std::uint32_t packed) {
    return {.at = packed & latest,
            .valve = {static_cast<std::uint8_t>(packed >> 25 & 63)},
            .open = packed >> 31 != 0};
  }
};

// Memory for what is kept of the runs of one launch: some words of Shown for each sample, and the
// edges. Word or edge number i of a run is at [i * runs + run], so that neighbouring threads write
// to neighbouring addresses.
struct Kept {
  const std::uint16_t* wanted = nullptr;  // words of Shown, ascending
  std::int32_t words = 0;                 // their number
  std::int32_t samples = 0;               // room for each run
  std::int32_t edges = 0;                 // room for each run; 0: no edges are kept
  std::int64_t runs = 0;
  std::uint64_t* sample = nullptr;
  std::uint32_t* edge = nullptr;
};

// The commands of a plan, one for each period of the low level; the last one holds afterwards.
struct CommandRows {
  const control::Command* row = nullptr;
  std::int64_t count = 0;
  signals::Tick vents_at = std::numeric_limits<signals::Tick>::max();  // the plan's end
};

// Inputs of all runs of a launch. The pointers are those of the memory where it runs.
struct Launch {
  const control::Command* commands = nullptr;  // those of all plans, one after the other
  Kept kept;
};

// A board alone as the low level of loop.h.
struct SingleBoard {
  Board board;

  // The functions of Boards that the loop calls.
  signals::Scan scan() const noexcept { return {period, board.conversions()}; }
  std::span<Board> each() noexcept { return {&board, 1}; }
  const control::ControllerState& state() const noexcept { return board.supervisor.state(); }
  control::Phase phase() const noexcept { return state().phase; }
  void command(const control::Command& command) noexcept { board.supervisor.command(command); }
  bool drives_at(signals::Tick t) const noexcept { return board.supervisor.drives_at(t); }
  signals::Tick next_event(signals::Tick t) noexcept { return board.supervisor.next_event(t); }
  void missed(signals::Tick t) noexcept { board.supervisor.missed(t); }
  void shut_down(signals::Tick t) noexcept { board.supervisor.shut_down(t); }

  std::uint16_t period = 100;  // [ticks]
};

// A table of commands in place of a gait controller.
struct CommandTable {
  CommandRows rows;
  signals::Tick period;
  bool has_finished = false;

  // The functions of a gait controller that the loop calls.
  const control::Command& update(const control::ControllerState&, signals::Tick t) noexcept {
    has_finished = t >= rows.vents_at;
    const std::int64_t k = t / period;
    return rows.row[k < rows.count ? k : rows.count - 1];
  }
  bool finished() const noexcept { return has_finished; }
};

// One run. Copied as bytes.
class Walk {
 public:
  // The run ends before the tick `last`; samples are taken every `sample_period` from
  // `first_sample` on.
  struct Timing {
    signals::Tick last = 0, first_sample = 0, sample_period = 0;
  };
  // Takes an experiment's machine and board at their start.
  Walk(const plant::FlatLeg& leg, const SingleBoard& low, const Timing& timing)
      : leg_(leg),
        low_(low),
        last_(timing.last),
        first_sample_(timing.first_sample),
        next_sample_(timing.first_sample),
        sample_period_(timing.sample_period) {}

  // Takes the number of its commands, and the index of the first one in Launch::commands.
  void set_plan(std::int64_t first, const CommandRows& rows) noexcept {
    plan_ = first;
    table_ = {{nullptr, rows.count, rows.vents_at}, low_.period};
  }

  // --- on the processor or a card ---

  // Runs it to its end; not if `begins` is false. `number` is its index among the runs of the
  // launch. The runs that are computed together call meet(x) at the same places; it returns whether
  // x is true for any of them.
  template <class Meet>
  void run(const Launch& launch, std::int64_t number, bool begins, const Meet& meet) noexcept;

  // --- after the run ---

  // Return the board and the machine at the end, the first status that was not ok, the tick of the
  // first sample, the number of samples and edges, and whether there was room for all of them.
  const Board& board() const noexcept { return low_.board; }
  const plant::FlatLeg& leg() const noexcept { return leg_; }
  signals::Status status() const noexcept { return loop_.status; }
  signals::Tick first_sample() const noexcept { return first_sample_; }
  std::int32_t samples() const noexcept { return samples_; }
  std::int32_t edges() const noexcept { return edges_; }
  bool complete() const noexcept { return complete_; }

 private:
  struct Watch;
  struct NoClock {
    void wait_until(signals::Tick) const noexcept {}
  };

  double turn(Watch& watch) noexcept;

  static constexpr double finished_ = std::numeric_limits<double>::infinity();

  plant::FlatLeg leg_;
  SingleBoard low_;
  LoopState loop_;
  NodeBounds bounds_;
  CommandTable table_{};
  std::int64_t plan_ = 0;
  signals::Tick last_, first_sample_, next_sample_, sample_period_;
  std::int32_t samples_ = 0, edges_ = 0;
  bool reached_ = false;  // whether the nodes before loop_.at are committed
  bool complete_ = true;
};

static_assert(std::is_trivially_copyable_v<Walk>);

// The watcher of loop.h, with the rules of RecordedRun.
struct Walk::Watch {
  Walk& walk;
  const Kept& kept;
  std::int64_t number;

  void command(signals::Tick) noexcept {}
  void edge(const signals::Edge& edge) noexcept {
    if (kept.edges == 0 || walk.leg_.failure()) return;
    if (walk.edges_ >= kept.edges) {
      walk.complete_ = false;
      return;
    }
    kept.edge[walk.edges_++ * kept.runs + number] = PackedEdge::pack(edge);
  }
  void sample(signals::Tick t) noexcept {
    if (walk.leg_.failure() || t < walk.next_sample_) return;
    walk.leg_.advance(static_cast<double>(t) * signals::tick_seconds);
    if (walk.leg_.failure()) return;
    walk.next_sample_ += walk.sample_period_;
    if (walk.samples_ >= kept.samples) {
      walk.complete_ = false;
      return;
    }
    const std::int64_t row = walk.samples_++;
    write(t, kept.sample + row * kept.words * kept.runs + number);
  }
  signals::Tick next(signals::Tick) const noexcept {
    return walk.leg_.failure() ? std::numeric_limits<signals::Tick>::max() : walk.next_sample_;
  }

 private:
  void write(signals::Tick t, std::uint64_t* to) const noexcept {
    constexpr std::size_t after_motion = offsetof(plant::Truth, torque) / sizeof(std::uint64_t),
                          after_controller = after_truth + words_of<control::ControllerState>;
    plant::Truth truth;
    const std::int32_t of_truth = words_of_truth();
    if (of_truth > 0 && kept.wanted[of_truth - 1] < after_motion)
      walk.leg_.true_motion(static_cast<double>(t) * signals::tick_seconds, truth);
    else if (of_truth > 0)
      walk.leg_.truth(static_cast<double>(t) * signals::tick_seconds, truth);
    for (std::int32_t k = 0; k < kept.words; ++k, to += kept.runs) {
      const std::size_t w = kept.wanted[k];
      if (w < after_truth)
        copy_word(truth, w, to);
      else if (w < after_controller)
        copy_word(walk.low_.board.supervisor.state(), w - after_truth, to);
      else
        copy_word(walk.low_.board.supervisor.supervised(), w - after_controller, to);
    }
  }
  static constexpr std::size_t after_truth = words_of<plant::Truth>;

  // Returns how many of the wanted words, which are ascending, are true values.
  std::int32_t words_of_truth() const noexcept {
    std::int32_t n = 0;
    while (n < kept.words && kept.wanted[n] < after_truth) ++n;
    return n;
  }
  template <class T>
  static void copy_word(const T& from, std::size_t word, std::uint64_t* to) noexcept {
    std::memcpy(to, reinterpret_cast<const std::byte*>(&from) + word * sizeof *to, sizeof *to);
  }
};

// Visits the present tick, whose nodes are committed; returns the time to which they must be
// committed for the next one, as a run in lanes does (run/simulation/lanes.cpp).
inline double Walk::turn(Watch& watch) noexcept {
  const NoClock clock;
  if (reached_) advance(loop_, low_, table_, leg_, clock, watch, loop_.at + 1);
  reached_ = true;
  const signals::Tick t = loop_.at;
  if (t >= last_ || loop_.status != signals::Status::ok || low_.phase() == control::Phase::off)
    return finished_;
  return bounds_.before(low_.scan(), t, t >= watch.next(t), low_.drives_at(t));
}

template <class Meet>
void Walk::run(const Launch& launch, std::int64_t number, bool begins, const Meet& meet) noexcept {
  table_.rows.row = launch.commands + plan_;
  Watch watch{*this, launch.kept, number};
  double until = 0;
  for (bool runs = begins; meet(runs);) {
    if (runs) until = turn(watch);
    runs = runs && until < finished_;
    for (;;) {
      const bool waits = runs && leg_.waits(until);
      if (!meet(waits)) break;
      if (waits) leg_.commit_next();
    }
  }
  loop_.status = finish(loop_, leg_);
  table_.rows.row = nullptr;
}

}  // namespace sinew::run
