#include "sinew/port/hardware/serial_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>

#include "sinew/port/hardware/remote_board.h"

namespace sinew::plant {

namespace {

struct Rate {
  std::uint32_t baud;
  speed_t code;
};
constexpr Rate rates[] = {{9'600, B9600},        {19'200, B19200},      {38'400, B38400},
                          {57'600, B57600},      {115'200, B115200},    {230'400, B230400},
                          {460'800, B460800},    {500'000, B500000},    {921'600, B921600},
                          {1'000'000, B1000000}, {1'500'000, B1500000}, {2'000'000, B2000000},
                          {3'000'000, B3000000}, {4'000'000, B4000000}};

speed_t code_of(const std::string& device, std::uint32_t baud) {
  for (const Rate& r : rates)
    if (r.baud == baud) return r.code;
  std::string all;
  for (const Rate& r : rates) all += fmt::format("{}{}", all.empty() ? "" : ", ", r.baud);
  throw BoardError(fmt::format("{}: found {} bits/s; expected one of {}", device, baud, all));
}

[[noreturn]] void refuse(const std::string& device, int error) {
  std::string todo;
  if (error == EACCES)
    todo = "; this user may not open it: sudo usermod -aG dialout $USER, then log in again";
  if (error == ENOENT || error == ENXIO || error == ENODEV)
    todo = "; is the board plugged in? dmesg | tail prints which device it is";
  if (error == ENOTTY) throw BoardError(device + ": this is no serial line");
  if (error == EBUSY) todo = "; another program has it: sudo lsof " + device + " names it";
  throw BoardError(device + ": " + std::strerror(error) + todo);
}

// Sets raw mode: no line-end conversion, no echo, no control characters, no waiting within a read.
bool make_raw(int file, speed_t code) {
  termios mode{};
  if (::tcgetattr(file, &mode) != 0) return false;
  ::cfmakeraw(&mode);
  mode.c_cflag |= CLOCAL | CREAD;
  mode.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  mode.c_cc[VMIN] = 0;
  mode.c_cc[VTIME] = 0;
  if (::cfsetspeed(&mode, code) != 0 || ::tcsetattr(file, TCSANOW, &mode) != 0) return false;
  termios is{};
  const bool known = ::tcgetattr(file, &is) == 0;
  (void)::tcflush(file, TCIOFLUSH);
  return known && ::cfgetospeed(&is) == code && ::cfgetispeed(&is) == code;
}

int milliseconds(double seconds) { return static_cast<int>(std::ceil(1e3 * seconds)); }

}  // namespace

std::span<const std::uint32_t> serial_rates() {
  static constexpr auto all = [] {
    std::array<std::uint32_t, std::size(rates)> out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = rates[i].baud;
    return out;
  }();
  return all;
}

SerialLine::SerialLine(const std::string& device, std::uint32_t baud) {
  const speed_t code = code_of(device, baud);
  file_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) refuse(device, errno);
  // A board would obey two hosts at once, so the device is locked. The lock is needed in addition
  // to the exclusive mode, which does not hold against root.
  int error = 0;
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0) error = EBUSY;
  if (error == 0 && ::isatty(file_) == 0) error = ENOTTY;
  if (error == 0 && ::ioctl(file_, TIOCEXCL) != 0) error = errno;
  if (error == 0 && !make_raw(file_, code)) {
    ::close(file_);
    throw BoardError(fmt::format("{}: cannot have {} bits/s; try another rate, {}@115200 for one",
                                 device, baud, device));
  }
  if (error == 0) return;
  ::close(file_);
  refuse(device, error);
}

SerialLine::~SerialLine() {
  if (file_ < 0) return;
  (void)::ioctl(file_, TIOCNXCL);
  ::close(file_);
}

// Returns false if the line accepts nothing for a second, or not the whole frame within five.
bool SerialLine::write(std::span<const std::uint8_t> bytes) const {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::seconds(5);
  while (!bytes.empty()) {
    if (Clock::now() > until) return false;
    const ssize_t n = ::write(file_, bytes.data(), bytes.size());
    if (n > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(n));
      continue;
    }
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno != EAGAIN) return false;
    pollfd ready{file_, POLLOUT, 0};
    if (::poll(&ready, 1, 1'000) <= 0 || !(ready.revents & POLLOUT)) return false;
  }
  return true;
}

// When a device is unplugged, bytes that arrived before are returned first.
std::ptrdiff_t SerialLine::read(std::span<std::uint8_t> out, double seconds) const {
  pollfd ready{file_, POLLIN, 0};
  const int n = ::poll(&ready, 1, std::max(1, milliseconds(seconds)));
  if (n < 0) return errno == EINTR ? 0 : -1;
  if (n == 0) return 0;
  const ssize_t came = ::read(file_, out.data(), out.size());
  if (came > 0) return came;
  if (came < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  return -1;
}

BoardLine SerialLine::line() {
  return {[this](std::span<const std::uint8_t> bytes) { return write(bytes); },
          [this](std::span<std::uint8_t> out, double seconds) { return read(out, seconds); }};
}

}  // namespace sinew::plant
