#include "sinew/control/board/program.h"

#include <new>

namespace sinew::board {

using control::BoardFault;
using control::BoardState;
using link::Code;
using link::Event;
using link::Type;
using signals::Conversion;
using signals::Edge;
using signals::Reading;
using signals::Tick;

namespace {

constexpr std::uint8_t of(Type type) noexcept { return static_cast<std::uint8_t>(type); }

// Copies the parts that telemetry has for that many joints and channels; a tick has no time to copy
// the rest.
void copy(const control::ControllerState& from, control::ControllerState& to, std::size_t joints,
          std::size_t channels) noexcept {
  to.phase = from.phase;
  for (std::size_t j = 0; j < joints; ++j) to.joint[j] = from.joint[j];
  for (std::size_t i = 0; i < channels; ++i) to.reading[i] = from.reading[i];
  to.late = from.late;
  to.invalid = from.invalid;
  to.missed = from.missed;
  to.overruns = from.overruns;
  to.fault = from.fault;
  to.fault_channel = from.fault_channel;
}

void copy(const control::Supervised& from, control::Supervised& to, std::size_t channels) noexcept {
  for (std::size_t i = 0; i < channels; ++i) to.sensor[i] = from.sensor[i];
  to.rejected = from.rejected;
  to.rejected_commands = from.rejected_commands;
  to.gaps = from.gaps;
  to.worst_gap = from.worst_gap;
  to.holding = from.holding;
  to.holds = from.holds;
  to.trip = from.trip;
}

constexpr control::ControllerState no_controller;
constexpr control::Supervised nothing_supervised;

}  // namespace

Program::Program(const Identification& who) noexcept
    : who_(who), safety_(who.reset_by_watchdog), nonce_(who.nonce) {}

bool Program::runs() const noexcept {
  const BoardState state = safety_.state();
  return state == BoardState::running || state == BoardState::hold || state == BoardState::vent;
}

bool Program::at_rest() const noexcept {
  return safety_.state() == BoardState::fault || safety_.state() == BoardState::idle ||
         safety_.state() == BoardState::dump;
}

// --- a tick -------------------------------------------------------------------------------------

// Returns whether a period begins, including the one of a run's first command.
bool Program::begins_period() noexcept {
  safety_.begin(now_);
  if (starts_ && safety_.state() == BoardState::armed) return true;
  if (runs()) return safety_.starts_period(now_);
  if (++idle_ticks_ < 100) return false;
  idle_ticks_ = 0;
  return true;
}

// Records the telemetry of the period that begins. If the last one is not completely sent yet, it
// is kept and the host sees a gap.
void Program::record_telemetry() noexcept {
  if (telemetry_pending_.load(std::memory_order_acquire)) {
    ++dropped_;
    return;
  }
  const Tick run = safety_.run_tick(now_);
  telemetry_.tick = run < 0 ? now_ : run;
  telemetry_.state = safety_.state();
  telemetry_.fault = safety_.fault();
  const control::Supervisor* c = run < 0 ? nullptr : safety_.controller();
  copy(c ? c->state() : no_controller, telemetry_.controller, telemetry_.joints,
       telemetry_.channels);
  copy(c ? c->supervised() : nothing_supervised, telemetry_.supervised, telemetry_.channels);
  if (c == nullptr) {
    for (std::uint8_t i = 0; i < telemetry_.channels; ++i) {
      telemetry_.controller.reading[i] = safety_.reading(i);
      telemetry_.supervised.sensor[i].counts = safety_.reading(i).counts;
    }
  }
  telemetry_.link = link_statistics();
  part_ = 0;
  telemetry_pending_.store(true, std::memory_order_release);
}

void Program::apply_command() noexcept {
  const bool starts = safety_.state() == BoardState::armed;
  if (starts ? !starts_ : !runs()) return;
  const Tick run = starts ? 0 : safety_.run_tick(now_);
  const link::CommandFor* current = queue_.at(run);
  command_begun_ = run;
  starts_ = false;
  bool ends = false;
  // A command changes the setpoints once, even if it is valid for several periods.
  if (current != nullptr && current->from != applied_from_) {
    for (std::size_t j = 0; j < current->joints; ++j) held_.joint[j] = current->joint[j];
    applied_from_ = current->from;
    ends = current->ends;
  }
  if (current != nullptr || changed_) safety_.command(held_, now_);
  for (control::JointCommand& c : held_.joint)
    if (c.timed) c.openings = {};
  changed_ = false;
  if (ends) safety_.finish(now_);
}

Outputs Program::drive() noexcept {
  for (const Edge& edge : safety_.edges(now_)) {
    if (!edges_wanted_) continue;
    if (edge_count_ < edge_.size())
      edge_[edge_count_++] = edge;
    else
      ++edges_lost_;
  }
  return {.open = safety_.open(now_),
          .current = safety_.state() != BoardState::dump,
          .supply = safety_.supply()};
}

void Program::take(const Conversion& conversion, Reading reading) noexcept {
  safety_.take(conversion, reading, now_);
}

bool Program::end_tick() noexcept {
  const bool feed = safety_.end(now_);
  ++now_;
  return feed;
}

// --- messages of a host -------------------------------------------------------------------------

std::size_t Program::receive(std::span<const std::uint8_t> bytes) noexcept {
  const std::size_t n = bytes.size() < in_.room() ? bytes.size() : in_.room();
  in_.push(bytes.first(n));
  return n;
}

void Program::silent() noexcept {
  if (in_.size() > 0) return;
  decoder_.silent();
  if (thesis_reader_ && thesis_reader_->silent()) {
    step_ = {.what = link::ThesisByteResult::What::bad};
    step_due_ = true;
  }
}

bool Program::next_frame() noexcept {
  if (step_due_) return true;
  if ((frame_ = decoder_.next()) != nullptr) return true;
  while (in_.size() > 0) {
    std::array<std::uint8_t, 1> byte;
    in_.pop(byte);
    if (thesis_reader_) {
      step_ = thesis_reader_->take(byte[0]);
      if (step_.what == link::ThesisByteResult::What::nothing) continue;
      if (step_.what != link::ThesisByteResult::What::frame) return step_due_ = true;
    }
    decoder_.push(byte);
    if ((frame_ = decoder_.next()) != nullptr) return true;
  }
  return false;
}

void Program::execute_request() noexcept {
  if (step_due_) return execute_thesis_request();
  quiet_ = false;
  refusal_ = nullptr;
  value_ = 0;
  code_ = check_frame();
  if (code_ == Code::done) code_ = act();
  if (code_ != Code::done) ++refused_;
}

// Checks the address, sequence and version of a frame. Frames to other boards are ignored.
Code Program::check_frame() noexcept {
  const std::uint8_t to = frame_->envelope.board;
  const bool identify = frame_->type == of(Type::identify);
  const bool shut_down = frame_->type == of(Type::shut_down);
  if (to != who_.number && !(to == link::every_board && (identify || shut_down))) {
    frame_ = nullptr;
    return Code::done;
  }
  if (frame_->version != link::protocol_version) return Code::version;
  if (identify && at_rest()) window_.restart();
  const bool is_new = window_.take(frame_->envelope.sequence);
  return is_new || shut_down || identify ? Code::done : Code::sequence;
}

Code Program::act() noexcept {
  if (frame_ == nullptr) return Code::done;
  switch (static_cast<Type>(frame_->type)) {
    case Type::identify:
      quiet_ = identity_wanted_ = true;
      return link::Code::done;
    case Type::read_sensors:
      quiet_ = readings_wanted_ = true;
      return Code::done;
    case Type::edges_wanted: {
      link::EdgesWanted m;
      const Code code = link::decode(*frame_, m);
      if (code == Code::done) edges_wanted_ = m.wanted;
      return code;
    }
    case Type::read_fault_log: {
      link::ReadFaultLog m;
      const Code code = link::decode(*frame_, m);
      if (code != Code::done) return code;
      log_from_ = m.from;
      return quiet_ = log_wanted_ = true, Code::done;
    }
    case Type::heartbeat:
      safety_.note_host_alive(now_);
      quiet_ = true;
      return Code::done;
    case Type::clear_fault:
      safety_.clear(false, now_);
      return safety_.clear(true, now_) ? Code::done : Code::state;
    case Type::shut_down:
      safety_.shut_down(now_);
      return Code::done;
    default:
      return act_on_run();
  }
}

Code Program::act_on_run() noexcept {
  switch (static_cast<Type>(frame_->type)) {
    case Type::arm_first: {
      link::ArmFirst m;
      const Code code = link::decode(*frame_, m);
      return code == Code::done ? arm(m) : code;
    }
    case Type::arm_second: {
      link::ArmSecond m;
      const Code code = link::decode(*frame_, m);
      return code == Code::done ? arm(m) : code;
    }
    case Type::command: {
      link::CommandFor m;
      const Code code = link::decode(*frame_, m);
      return code == Code::done ? command(m) : code;
    }
    case Type::set_gains: {
      link::SetGains m;
      const Code code = link::decode(*frame_, m);
      return code == Code::done ? change(m.joint, &m, nullptr) : code;
    }
    case Type::set_feedforward: {
      link::SetFeedforward m;
      const Code code = link::decode(*frame_, m);
      return code == Code::done ? change(m.joint, nullptr, &m) : code;
    }
    case Type::enable: {
      link::Enable m;
      const Code code = link::decode(*frame_, m);
      return code == Code::done ? enable(m) : code;
    }
    default:
      return act_on_configuration();
  }
}

Code Program::act_on_configuration() noexcept {
  switch (static_cast<Type>(frame_->type)) {
    case Type::configure_begin: {
      link::ConfigureBegin m;
      const Code code = link::decode(*frame_, m);
      if (code != Code::done) return code;
      return at_rest() ? receiver_.take(m) : Code::state;
    }
    case Type::configure_chunk: {
      link::ConfigureChunk m;
      const Code code = link::decode(*frame_, m);
      if (code != Code::done) return code;
      return at_rest() ? receiver_.take(m) : Code::state;
    }
    case Type::configure_end: {
      link::ConfigureEnd m;
      const Code code = link::decode(*frame_, m);
      return code == Code::done ? configure(m) : code;
    }
    case Type::thesis_words: {
      link::ThesisWords m;
      const Code code = link::decode(*frame_, m);
      if (code != Code::done) return code;
      if (m.on && !thesis_.found) return Code::configuration;
      thesis_reader_.reset();
      if (m.on) thesis_reader_.emplace(thesis_);
      return Code::done;
    }
    default:
      return Code::type;
  }
}

Code Program::configure(const link::ConfigureEnd& end) noexcept {
  if (!at_rest()) return Code::state;
  const link::Refusal refusal = receiver_.take(end, incoming_);
  refusal_ = refusal.words;
  if (refusal.code != Code::done) return refusal.code;
  refusal_ = safety_.configure(incoming_.joint_controller, incoming_.limits, incoming_.safety);
  if (refusal_ != nullptr) return Code::configuration;
  configuration_ = end.crc;
  thesis_ = link::thesis_joints(incoming_.joint_controller);
  thesis_reader_.reset();
  new (&queue_) link::CommandQueue(incoming_.joint_controller.period);  // too large for the stack
  telemetry_.joints = static_cast<std::uint8_t>(incoming_.joint_controller.joints);
  telemetry_.channels = link::channels_of(incoming_.joint_controller);
  return Code::done;
}

Code Program::arm(const link::ArmFirst& m) noexcept {
  if (configuration_ == 0 || m.configuration != configuration_) return Code::nonce;
  if (!safety_.arm_first(now_)) return Code::state;
  value_ = ++nonce_;
  return Code::done;
}

Code Program::arm(const link::ArmSecond& m) noexcept {
  if (m.configuration != configuration_ || m.nonce != nonce_) return Code::nonce;
  if (!safety_.arm_second(now_)) return Code::state;
  new (&queue_) link::CommandQueue(safety_.machine().period);
  held_ = control::rest_command(safety_.machine());
  starts_ = changed_ = false;
  applied_from_ = -1;
  log_.clear();
  log_stops_ = log_stopped_ = false;
  edge_count_ = 0;
  return Code::done;
}

// Queues a command. An armed board first accepts only the command that begins a run.
Code Program::command(const link::CommandFor& m) noexcept {
  const bool armed = safety_.state() == BoardState::armed;
  if (!armed && safety_.state() != BoardState::running && safety_.state() != BoardState::hold)
    return Code::state;
  if (armed && !starts_ && m.from != 0) return Code::period;
  if (m.joints > telemetry_.joints) return Code::value;
  quiet_ = true;
  const Tick begun = armed ? -Tick{safety_.machine().period} : command_begun_;
  const Code code = queue_.put(m, begun);
  late_ += code == Code::past;
  starts_ = starts_ || (armed && code == Code::done);
  return code;
}

Code Program::change(std::size_t joint, const link::SetGains* gains,
                     const link::SetFeedforward* duties) noexcept {
  if (at_rest()) return Code::state;
  if (joint >= telemetry_.joints) return Code::value;
  if (gains != nullptr) held_.joint[joint].gains = gains->gains;
  if (duties != nullptr) {
    held_.joint[joint].duties = duties->duties;
    held_.joint[joint].open_loop = true;
    held_.joint[joint].timed = false;
  }
  changed_ = true;
  return Code::done;
}

Code Program::enable(const link::Enable& m) noexcept {
  if (at_rest()) return Code::state;
  for (std::size_t j = 0; j < telemetry_.joints; ++j)
    if (m.joints >> j & 1u) held_.joint[j].enabled = m.enabled;
  changed_ = true;
  return Code::done;
}

void Program::execute_thesis_request() noexcept {
  using What = link::ThesisByteResult::What;
  if (step_.what == What::shut_down) safety_.shut_down(now_);
  if (step_.what != What::enable && step_.what != What::feedforward && step_.what != What::desired)
    return;
  Code code = Code::state;
  if (step_.what == What::enable) code = enable(step_.enable);
  if (step_.what == What::feedforward)
    code = change(step_.feedforward.joint, nullptr, &step_.feedforward);
  if (step_.what == What::desired && !at_rest()) {
    step_.apply(held_);
    changed_ = true;
    code = Code::done;
  }
  if (code != Code::done) step_.what = What::bad;
}

// --- what a board sends: replies, telemetry, events, edges and the log of a fault ---

void Program::send(std::uint8_t type, std::span<const std::uint8_t> body) noexcept {
  std::array<std::uint8_t, link::max_frame> frame;
  const std::size_t size = link::encode(type, {who_.number, sequence_}, body, frame);
  if (size == 0 || !line_.push({frame.data(), size})) {
    ++dropped_;
    return;
  }
  ++sequence_;
}

template <class M>
void Program::send(const M& message) noexcept {
  const link::Body body = link::body_of(message);
  if (body.ok) send(static_cast<std::uint8_t>(M::type), body.span());
}

link::LinkStatistics Program::link_statistics() const noexcept {
  return {.line = decoder_.line(),
          .refused = refused_,
          .lost = window_.lost(),
          .repeated = window_.repeated(),
          .late = late_};
}

void Program::send_reply() noexcept {
  if (step_due_) {
    step_due_ = false;
    return send_thesis_reply();
  }
  if (frame_ == nullptr) return;
  const link::Frame frame = *frame_;
  frame_ = nullptr;
  if ((code_ == Code::done && quiet_) || code_ == Code::sequence) return;
  link::Reply out{
      .to = frame.type, .sequence = frame.envelope.sequence, .code = code_, .value = value_};
  for (const char* c = refusal_; c != nullptr && *c != 0 && out.letters < link::max_text; ++c)
    out.text[out.letters++] = *c;
  send(out);
}

void Program::send_thesis_reply() noexcept {
  using What = link::ThesisByteResult::What;
  std::array<std::uint8_t, 32> bytes;
  std::size_t n = 0;
  if (step_.what == What::readings) {
    n = link::write_readings(step_, thesis_, safety_.machine(), telemetry_.controller, bytes);
  } else {
    const char one = step_.what == What::ready ? link::ready_for_16
                     : step_.what == What::bad ? link::bad_command
                                               : link::finished;
    bytes[n++] = static_cast<std::uint8_t>(one);
  }
  if (!line_.push({bytes.data(), n})) ++dropped_;
}

// Copies data that ticks change, while ticks are kept away.
bool Program::gather() noexcept {
  if (!event_due_) gather_event();
  if (!edges_due_) gather_edges();
  return event_due_ || edges_due_;
}

// Reports each new state once, with its reason.
void Program::gather_event() noexcept {
  const BoardState state = safety_.state();
  if (start_reported_ && state == reported_state_) return;
  event_ = {.tick = now_,
            .what = start_reported_ ? Event::What::state : Event::What::started,
            .state = state,
            .fault = safety_.fault()};
  start_reported_ = true;
  reported_state_ = state;
  event_due_ = true;
  const bool bad = state == BoardState::vent || state == BoardState::dump;
  if (bad && safety_.fault() != BoardFault::requested) log_stops_ = true;
}

// Collects edges for one message; they must be less than 65,536 ticks apart.
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

// Sends at most one message of each kind, so that a long one does not delay the others.
bool Program::send_next() noexcept {
  if (event_due_) send(event_);
  if (edges_due_) send(edges_);
  event_due_ = edges_due_ = false;
  if (identity_wanted_)
    send(link::Identity{.state = safety_.state(),
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
  if (log_wanted_) send_log_record();
  if (!telemetry_pending_.load(std::memory_order_acquire)) return log_wanted_;

  if (readings_wanted_) send(link::readings_alone(telemetry_));
  readings_wanted_ = false;
  const link::TelemetryMessage part = link::part_of(telemetry_, part_);
  if (part.body.ok) send(static_cast<std::uint8_t>(part.type), part.body.span());
  if (!log_stopped_ && telemetry_.state > BoardState::armed) {
    if (part_ == 0) log_.begin_period(logged_periods);
    log_.add(static_cast<std::uint8_t>(part.type), part.body.span());
  }
  if (++part_ < link::parts_of(telemetry_.joints, telemetry_.channels)) return true;
  log_stopped_ = log_stopped_ || (log_stops_ && telemetry_.state > BoardState::hold);
  telemetry_pending_.store(false, std::memory_order_release);
  return log_wanted_;
}

// Sends one record of the log if the line has room for it; a record without data marks the end.
void Program::send_log_record() noexcept {
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
  send(out);
}

}  // namespace sinew::board
