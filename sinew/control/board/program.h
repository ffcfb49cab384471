// control/board/program.h - a controller board's program without its hardware: bytes of a line come
// in and go out, ticks pass, valves and the supply's valve are what it says.
//
// Two sides share it. A timer calls the tick, which takes its time and no more; in the time
// between, serve() works the line off. serve() must not be cut in two by a tick where it says so:
// the hardware gives it a way to keep the ticks away for some hundred instructions (`Ticks`).
//
//   tick:    outputs(program.begin_tick());        valves first: their instant counts
//            if (const Conversion* c = program.due()) program.take(*c, adc());
//            if (program.end_tick()) feed_watchdog();
//   between: program.receive(bytes); while (program.serve(ticks)); program.transmit(buffer);
//
// A run's ticks count from its first command, which the host sends `from` 0 to an armed board.
// Before that, telemetry carries the ticks since the reset.
//
// Embedded core: no heap, no exceptions, no clock.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "sinew/control/board/ring.h"
#include "sinew/control/link/command_queue.h"
#include "sinew/control/link/configuration.h"
#include "sinew/control/link/sequence.h"
#include "sinew/control/link/telemetry.h"
#include "sinew/control/link/thesis_words.h"
#include "sinew/control/supervise/safety.h"

namespace sinew::board {

// What a board says of itself.
struct Identification {
  link::Name board{}, firmware{};
  std::uint8_t number = 1;  // on its line
  std::uint32_t nonce = 1;  // where those of arming begin: another one after each reset
  bool bitten = false;      // the watchdog has reset it
  bool active_low = false;  // its outputs have 0 for current in a coil
};

// What valves and the supply are to have from a tick on.
struct Outputs {
  control::OpenMask open = 0;
  bool current = true;  // false: no coil has any (a dump)
  bool supply = false;  // the dump valve has current

  friend constexpr bool operator==(const Outputs&, const Outputs&) = default;
};

class Program {
 public:
  static constexpr std::size_t line_in = 512, line_out = 4'096, log_size = 12'288;
  static constexpr std::size_t edges_kept = 128, logged_periods = 20;  // 200 ms

  // `who` is what the board says of itself.
  explicit Program(const Identification& who) noexcept;

  // --- a tick ---

  // `told` is called where a run's period begins, between what is said of the last one and the
  // command of this one: where host and board go in lock step it waits for the host.
  template <class Told>
  Outputs begin_tick(Told told) noexcept {
    if (begins_period()) {
      note();
      told();
      obey_command();
    }
    return drive();
  }
  Outputs begin_tick() noexcept {
    return begin_tick([] {});
  }
  // The conversion whose result is there in this tick, or nullptr.
  const signals::Conversion* due() noexcept { return safety_.due(now_); }
  // The conversion that hardware starts in this tick, to be read in a later one, or nullptr.
  const signals::Conversion* begins() const noexcept { return safety_.begins(now_); }
  void take(const signals::Conversion&, signals::Reading) noexcept;
  // All of the tick was worked off and nothing has changed by itself: the watchdog may be fed.
  bool end_tick() noexcept;

  // So many ticks have passed without a call.
  void miss(std::uint32_t ticks) noexcept { now_ += ticks; }

  // --- between ticks ---

  // Returns how many it took.
  std::size_t receive(std::span<const std::uint8_t> bytes) noexcept;
  // No byte has come for longer than one may be late within a frame.
  void silent() noexcept;

  // Works off what has come and puts down what is to be said. `Ticks` has keep_away() and
  // let_come(). True: there is more to do.
  template <class Ticks>
  bool serve(Ticks&& ticks) noexcept {
    const bool more = next_frame();
    ticks.keep_away();
    if (more) obey();
    const bool said = gather();
    ticks.let_come();
    answer();
    return speak() || said || more;
  }

  // The next bytes for the line; how many.
  std::size_t transmit(std::span<std::uint8_t> out) noexcept { return line_.pop(out); }

