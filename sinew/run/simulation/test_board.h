// run/simulation/test_board.h - a board's program in a thread of this process, in lock step with
// its host as in an emulator: while one of them runs, the other waits.
#pragma once

#include <semaphore>
#include <thread>
#include <utility>

#include "sinew/control/board/program.h"
#include "sinew/port/hardware/emulator.h"
#include "sinew/port/hardware/line.h"

namespace sinew::run {

class BoardInThread {
 public:
  explicit BoardInThread(plant::Wires wires)
      : wires_(std::move(wires)), thread_([this] { run(); }) {
    board_waits_.acquire();
  }
  ~BoardInThread() {
    ends_ = true;
    host_waits_.release();
    thread_.join();
  }

  plant::BoardLine line() {
    return {[this](std::span<const std::uint8_t> bytes) {
              if (gone) return false;
              if (!deaf) to_board_.insert(to_board_.end(), bytes.begin(), bytes.end());
              return true;
            },
            [this](std::span<std::uint8_t> out, double seconds) { return read(out, seconds); },
            [this] { return 0.01 * periods; }};
  }

  std::function<void(std::vector<std::uint8_t>&)> spoil;  // changes the board's output of a period
  bool deaf = false;                                      // true: the host's output is lost
  bool gone = false;                                      // true: the line is closed
  bool resets = false;                                    // true: the board resets in the next
                                                          // period
  std::uint32_t misses = 0;                               // ticks that its clock misses after this
                                                          // one
  int periods = 0;                                        // number of periods so far, of any kind

 private:
  struct NoTicks {
    void block() noexcept {}
    void allow() noexcept {}
  };

  // --- the host's side ---

  std::ptrdiff_t read(std::span<std::uint8_t> out, double seconds) {
    while (from_board_.empty()) {
      if (gone) return -1;
      if (seconds <= 0) return 0;
      seconds -= 0.01;
      host_waits_.release();  // the board continues with its next period
      board_waits_.acquire();
      ++periods;
      if (spoil) spoil(from_board_);
    }
    const std::size_t n = std::min(out.size(), from_board_.size());
    std::copy_n(from_board_.begin(), n, out.begin());
    from_board_.erase(from_board_.begin(), from_board_.begin() + static_cast<long>(n));
    return static_cast<std::ptrdiff_t>(n);
  }

  // --- the board's side ---

  void say_all() {
    std::array<std::uint8_t, 256> bytes;
    for (bool more = true; more;) {
      more = program_->serve(NoTicks{});
      for (std::size_t n; (n = program_->transmit(bytes)) > 0;)
        from_board_.insert(from_board_.end(), bytes.begin(), bytes.begin() + static_cast<long>(n));
    }
  }
  void wait() {
    say_all();
    board_waits_.release();
    host_waits_.acquire();
    const std::vector<std::uint8_t> came = std::move(to_board_);
    to_board_.clear();
    for (std::size_t done = 0; done < came.size(); say_all())
      done += program_->receive(std::span(came).subspan(done));
  }
  void run() {
    program_.emplace(board::Identification{.board = {'t', 'e', 's', 't'}});
    board::Outputs last;
    while (!ends_) {
      if (resets) {
        program_.emplace(board::Identification{.board = {'t', 'e', 's', 't'}, .nonce = 100});
        resets = false;
      }
      const auto tick = [&] { return program_->safety().run_tick(program_->now()); };
      const board::Outputs out = program_->begin_tick([&] { wait(); });
      if (out != last) wires_.valves(tick(), out.open, out.current);
      last = out;
      if (const signals::Conversion* c = program_->due())
        program_->take(*c, wires_.read(c->channel, tick()));
      (void)program_->end_tick();
      program_->miss(std::exchange(misses, 0u));
    }
    board_waits_.release();
  }

  plant::Wires wires_;
  std::optional<board::Program> program_;
  std::vector<std::uint8_t> from_board_, to_board_;
  bool ends_ = false;
  std::binary_semaphore host_waits_{0}, board_waits_{0};
  std::thread thread_;  // last: it uses all of these
};

}  // namespace sinew::run
