// control/board/program.h - a controller board's program without its hardware: bytes of a line are
// received and sent, ticks pass, and outputs for the valves and the supply's valve are returned.
//
// It runs in two contexts. A timer calls the tick, which has a bounded time; between ticks serve()
// handles the line. Parts of serve() must not be interrupted by a tick: the hardware provides
// functions that keep ticks away for some hundred instructions (`Ticks`).
//
//   tick:    outputs(program.begin_tick());        valves first, since they need exact timing
//            if (const Conversion* c = program.due()) program.take(*c, adc());
//            if (program.end_tick()) feed_watchdog();
//   between: program.receive(bytes); while (program.serve(ticks)); program.transmit(buffer);
//
// A run's ticks count from its first command, which the host sends to an armed board with `from` 0.
// Before that, telemetry has the ticks since the reset.
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
#include "sinew/control/link/thesis_bytes.h"
#include "sinew/control/supervise/safety.h"

namespace sinew::board {

// Identity of a board.
struct Identification {
  link::Name board{}, firmware{};
  std::uint8_t number = 1;         // number of the board on its line
  std::uint32_t nonce = 1;         // start of the numbers for arming, different after each reset
  bool reset_by_watchdog = false;  // the watchdog has reset the board
  bool active_low = false;         // level 0 gives current in a coil
};

// Outputs for valves and supply from a tick on.
struct Outputs {
  control::OpenMask open = 0;
  bool current = true;  // false: all coils are without current (a dump)
  bool supply = false;  // the dump valve has current

  friend constexpr bool operator==(const Outputs&, const Outputs&) = default;
};

class Program {
 public:
  static constexpr std::size_t line_in = 512, line_out = 4'096, log_size = 12'288;
  static constexpr std::size_t edges_kept = 128, logged_periods = 20;  // 200 ms

  // `who` is the board's identity.
  explicit Program(const Identification& who) noexcept;

  // --- a tick ---

  // Starts a tick. `exchange` is called at the start of a period, between the report of the last
  // period and the command of the new one: in lock step it waits for the host.
  template <class Exchange>
  Outputs begin_tick(Exchange exchange) noexcept {
    if (begins_period()) {
      record_telemetry();
      exchange();
      apply_command();
    }
    return drive();
  }
  Outputs begin_tick() noexcept {
    return begin_tick([] {});
  }
  // Returns the conversion whose result is due in this tick, or nullptr.
  const signals::Conversion* due() noexcept { return safety_.due(now_); }
  // Returns the conversion that the hardware starts in this tick and that is read later, or
  // nullptr.
  const signals::Conversion* begins() const noexcept { return safety_.begins(now_); }
  void take(const signals::Conversion&, signals::Reading) noexcept;
  // Returns whether the tick was complete and memory is unchanged, so that the watchdog may be fed.
  bool end_tick() noexcept;

  // Counts ticks that have passed without a call.
  void miss(std::uint32_t ticks) noexcept { now_ += ticks; }

  // --- between ticks ---

  // Takes received bytes. Returns the number taken.
  std::size_t receive(std::span<const std::uint8_t> bytes) noexcept;
  // Notes that no byte has come for longer than allowed within a frame.
  void silent() noexcept;

  // Handles received bytes and prepares messages. `Ticks` has block() and allow(). Returns
  // whether there is more to do.
  template <class Ticks>
  bool serve(Ticks&& ticks) noexcept {
    const bool more = next_frame();
    ticks.block();
    if (more) execute_request();
    const bool gathered = gather();
    ticks.allow();
    send_reply();
    return send_next() || gathered || more;
  }

  // Takes the next bytes for the line. Returns their number.
  std::size_t transmit(std::span<std::uint8_t> out) noexcept { return line_.pop(out); }

  // --- state ---

  // Return the board's states and valves, and the current tick.
  const control::Safety& safety() const noexcept { return safety_; }
  signals::Tick now() const noexcept { return now_; }
  std::uint32_t dropped() const noexcept { return dropped_; }  // messages lost for lack of room

 private:
  // A tick
  bool begins_period() noexcept;
  void record_telemetry() noexcept;
  void apply_command() noexcept;
  Outputs drive() noexcept;

  // messages of a host
  bool next_frame() noexcept;
  bool next_word() noexcept;
  void execute_request() noexcept;
  void execute_thesis_request() noexcept;
  link::Code check_frame() noexcept;
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

  // messages of the board
  template <class M>
  void send(const M& message) noexcept;
  void send(std::uint8_t type, std::span<const std::uint8_t> body) noexcept;
  void send_reply() noexcept;
  void send_thesis_reply() noexcept;
  bool gather() noexcept;
  bool send_next() noexcept;
  void send_log_record() noexcept;
  void gather_event() noexcept;
  void gather_edges() noexcept;
  link::LinkStatistics link_statistics() const noexcept;

  Identification who_;
  control::Safety safety_;
  signals::Tick now_ = 0;
  std::uint32_t idle_ticks_ = 0;  // since the last telemetry outside a run

  // A run
  link::CommandQueue queue_{100};
  control::Command held_;            // current command, including the host's changes
  signals::Tick command_begun_ = 0;  // start of the last period whose command was taken
  signals::Tick applied_from_ = -1;  // `from` of the current command
  bool starts_ = false;              // a first command has come
  bool changed_ = false;

  // receiving
  Ring<line_in> in_;
  link::Decoder decoder_;
  link::SequenceWindow window_;
  const link::Frame* frame_ = nullptr;
  link::Code code_ = link::Code::done;
  const char* refusal_ = nullptr;
  std::uint32_t value_ = 0;  // sequence number of the reply
  bool quiet_ = false;       // no reply to a message that is done
  std::uint32_t refused_ = 0, late_ = 0;
  link::ConfigurationReceiver receiver_;
  link::Configuration incoming_;
  std::uint32_t configuration_ = 0;  // crc32; 0: none
  std::uint32_t nonce_ = 0;
  std::optional<link::ThesisByteReader> thesis_reader_;
  link::ThesisJoints thesis_;
  link::ThesisByteResult step_;
  bool step_due_ = false;

  // sending
  Ring<line_out> line_;
  std::uint8_t sequence_ = 0;
  std::uint32_t dropped_ = 0;
  link::Telemetry telemetry_;
  std::uint8_t part_ = 0;
  std::atomic<bool> telemetry_pending_ = false;  // telemetry_ is not completely sent yet
  bool identity_wanted_ = false, readings_wanted_ = false, log_wanted_ = false;
  std::size_t log_from_ = 0;
  link::Event event_;
  bool event_due_ = false;
  control::BoardState reported_state_ = control::BoardState::fault;
  bool start_reported_ = false;

  // edges of a run, oldest first
  std::array<signals::Edge, edges_kept> edge_;
  std::size_t edge_count_ = 0;
  std::uint32_t edges_lost_ = 0;
  link::Edges edges_;
  bool edges_wanted_ = false, edges_due_ = false;

  // telemetry of the last 200 ms, until a fault stops it
  Log<log_size> log_;
  bool log_stops_ = false, log_stopped_ = false;
};

}  // namespace sinew::board
