#include "sinew/port/hardware/remote_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "sinew/control/link/texts.h"

namespace sinew::plant {

using control::BoardState;
using link::Code;

namespace {

// Time that a reply is waited for, and the number of times that a request is sent.
constexpr double reply_seconds = 0.5;
constexpr int tries = 3;
constexpr double read_seconds = 0.05;  // longest single read, so that signals are noticed
// Time after a run's first command at which it is sent again to a board that is still armed.
constexpr double patience_to_begin = 0.05;

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool runs(BoardState state) noexcept {
  return state == BoardState::running || state == BoardState::hold || state == BoardState::vent;
}

bool is_latched(BoardState state) noexcept {
  return state == BoardState::fault || state == BoardState::dump;
}

const char* to_text(BoardState latched) noexcept {
  return latched == BoardState::dump ? "dump" : "fault";
}

[[noreturn]] void refuse_version(std::uint8_t version) {
  throw BoardError(fmt::format("the board has version {} of the protocol, this program {}", version,
                               link::protocol_version));
}

}  // namespace

std::string fault_found(const link::Identity& who) {
  using control::BoardFault;
  const bool usual = who.fault == BoardFault::none || who.fault == BoardFault::power_up ||
                     who.fault == BoardFault::requested || who.fault == BoardFault::host_silent;
  if (usual || !is_latched(who.state)) return "";
  return fmt::format("the board was in {}: {}", to_text(who.state), link::to_text(who.fault));
}

RemoteBoard::RemoteBoard(BoardLine line, std::uint8_t number, std::uint16_t period)
    : line_(std::move(line)), number_(number), joiner_(period) {
  edge_.reserve(4'096);
  if (!line_.now) line_.now = wall_seconds;
}

// --- frames -------------------------------------------------------------------------------------

template <class M>
bool RemoteBoard::send(const M& message) noexcept {
  std::array<std::uint8_t, link::max_frame> frame;
  const std::size_t size = link::encode(message, {number_, sequence_++}, frame);
  return size > 0 && line_.write({frame.data(), size});
}

// Handles the received frames up to the next telemetry: the joiner keeps only one. Returns whether
// there was a frame.
bool RemoteBoard::process_frames() noexcept {
  bool heard = false;
  while (telemetry_ == nullptr) {
    if (const link::Frame* frame = decoder_.next()) {
      handle_frame(*frame);
      heard = true;
    } else if (first_ < end_) {
      first_ += decoder_.push(std::span(bytes_).subspan(first_, end_ - first_));
    } else {
      break;
    }
  }
  return heard;
}

// Reads the line at most once. Returns false if nothing arrived in that time or the line is closed.
bool RemoteBoard::listen(double seconds) noexcept {
  if (process_frames()) return true;
  const std::ptrdiff_t n = line_.read(bytes_, seconds);
  if (n < 0) why_ = Why::closed;
  if (n <= 0) return false;
  first_ = 0;
  end_ = static_cast<std::size_t>(n);
  (void)process_frames();
  return true;
}

void RemoteBoard::store_edges(const link::Edges& edges) noexcept {
  for (std::size_t i = 0; i < edges.count && edge_.size() < edge_.capacity(); ++i) {
    const link::ReportedEdge& e = edges.edge[i];
    edge_.push_back({edges.tick + e.offset, {e.valve}, e.open, e.level});
  }
}

// Takes records in order. Records after a lost one are ignored, since the lost one is requested
// again.
void RemoteBoard::store_log_record(const link::FaultLog& record) {
  if (record.part != fault_log_.size()) return;
  if (record.count > 0)
    fault_log_.push_back(record);
  else
    logged_all_ = record.part == record.parts;
}

void RemoteBoard::handle_frame(const link::Frame& frame) noexcept {
  if (frame.envelope.board != number_) return;
  if (frame.version != link::protocol_version) other_version_ = frame.version;
  if (link::FaultLog m; wants_log_ && link::decode(frame, m) == Code::done) store_log_record(m);
  if (link::Reply m; link::decode(frame, m) == Code::done) {
    reply_ = m;
    if (m.code != Code::done) refusal_ = m;
  }
  if (link::Identity m; link::decode(frame, m) == Code::done) identity_ = m;
  if (link::Edges m; link::decode(frame, m) == Code::done) store_edges(m);
  if (link::Event m; link::decode(frame, m) == Code::done) {
    state_ = m.state;
    fault_ = m.fault;
  }
  if (const link::Telemetry* t = joiner_.take(frame.type, frame.body)) {
    telemetry_ = t;
    state_ = t->state;
    fault_ = t->fault;
    line_there_ = t->link;
  }
}

// --- before a run -------------------------------------------------------------------------------

// Reads like listen(), and throws if the line is closed or the wait is to be given up. A board that
// streams always has data, so a caller's loop must also check the time.
void RemoteBoard::listen_or_throw(double seconds) {
  telemetry_ = nullptr;
  (void)listen(std::min(seconds, read_seconds));
  if (why_ == Why::closed) throw BoardError("the line to the board is gone");
  if (stops_ && stops_()) throw BoardStopped();
}

// Sends a message and returns its reply. Either may be lost: the message is then sent again in
// another frame.
template <class M>
link::Reply RemoteBoard::request(const M& message) {
  for (int i = 0; i < tries; ++i) {
    reply_.reset();
    const std::uint8_t sequence = sequence_;
    if (!send(message)) break;
    const double until = now() + reply_seconds;
    for (double left = reply_seconds; left > 0; left = until - now()) {
      listen_or_throw(left);
      if (reply_ && reply_->to == static_cast<std::uint8_t>(M::type) &&
          reply_->sequence == sequence)
        return *reply_;
    }
  }
  throw BoardError(
      fmt::format("board {} does not reply: is it on this line, at this rate?", number_));
}

void RemoteBoard::refuse(const link::Reply& reply, const std::string& what) const {
  const std::string_view words(reply.text.data(), reply.letters);
  throw BoardError(fmt::format("board {} refuses {}: {}{}{}", number_, what,
                               link::to_text(reply.code), words.empty() ? "" : ": ", words));
}

link::Identity RemoteBoard::identify() {
  identity_.reset();
  for (int i = 0; i < tries && !identity_; ++i) {
    if (!send(link::Identify{})) break;
    const double until = now() + reply_seconds;
    for (double left = reply_seconds; left > 0 && !identity_; left = until - now())
      listen_or_throw(left);
  }
  if (identity_) return *identity_;
  if (other_version_) refuse_version(*other_version_);
  const link::LineCount& came = decoder_.line();
  if (came.frames > 0)
    throw BoardError(fmt::format("board {} is not among the boards on the line", number_));
  if (came.skipped > 0)
    throw BoardError(
        "what comes over the line are no frames of ours: is it another rate, or another device?");
  throw BoardError("no reply: is the board powered, and this its line?");
}

// Sends one transfer, up to the first message that is refused. Returns the last reply.
link::Reply RemoteBoard::transfer(const link::ConfigurationSender& sender) {
  link::Reply reply = request(sender.begin());
  for (std::size_t i = 0; i < sender.chunks && reply.code == Code::done; ++i)
    reply = request(sender.chunk(i));
  return reply.code == Code::done ? request(sender.end()) : reply;
}

// If a reply was lost, the board receives a message twice; a host that was ended may have left a
// transfer unfinished. The board refuses both with `order`, and the transfer begins again.
void RemoteBoard::configure(const link::Configuration& configuration) {
  const link::ConfigurationSender sender(configuration);
  if (!sender.ok()) throw BoardError("the configuration has a number that a board cannot have");
  link::Reply reply = transfer(sender);
  for (int i = 1; i < tries && (reply.code == Code::order || reply.code == Code::gap); ++i)
    reply = transfer(sender);
  if (reply.code != Code::done) refuse(reply, "its configuration");
  configuration_ = sender.crc();
}

// Returns whether the board reports this state before its next telemetry.
bool RemoteBoard::is_seen(BoardState state, double seconds) {
  const double until = now() + seconds;
  do listen_or_throw(0.01);
  while (state_ != state && telemetry_ == nullptr && now() < until);
  return state_ == state;
}

// Sends a message until it is accepted. The board refuses with `state` until it has readings of its
// sensors and has checked its memory.
template <class M>
void RemoteBoard::request_until_done(const M& message, double seconds, const std::string& what) {
  constexpr double pause = 0.02;
  const double until = now() + seconds;
  for (;;) {
    const link::Reply reply = request(message);
    if (reply.code == Code::done) return;
    if (reply.code != Code::state || now() >= until) refuse(reply, what);
    // The board has left its fault already if the reply to an earlier try was lost.
    if (M::type == link::Type::clear_fault && is_seen(BoardState::idle, pause)) return;
    for (const double end = now() + pause; now() < end;) listen_or_throw(0.01);
  }
}

void RemoteBoard::clear_fault() {
  if (state_ == BoardState::idle) return;
  request_until_done(link::ClearFault{}, 1.0, "to leave its fault");
}

// Sends both frames. Returns the reply to the second.
link::Reply RemoteBoard::arm_twice() {
  request_until_done(link::ArmFirst{configuration_}, 1.0, "to be armed");
  return request(link::ArmSecond{reply_->value, configuration_});
}

// If the reply to the second frame was lost, the board is armed and refuses the repeated frame; if
// the frame came too late, both are sent again.
void RemoteBoard::arm() {
  for (int i = 1;; ++i) {
    const link::Reply second = arm_twice();
    if (second.code == Code::done || is_seen(BoardState::armed, 2 * read_seconds)) return;
    if (i == tries) refuse(second, "to be armed");
  }
}

void RemoteBoard::refuse_as_found(const link::Identity& who) const {
  if (runs(who.state) || who.state == BoardState::armed)
    throw BoardError("the board is in a run already: is another program at this line?");
  if (expected_low_ && *expected_low_ != who.active_low) {
    const auto level = [](bool low) { return low ? "low" : "high"; };
    throw BoardError(
        fmt::format("wiring.polarity: found \"{0} opens\"; expected \"{1} opens\": this board's "
                    "outputs are {1} for current in a coil, so that with the other drivers all "
                    "coils have current while it is at rest; a program that was built for this "
                    "robot (sinew firmware build), or other drivers",
                    level(*expected_low_), level(who.active_low)));
  }
  if (is_latched(who.state) && needs_diagnosis(who.fault) && !may_clear_)
    throw BoardError(
        fmt::format("the board is in {}: {}; find the cause, then send clear_fault, or switch "
                    "the board off and on",
                    to_text(who.state), link::to_text(who.fault)));
}

link::Identity RemoteBoard::prepare(const link::Configuration& configuration) {
  if (why_ != Why::closed) why_ = Why::none;
  const link::Identity who = identify();
  if (who.protocol != link::protocol_version) refuse_version(who.protocol);
  state_ = who.state;
  fault_ = who.fault;
  refuse_as_found(who);
  configure(configuration);
  clear_fault();
  const link::Reply edges = request(link::EdgesWanted{true});
  if (edges.code != Code::done) refuse(edges, "to report its edges");
  arm();
  has_run_ = false;
  beginning_.reset();
  edge_.clear();
  return who;
}

const link::Telemetry* RemoteBoard::wait_for_telemetry(double seconds) {
  telemetry_ = nullptr;
  const double until = now() + seconds;
  for (double left = seconds; telemetry_ == nullptr && left > 0; left = until - now())
    listen_or_throw(left);
  return telemetry_;
}

// --- a run --------------------------------------------------------------------------------------

bool RemoteBoard::command(const link::CommandFor& command) noexcept {
  if (!has_run_ && command.from == 0) {
    beginning_ = command;
    begins_again_ = now() + patience_to_begin;
  }
  return send(command);
}

std::span<const signals::Edge> RemoteBoard::edges() noexcept { return edge_; }

// Sends a run's first command again if an armed board reports that it did not receive it. A
// board that did receive it refuses the repeated command as past.
void RemoteBoard::begin_again() noexcept {
  if (has_run_ || !beginning_ || state_ != BoardState::armed || now() < begins_again_) return;
  begins_again_ = now() + patience_to_begin;
  (void)send(*beginning_);
}

const link::Telemetry* RemoteBoard::next(double seconds) noexcept {
  constexpr double step = 0.01;
  edge_.clear();
  const double until = now() + seconds;
  while (why_ == Why::none || why_ == Why::silent) {
    telemetry_ = nullptr;
    (void)listen(step);
    if (telemetry_ != nullptr && runs(telemetry_->state)) {
      has_run_ = true;
      why_ = Why::none;
      return telemetry_;
    }
    const bool rests = telemetry_ != nullptr && !runs(telemetry_->state);
    if (has_run_ && rests && why_ != Why::closed) why_ = Why::over;
    if (why_ == Why::none && now() >= until) {
      why_ = Why::silent;
      return nullptr;
    }
    if (rests) begin_again();
  }
  return nullptr;
}

bool RemoteBoard::shut_down() noexcept {
  constexpr double longest = 6, longest_silence = 1.5, again = 0.5;
  const double begun = now();
  double heard = begun, sends = begun;
  while (why_ != Why::closed) {
    if (state_ <= BoardState::idle || state_ == BoardState::dump) return true;
    const double time = now();
    if (time - begun >= longest || time - heard >= longest_silence) break;
    if (time >= sends) {
      if (state_ != BoardState::vent) (void)send(link::ShutDown{});
      sends = time + again;
    }
    telemetry_ = nullptr;
    (void)listen(0.01);
    if (telemetry_ != nullptr) heard = now();
  }
  return false;
}

// --- after a run --------------------------------------------------------------------------------

std::vector<link::Telemetry> RemoteBoard::fault_log() {
  constexpr double silence = 0.3;  // between two records
  constexpr int most = 20;         // requests in all
  fault_log_.clear();
  logged_all_ = false;
  wants_log_ = true;
  for (int i = 0; i < most && !logged_all_ && why_ != Why::closed; ++i) {
    if (!send(link::ReadFaultLog{static_cast<std::uint16_t>(fault_log_.size())})) break;
    for (double until = now() + silence; !logged_all_ && why_ != Why::closed && now() < until;) {
      const std::size_t had = fault_log_.size();
      telemetry_ = nullptr;
      (void)listen(0.01);
      if (stops_ && stops_()) break;
      if (fault_log_.size() > had) until = now() + silence;
    }
    if (stops_ && stops_()) break;
  }
  wants_log_ = false;
  if (!logged_all_) throw BoardError("the board's log of its fault did not come whole");

  std::vector<link::Telemetry> out;
  link::TelemetryJoiner joiner(1);
  for (const link::FaultLog& record : fault_log_)
    if (const link::Telemetry* t = joiner.take(record.kind, {record.data.data(), record.count}))
      out.push_back(*t);
  return out;
}

}  // namespace sinew::plant
