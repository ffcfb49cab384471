// tests/firmware/machine.h - a board in the emulator, and a host at the other end of its line.
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sinew/control/link/configuration.h"
#include "sinew/control/link/telemetry.h"
#include "sinew/control/link/test_wire.h"

namespace sinew::firmware {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// The emulator lets 2^shift ns pass with an instruction: 8, as a processor of some 150 MHz does. It
// is ended with this.
class Machine {
 public:
  Machine(const std::string& machine, const std::string& image, const std::string& word = {},
          int shift = 3) {
    std::string pattern = std::filesystem::temp_directory_path() / "sinew-board-XXXXXX";
    folder_ = mkdtemp(pattern.data());
    const std::string words =
        "enable=on,target=native,arg=board" + (word.empty() ? "" : ",arg=" + word);
    const std::string line =
        "socket,id=line,path=" + (folder_ / "line").string() + ",server=on,wait=on";
    std::vector<std::string> arguments{"qemu-system-arm",
                                       "-M",
                                       machine,
                                       "-display",
                                       "none",
                                       "-monitor",
                                       "none",
                                       "-icount",
                                       "shift=" + std::to_string(shift) + ",sleep=on",
                                       "-chardev",
                                       line,
                                       "-semihosting-config",
                                       words,
                                       "-kernel",
                                       image};
    // A board's first serial line is the application's.
    arguments.insert(arguments.end(), {"-serial", "chardev:line"});
    start(arguments);
    connect();
  }
  ~Machine() {
    close(line_);
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    std::filesystem::remove_all(folder_);
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  int line() const { return line_; }
  // All that the program and the emulator have printed so far.
  std::string printed() const {
    std::ifstream in(folder_ / "printed");
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  void start(std::vector<std::string>& arguments) {
    std::vector<char*> words;
    for (std::string& a : arguments) words.push_back(a.data());
    words.push_back(nullptr);
    const std::string printed = folder_ / "printed";
    process_ = fork();
    if (process_ != 0) return;
    if (std::freopen(printed.c_str(), "w", stdout) == nullptr) _exit(1);
    dup2(1, 2);
    execvp(words[0], words.data());
    _exit(1);
  }
  void connect() {
    sockaddr_un address{.sun_family = AF_UNIX};
    const std::string path = folder_ / "line";
    path.copy(address.sun_path, sizeof(address.sun_path) - 1);
    for (int i = 0; i < 500; ++i, usleep(10'000)) {
      line_ = socket(AF_UNIX, SOCK_STREAM, 0);
      if (::connect(line_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0)
        return;
      close(line_);
    }
    FAIL() << "the emulator does not listen: " << printed();
  }

  std::filesystem::path folder_;
  pid_t process_ = -1;
  int line_ = -1;
};

// The last message of each kind that a board has sent.
class Host {
 public:
  explicit Host(int line) : line_(line) {}

  template <class M>
  void send(const M& message) {
    const link::Bytes frame = link::frame_of(message, {1, sequence_++});
    ASSERT_EQ(write(line_, frame.data(), frame.size()), static_cast<ssize_t>(frame.size()));
  }
  // Sends it and waits for its answer.
  template <class M>
  link::Code ask(const M& message) {
    const std::uint8_t sequence = sequence_;
    answer.reset();
    send(message);
    const bool came =
        wait([&] { return answer && answer->sequence == sequence; }, milliseconds(5'000));
    return came ? answer->code : link::Code::type;
  }

  // The longest time since the last call without a read of its line. The line buffers some
  // milliseconds of telemetry: bytes after that are lost, which is not a fault of the board.
  Clock::duration longest_pause() {
    looked_ = Clock::now();
    return std::exchange(longest_pause_, Clock::duration{});
  }

  // Listens until the condition holds; false: it did not within the time.
  template <class So>
  bool wait(So so, milliseconds longest = milliseconds(15'000)) {
    for (const auto end = Clock::now() + longest; !so();) {
      if (Clock::now() > end) return false;
      listen(milliseconds(2));
    }
    return true;
  }
  void listen(milliseconds time) {
    pollfd p{line_, POLLIN, 0};
    const int ready = poll(&p, 1, static_cast<int>(time.count()));
    const Clock::time_point now = Clock::now();
    longest_pause_ = std::max(longest_pause_, now - looked_);
    looked_ = now;
    if (ready <= 0) return;
    link::Bytes bytes(4'096);
    const ssize_t n = read(line_, bytes.data(), bytes.size());
    if (n <= 0) return;
    link::feed(decoder_, std::span(bytes).first(static_cast<std::size_t>(n)),
               [&](const link::Frame& f) { hear(f); });
  }

  std::optional<link::Identity> identity;
  std::optional<link::Reply> answer;
  std::vector<link::Event> events;
  link::Telemetry telemetry;
  int telemetries = 0;
  const link::TelemetryJoiner& joined() const { return joiner_; }

 private:
  Clock::time_point looked_ = Clock::now();
  Clock::duration longest_pause_{};
  void hear(const link::Frame& f) {
    if (link::Identity m; link::decode(f, m) == link::Code::done) identity = m;
    if (link::Reply m; link::decode(f, m) == link::Code::done) answer = m;
    if (link::Event m; link::decode(f, m) == link::Code::done) events.push_back(m);
    if (const link::Telemetry* t = joiner_.take(f.type, f.body)) {
      telemetry = *t;
      ++telemetries;
    }
  }

  int line_;
  std::uint8_t sequence_ = 0;
  link::Decoder decoder_;
  link::TelemetryJoiner joiner_{100};
};

}  // namespace sinew::firmware
