// firmware/lock_step.cpp - a board's program in the emulator, in lock step with the simulation of a
// host: the state of the valves is written to a pipe, readings of the converter come from another.
// The emulated machine waits while the host computes, so that both have the same time.
#include <array>

#include "firmware/board.h"
#include "firmware/cortex_m.h"
#include "firmware/host_pipes.h"
#include "sinew/control/board/program.h"

namespace sinew::firmware {

namespace {

namespace record = board::record;

struct NoTicks {
  void block() noexcept {}
  void allow() noexcept {}
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
    host.put(cortex_m::deepest_stack());
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

[[noreturn]] void run_forever(board::Program& program, Host& host) {
  board::Outputs last;
  for (;;) {
    const board::Outputs out = program.begin_tick([&] { wait(program, host); });
    if (out != last) host.put_valves(run_tick(program), out.open, out.current, out.supply);
    last = out;
    if (const signals::Conversion* c = program.due()) {
      const Host::Converted from = host.convert(run_tick(program), c->channel.index);
      program.take(*c, {from.number, static_cast<signals::Status>(from.status)});
    }
    (void)program.end_tick();
  }
}

}  // namespace

// Runs the program. Its command line: the program's name, the pipe to the host, the pipe from the
// host.
void run() {
  asm volatile("" : : "r"(board::lock_step_image));  // keeps the mark in the image
  std::array<const char*, 3> name;
  if (command_words(name) < 3) {
    print("names of two pipes are missing\n");
    quit(2);
  }
  const board::Identification who{.board = {'m', 'p', 's', '2', '-', 'a', 'n', '3', '8', '6'},
                                  .firmware = {'0', '.', '1', '.', '0'}};
  run_forever(program_room.make(who), host_room.make(name[1], name[2]));
}

}  // namespace sinew::firmware
