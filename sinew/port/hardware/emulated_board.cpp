#include "sinew/port/hardware/emulated_board.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "sinew/control/board/lock_step.h"
#include "sinew/port/hardware/remote_board.h"

namespace sinew::plant {

namespace record_kind = board::record;

// --- in lock step -------------------------------------------------------------------------------

LockStepBoard::LockStepBoard(const std::string& image, Wires wires)
    : emulator_(image, std::move(wires), -1) {}

std::optional<LockStepBoard::Sizes> LockStepBoard::end() noexcept {
  try {
    while (!waits_) waits_ = record();
    const std::uint8_t ends[] = {board::ends & 0xff, board::ends >> 8};
    emulator_.put(ends);
    while (!sizes_) (void)record();
  } catch (const Emulator::Closed&) {
    closed_ = true;
  }
  emulator_.kill();
  return sizes_;
}

bool LockStepBoard::record() {
  switch (emulator_.next_record()) {
    case record_kind::line:
      for (std::int64_t n = emulator_.number(2); n > 0; --n)
        in_.push_back(static_cast<std::uint8_t>(emulator_.number(1)));
      return false;
    case record_kind::waits:
      (void)emulator_.number(8);
      return true;
    case record_kind::sizes: {
      Sizes sizes{.stack = static_cast<std::uint32_t>(emulator_.number(4))};
      sizes.memory = static_cast<std::uint32_t>(emulator_.number(4));
      sizes_ = sizes;
      return false;
    }
    default:
      throw Emulator::Closed{};
  }
}

void LockStepBoard::send_period() {
  std::vector<std::uint8_t> all{static_cast<std::uint8_t>(out_.size()),
                                static_cast<std::uint8_t>(out_.size() >> 8)};
  all.insert(all.end(), out_.begin(), out_.end());
  out_.clear();
  waits_ = false;
  emulator_.put(all);
}

// Returns the line's bytes. The board runs its next period only while a caller waits here.
std::ptrdiff_t LockStepBoard::read(std::span<std::uint8_t> out, double seconds) {
  constexpr double period = 0.01;
  while (in_.empty()) {
    if (waits_) {
      if (seconds <= 0) return 0;
      seconds -= period;
      ++periods_;
      send_period();
    }
    waits_ = record();
  }
  const std::size_t n = std::min(out.size(), in_.size());
  std::copy_n(in_.begin(), n, out.begin());
  in_.erase(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(n));
  return static_cast<std::ptrdiff_t>(n);
}

BoardLine LockStepBoard::line() {
  const auto write = [this](std::span<const std::uint8_t> bytes) {
    if (closed_ || out_.size() + bytes.size() >= board::ends) return false;
    out_.insert(out_.end(), bytes.begin(), bytes.end());
    return true;
  };
  const auto read = [this](std::span<std::uint8_t> out, double seconds) -> std::ptrdiff_t {
    try {
      return closed_ ? -1 : this->read(out, seconds);
    } catch (const Emulator::Closed&) {
      closed_ = true;
      return -1;
    }
  };
  return {write, read, [this] { return 0.01 * static_cast<double>(periods_); }};
}

// --- at its serial line -------------------------------------------------------------------------

EmulatedBoard::Sockets::Sockets() {
  int both[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, both) != 0)
    throw BoardError(std::string("no socket for the emulator's line: ") + std::strerror(errno));
  ours = both[0];
  its = both[1];
}

EmulatedBoard::Sockets::~Sockets() {
  ::close(ours);
  if (its >= 0) ::close(its);
}

EmulatedBoard::EmulatedBoard(const std::string& image, Wires wires)
    : emulator_(image, std::move(wires), sockets_.its), wires_([this] {
        try {
          for (;;)
            if (emulator_.next_record() != 0) throw Emulator::Closed{};
        } catch (const Emulator::Closed&) {
          emulator_.kill();  // an unexpected record: the program is not usable
        }
      }) {
  ::close(sockets_.its);
  sockets_.its = -1;
}

EmulatedBoard::~EmulatedBoard() {
  emulator_.kill();
  wires_.join();
}

// Returns false if the emulator accepts nothing for a second, as for a serial line.
bool EmulatedBoard::write(std::span<const std::uint8_t> bytes) const {
  while (!bytes.empty()) {
    const ssize_t n =
        ::send(sockets_.ours, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(n));
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN) return false;
    pollfd ready{sockets_.ours, POLLOUT, 0};
    if (::poll(&ready, 1, 1'000) <= 0 || !(ready.revents & POLLOUT)) return false;
  }
  return true;
}

std::ptrdiff_t EmulatedBoard::read(std::span<std::uint8_t> out, double seconds) const {
  pollfd ready{sockets_.ours, POLLIN, 0};
  const int n = ::poll(&ready, 1, std::max(1, static_cast<int>(std::ceil(1e3 * seconds))));
  if (n < 0) return errno == EINTR ? 0 : -1;
  if (n == 0) return 0;
  const ssize_t came = ::recv(sockets_.ours, out.data(), out.size(), 0);
  return came > 0 ? came : -1;
}

BoardLine EmulatedBoard::line() {
  return {[this](std::span<const std::uint8_t> bytes) { return write(bytes); },
          [this](std::span<std::uint8_t> out, double seconds) { return read(out, seconds); }};
}

}  // namespace sinew::plant
