// firmware/lock_step.cpp - a board's program in the emulator, in lock step with the simulation of a
// host: the state of the valves is written to a pipe, readings of the converter come from another.
// The emulated machine waits while the host computes, so that both have the same time.
#include <array>
#include <new>

#include "firmware/semihosting.h"
#include "sinew/control/board/lock_step.h"
#include "sinew/control/board/program.h"

namespace sinew::firmware {

void program();
std::uint32_t deepest_stack();

namespace {

namespace record = board::record;

// The two pipes. Output is buffered until a reply is needed.
class Host {
 public:
  Host(const char* to, const char* from)
      : to_(to, File::For::writing), from_(from, File::For::reading) {}

  template <class T>
  void put(T number) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      byte(static_cast<std::uint8_t>(number));
      if constexpr (sizeof(T) > 1) number = static_cast<T>(number >> 8);
    }
  }
  void put(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t b : bytes) byte(b);
  }
  void send() {
    to_.write({out_.data(), size_});
    size_ = 0;
  }
  std::uint16_t number() {
    std::array<std::uint8_t, 2> b;
    from_.read(b);
    return static_cast<std::uint16_t>(b[0] | b[1] << 8);
  }
  void get(std::span<std::uint8_t> bytes) { from_.read(bytes); }

 private:
  void byte(std::uint8_t b) {
    if (size_ == out_.size()) send();
    out_[size_++] = b;
  }

  File to_, from_;
  std::array<std::uint8_t, 2'048> out_;
  std::size_t size_ = 0;
};

struct NoTicks {
  void block() noexcept {}
  void allow() noexcept {}
};

// Storage for objects that are constructed later: the language's start-up code does not run here.
template <class T>
struct Room {
  alignas(T) std::uint8_t bytes[sizeof(T)];
};
Room<board::Program> program_room;
Room<Host> host_room;

// Returns the run's tick; all bits are set (-1) outside a run.
std::uint64_t run_tick(const board::Program& program) {
  return static_cast<std::uint64_t>(program.safety().run_tick(program.now()));
}

void say_all(board::Program& program, Host& host) {
  static std::array<std::uint8_t, link::max_frame> bytes;
  for (bool more = true; more;) {
    more = program.serve(NoTicks{});
    for (std::size_t n; (n = program.transmit(bytes)) > 0;) {
      host.put(record::line);
      host.put(static_cast<std::uint16_t>(n));
      host.put(std::span<const std::uint8_t>(bytes.data(), n));
    }
  }
}

void wait(board::Program& program, Host& host) {
  say_all(program, host);
  host.put(record::waits);
  host.put(run_tick(program));
  host.send();
  std::uint16_t size = host.number();
  if (size == board::ends) {
    host.put(record::sizes);
    host.put(deepest_stack());
    host.put(static_cast<std::uint32_t>(sizeof(board::Program)));
    host.send();
    quit(0);
  }
  static std::array<std::uint8_t, 256> bytes;
  while (size > 0) {
    const std::uint16_t n = size < bytes.size() ? size : static_cast<std::uint16_t>(bytes.size());
    host.get({bytes.data(), n});
    size = static_cast<std::uint16_t>(size - n);
    for (std::size_t done = 0; done < n;) {
      done += program.receive({bytes.data() + done, n - done});
      say_all(program, host);
    }
  }
}

signals::Reading convert(board::Program& program, Host& host, std::uint8_t channel) {
  host.put(record::reading);
  host.put(run_tick(program));
  host.put(channel);
  host.send();
  std::array<std::uint8_t, 3> b;
  host.get(b);
  return {static_cast<std::uint16_t>(b[0] | b[1] << 8), static_cast<signals::Status>(b[2])};
}

void say_valves(const board::Program& program, Host& host, const board::Outputs& out) {
  host.put(record::valves);
  host.put(run_tick(program));
  host.put(out.open);
  host.put(static_cast<std::uint8_t>((out.current ? board::has_current : 0) |
                                     (out.supply ? board::has_supply : 0)));
}

void run_forever(board::Program& program, Host& host) {
  board::Outputs last;
  for (;;) {
    const board::Outputs out = program.begin_tick([&] { wait(program, host); });
    if (out != last) say_valves(program, host, out);
    last = out;
    if (const signals::Conversion* c = program.due())
      program.take(*c, convert(program, host, c->channel.index));
    (void)program.end_tick();
  }
}

}  // namespace

// Runs the program. Its command line: the program's name, the pipe to the host, the pipe from the
// host.
void program() {
  asm volatile("" : : "r"(board::lock_step_image));  // keeps the mark in the image
  static std::array<char, 512> words;
  command_line(words);
  const char* name[3] = {words.data(), nullptr, nullptr};
  std::size_t n = 1;
  for (std::size_t i = 0; words[i] != 0 && n < 3; ++i)
    if (words[i] == ' ') {
      words[i] = 0;
      name[n++] = &words[i + 1];
    }
  if (n < 3) {
    print("names of two pipes are missing\n");
    quit(2);
  }
  auto& host = *new (host_room.bytes) Host(name[1], name[2]);
  const board::Identification who{.board = {'m', 'p', 's', '2', '-', 'a', 'n', '3', '8', '6'},
                                  .firmware = {'0', '.', '1', '.', '0'}};
  run_forever(*new (program_room.bytes) board::Program(who), host);
}

}  // namespace sinew::firmware