  // --- for whoever looks ---

  // Returns the board's states and valves; and the tick that it is at.
  const control::Safety& safety() const noexcept { return safety_; }
  signals::Tick now() const noexcept { return now_; }
  std::uint32_t dropped() const noexcept { return dropped_; }  // messages the line had no room for

 private:
  // A tick
  bool begins_period() noexcept;
  void note() noexcept;
  void obey_command() noexcept;
  Outputs drive() noexcept;

  // A host's messages
  bool next_frame() noexcept;
  bool next_word() noexcept;
  void obey() noexcept;
  void obey_word() noexcept;
  link::Code judge() noexcept;
  link::Code act() noexcept;
  link::Code act_on_run() noexcept;
  link::Code act_on_configuration() noexcept;
  link::Code configure(const link::ConfigureEnd&) noexcept;
  link::Code arm(const link::ArmFirst&) noexcept;
  link::Code arm(const link::ArmSecond&) noexcept;
  link::Code command(const link::CommandFor&) noexcept;
  link::Code change(std::size_t joint, const link::SetGains*, const link::SetFeedforward*) noexcept;
  link::Code enable(const link::Enable&) noexcept;
  bool runs() const noexcept;
  bool at_rest() const noexcept;

  // What is said
  template <class M>
  void say(const M& message) noexcept;
  void say(std::uint8_t type, std::span<const std::uint8_t> body) noexcept;
  void answer() noexcept;
  void answer_words() noexcept;
  bool gather() noexcept;
  bool speak() noexcept;
  void speak_log() noexcept;
  void tell_state() noexcept;
  void gather_edges() noexcept;
  link::LinkSeen line_seen() const noexcept;

  Identification who_;
  control::Safety safety_;
  signals::Tick now_ = 0;
  std::uint32_t idle_ticks_ = 0;  // since telemetry without a run

  // A run
  link::CommandQueue queue_{100};
  control::Command held_;            // what holds, with the host's changes
  signals::Tick command_begun_ = 0;  // the period whose command was taken last
  signals::Tick obeyed_ = -1;        // where the one that holds began
  bool starts_ = false;              // a command to begin with has come
  bool changed_ = false;

  // The line's way in
  Ring<line_in> in_;
  link::Decoder decoder_;
  link::SequenceWindow window_;
  const link::Frame* frame_ = nullptr;
  link::Code code_ = link::Code::done;
  const char* why_ = nullptr;
  std::uint32_t value_ = 0;  // of the answer
  bool quiet_ = false;       // done is not answered
  std::uint32_t refused_ = 0, late_ = 0;
  link::ConfigurationReceiver receiver_;
  link::Configuration incoming_;
  std::uint32_t configuration_ = 0;  // crc32; 0: none
  std::uint32_t nonce_ = 0;
  std::optional<link::WordReader> words_;
  link::ThesisJoints thesis_;
  link::WordStep step_;
  bool step_due_ = false;

  // ... and out
  Ring<line_out> line_;
  std::uint8_t sequence_ = 0;
  std::uint32_t dropped_ = 0;
  link::Telemetry telemetry_;
  std::uint8_t part_ = 0;
  std::atomic<bool> speaking_ = false;  // telemetry_ is not whole in the line yet
  bool identity_wanted_ = false, readings_wanted_ = false, log_wanted_ = false;
  std::size_t log_from_ = 0;
  link::Event event_;
  bool event_due_ = false;
  control::BoardState told_ = control::BoardState::fault;
  bool started_told_ = false;

  // Edges of a run, oldest first
  std::array<signals::Edge, edges_kept> edge_;
  std::size_t edge_count_ = 0;
  std::uint32_t edges_lost_ = 0;
  link::Edges edges_;
  bool edges_wanted_ = false, edges_due_ = false;

  // Telemetry of the last 200 ms, until a fault stops it
  Log<log_size> log_;
  bool log_stops_ = false, log_stopped_ = false;
};

}  // namespace sinew::board
