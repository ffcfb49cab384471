// tests/serial/board_on_pty.h - a board's program at the far end of a pseudo-terminal, in real
// time, with a simulated machine at its wires: to a program of this computer it is a board.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "sinew/control/board/program.h"
#include "sinew/run/simulation/wired_body.h"

namespace sinew::test {

class BoardOnPty {
 public:
  // Its drivers are those of the leg's wiring.
  explicit BoardOnPty(const experiment::Experiment& e,
                      const board::Identification& who = {.board = {'p', 't', 'y'},
                                                          .active_low = true})
      : body_(e),
        wires_(body_.wires()),
        program_(who),
        file_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (file_ < 0 || ::grantpt(file_) != 0 || ::unlockpt(file_) != 0)
      throw std::runtime_error("no pseudo-terminal");
    device_ = ::ptsname(file_);
    // Without a host it must not hang up, nor echo, and bytes that are not read are lost.
    keeper_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios raw{};
    ::tcgetattr(keeper_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(keeper_, TCSANOW, &raw);
    ::fcntl(file_, F_SETFL, O_NONBLOCK);
    thread_ = std::thread([this] { run(); });
  }
  ~BoardOnPty() {
    ends_ = true;
    thread_.join();
    unplug();
  }

  const std::string& device() const { return device_; }
  control::BoardState state() const { return state_; }
  control::BoardFault fault() const { return fault_; }
  std::uint32_t open() const { return open_; }  // valves, bit by bit
  void unplug() {
    const std::lock_guard lock(plug_);
    for (int* file : {&file_, &keeper_})
      if (*file >= 0) ::close(std::exchange(*file, -1));
  }

  // Waits until the condition holds; false: it did not within so many seconds.
  template <class So>
  bool wait(So so, double seconds) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!so())
      if (std::chrono::steady_clock::now() > end)
        return false;
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return true;
  }

 private:
  struct NoTicks {
    void block() noexcept {}
    void allow() noexcept {}
  };

  void listen() {
    std::array<std::uint8_t, 1024> bytes;
    const std::lock_guard lock(plug_);
    pollfd ready{file_, POLLIN, 0};
    while (file_ >= 0 && ::poll(&ready, 1, 0) > 0 && (ready.revents & POLLIN)) {
      const ssize_t n = ::read(file_, bytes.data(), bytes.size());
      if (n <= 0) return;
      std::span<const std::uint8_t> left(bytes.data(), static_cast<std::size_t>(n));
      while (!left.empty()) {
        left = left.subspan(program_.receive(left));
        program_.serve(NoTicks{});
      }
    }
  }
  void speak() {
    std::array<std::uint8_t, 256> bytes;
    for (bool more = true; more;) {
      more = program_.serve(NoTicks{});
      const std::lock_guard lock(plug_);
      for (std::size_t n; (n = program_.transmit(bytes)) > 0;)
        if (file_ >= 0) (void)!::write(file_, bytes.data(), n);
    }
  }
  void tick() {
    const auto run_tick = [&] { return program_.safety().run_tick(program_.now()); };
    const board::Outputs out = program_.begin_tick();
    if (out != last_) wires_.valves(run_tick(), out.open, out.current);
    last_ = out;
    if (const signals::Conversion* c = program_.due())
      program_.take(*c, wires_.read(c->channel, run_tick()));
    (void)program_.end_tick();
    state_ = program_.safety().state();
    fault_ = program_.safety().fault();
    open_ = out.open;
  }
  // Ten ticks at a time: a computer like this one cannot wake a thread every 100 us.
  void run() {
    auto due = std::chrono::steady_clock::now();
    while (!ends_) {
      listen();
      for (int i = 0; i < 10; ++i) {
        tick();
        speak();
      }
      std::this_thread::sleep_until(due += std::chrono::milliseconds(1));
    }
  }

  run::WiredBody body_;
  plant::Wires wires_;
  board::Program program_;
  board::Outputs last_;
  int file_ = -1, keeper_ = -1;
  std::mutex plug_;
  std::string device_;
  std::atomic<control::BoardState> state_ = control::BoardState::fault;
  std::atomic<control::BoardFault> fault_ = control::BoardFault::none;
  std::atomic<std::uint32_t> open_ = 0;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace sinew::test
