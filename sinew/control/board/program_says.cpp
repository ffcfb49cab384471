// What a board says: answers, telemetry, events, edges and the log of a fault.
#include "sinew/control/board/program.h"

namespace sinew::board {

using control::BoardFault;
using control::BoardState;
using link::Code;
using link::Event;
using signals::Edge;
using signals::Tick;

void Program::say(std::uint8_t type, std::span<const std::uint8_t> body) noexcept {
  std::array<std::uint8_t, link::max_frame> frame;
  const std::size_t size = link::encode(type, {who_.number, sequence_}, body, frame);
  if (size == 0 || !line_.push({frame.data(), size})) {
    ++dropped_;
    return;
  }
  ++sequence_;
}

template <class M>
void Program::say(const M& message) noexcept {
  const link::Body body = link::body_of(message);
  if (body.ok) say(static_cast<std::uint8_t>(M::type), body.span());
}

link::LinkSeen Program::line_seen() const noexcept {
  return {.line = decoder_.line(),
          .refused = refused_,
          .lost = window_.lost(),
          .repeated = window_.repeated(),
          .late = late_};
}

void Program::answer() noexcept {
  if (step_due_) {
    step_due_ = false;
    return answer_words();
  }
  if (frame_ == nullptr) return;
  const link::Frame frame = *frame_;
  frame_ = nullptr;
  if ((code_ == Code::done && quiet_) || code_ == Code::sequence) return;
  link::Answer out{
      .to = frame.type, .sequence = frame.envelope.sequence, .code = code_, .value = value_};
  for (const char* c = why_; c != nullptr && *c != 0 && out.letters < link::max_text; ++c)
    out.text[out.letters++] = *c;
  say(out);
}

void Program::answer_words() noexcept {
  using What = link::WordStep::What;
  std::array<std::uint8_t, 32> bytes;
  std::size_t n = 0;
  if (step_.what == What::readings) {
    n = link::write_readings(step_, thesis_, safety_.machine(), telemetry_.seen, bytes);
  } else {
    const char one = step_.what == What::ready ? link::ready_for_16
                     : step_.what == What::bad ? link::bad_command
                                               : link::finished;
    bytes[n++] = static_cast<std::uint8_t>(one);
  }
  if (!line_.push({bytes.data(), n})) ++dropped_;
}

// With the ticks kept away: what they change is copied.
bool Program::gather() noexcept {
  if (!event_due_) tell_state();
  if (!edges_due_) gather_edges();
  return event_due_ || edges_due_;
}

// One event for each state that is entered, with why.
void Program::tell_state() noexcept {
  const BoardState state = safety_.state();
  if (started_told_ && state == told_) return;
  event_ = {.tick = now_,
            .what = started_told_ ? Event::What::state : Event::What::started,
            .state = state,
            .fault = safety_.fault()};
  started_told_ = true;
  told_ = state;
  event_due_ = true;
  const bool bad = state == BoardState::vent || state == BoardState::dump;
  if (bad && safety_.fault() != BoardFault::asked) log_stops_ = true;
}

// Edges of one message are less than 65,536 ticks apart.
void Program::gather_edges() noexcept {
  if (edge_count_ == 0) return;
  edges_ = {.tick = edge_[0].at};
  std::size_t n = 0;
  for (; n < edge_count_ && n < link::max_edges; ++n) {
    const Edge& e = edge_[n];
    const Tick offset = e.at - edges_.tick;
    if (offset > 0xffff) break;
    edges_.edge[n] = {static_cast<std::uint16_t>(offset), e.valve.index, e.open, e.level};
  }
  edges_.count = static_cast<std::uint8_t>(n);
  for (std::size_t i = n; i < edge_count_; ++i) edge_[i - n] = edge_[i];
  edge_count_ -= n;
  edges_due_ = true;
}

// One message of each kind at a time, so that a long one delays none.
bool Program::speak() noexcept {
  if (event_due_) say(event_);
  if (edges_due_) say(edges_);
  event_due_ = edges_due_ = false;
  if (identity_wanted_)
    say(link::Identity{.state = safety_.state(),
                       .firmware = who_.firmware,
                       .board = who_.board,
                       .configuration = configuration_,
                       .configuration_bytes = link::configuration_size,
                       .joints = control::max_joints,
                       .channels = control::max_channels,
                       .conversions = control::max_conversions,
                       .tick = now_,
                       .fault = safety_.fault(),
                       .active_low = who_.active_low});
  identity_wanted_ = false;
  if (log_wanted_) speak_log();
  if (!speaking_.load(std::memory_order_acquire)) return log_wanted_;

  if (readings_wanted_) say(link::readings_alone(telemetry_));
  readings_wanted_ = false;
  const link::TelemetryMessage part = link::part_of(telemetry_, part_);
  if (part.body.ok) say(static_cast<std::uint8_t>(part.type), part.body.span());
  if (!log_stopped_ && telemetry_.state > BoardState::armed) {
    if (part_ == 0) log_.begin_period(logged_periods);
    log_.add(static_cast<std::uint8_t>(part.type), part.body.span());
  }
  if (++part_ < link::parts_of(telemetry_.joints, telemetry_.channels)) return true;
  log_stopped_ = log_stopped_ || (log_stops_ && telemetry_.state > BoardState::hold);
  speaking_.store(false, std::memory_order_release);
  return log_wanted_;
}

// A record at a time, as long as the line has room for them; one without data says that there is
// nothing more.
void Program::speak_log() noexcept {
  if (line_.room() < 2 * link::max_frame) return;
  link::FaultLog out{.part = static_cast<std::uint16_t>(log_from_),
                     .parts = static_cast<std::uint16_t>(log_.records())};
  log_wanted_ = log_from_ < log_.records();
  if (log_wanted_) {
    const auto record = log_.record(log_from_++);
    out.kind = record.kind;
    out.count = record.size < link::max_logged ? record.size : link::max_logged;
    for (std::size_t i = 0; i < out.count; ++i) out.data[i] = log_.byte(record.place + i);
  }
  say(out);
}

}  // namespace sinew::board
