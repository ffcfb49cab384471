#include "sinew/control/supervise/safety.h"

#include "sinew/signals/crc.h"

namespace sinew::control {

using signals::Conversion;
using signals::Edge;
using signals::Reading;
using signals::Status;
using signals::Tick;

namespace {

constexpr std::uint8_t inverse(BoardState state) noexcept {
  return static_cast<std::uint8_t>(~static_cast<std::uint8_t>(state));
}

template <class Config>
constexpr std::uint32_t size_of(const Config&) noexcept {
  return static_cast<std::uint32_t>(sizeof(Config));
}

}  // namespace

const char* problem(const SafetyConfig& c) noexcept {
  if (c.host_hold == 0 || c.host_vent < c.host_hold)
    return "a silent host: hold comes before vent, and neither at once";
  if (c.hold_limit == 0 || c.vent_limit == 0) return "hold and vent need some time";
  if (c.arm_window == 0) return "there is no time for the second frame that arms";
  if (c.empty_scans == 0) return "empty takes at least one scan";
  if (c.check_every == 0) return "parameters are looked at in at least one tick";
  if (c.refractory > 100) return "a valve's refractory time must be 100 ticks at most";
  return nullptr;
}

const char* safety_problem(const JointControllerConfig& machine) noexcept {
  for (std::size_t j = 0; j < machine.joints; ++j) {
    const JointConfig& joint = machine.joint[j];
    if (joint.kind == JointKind::passive) continue;
    for (const MuscleConfig* m : {&joint.flexor, &joint.extensor})
      if (m->present && (m->inlet.index >= max_valves || m->exhaust.index >= max_valves))
        return "a board has 32 valves, numbered from 0";
  }
  const signals::ValveTiming& timing = machine.timing;
  for (std::size_t duty = 1; duty <= signals::max_duty; ++duty)
    if (timing.closing[duty] < timing.closing[duty - 1] ||
        timing.opening[duty] > timing.opening[duty - 1])
      return "the timing table is cut off or not monotone: a longer duty must not end sooner";
  if (machine.conversions == 0) return "a board without sensors cannot observe its machine";
  return nullptr;
}

Safety::Safety(bool reset_by_watchdog) noexcept {
  if (reset_by_watchdog) fault_ = BoardFault::watchdog;
  enter(reset_by_watchdog ? BoardState::dump : BoardState::fault);
}

void Safety::enter(BoardState state) noexcept {
  state_ = state;
  inverse_ = inverse(state);
}

const char* Safety::configure(const JointControllerConfig& machine, const SuperviseConfig& limits,
                              const SafetyConfig& config) noexcept {
  if (state_ == BoardState::armed || runs()) return "valves may move: shut the board down first";
  for (const char* wrong : {control::problem(machine), control::problem(limits),
                            control::problem(config), safety_problem(machine)})
    if (wrong != nullptr) return wrong;
  machine_ = machine;
  limits_ = limits;
  config_ = config;
  run_.reset();
  out_ = OutputStage(machine, config.refractory);
  watched_ = 0;
  for (const std::uint16_t at : config.empty_at) watched_ += at > 0;
  forget_sensors();
  configured_ = true;
  restart_check();
  return nullptr;
}

// --- requests of a host -------------------------------------------------------------------------

bool Safety::clear(bool requested, Tick) noexcept {
  const bool rises = requested && !clear_requested_;
  clear_requested_ = requested;
  if (!rises || (state_ != BoardState::fault && state_ != BoardState::dump)) return false;
  if (configured_ && !sensors_good()) return false;
  fault_ = BoardFault::none;
  if (configured_) restart_check();
  enter(BoardState::idle);
  return true;
}

// Marks all channels as not read yet.
void Safety::forget_sensors() noexcept {
  for (Reading& reading : last_) reading.status = Status::late;
  scan_tick_ = 0;
}

bool Safety::sensors_good() const noexcept {
  for (std::size_t i = 0; i < machine_.conversions; ++i) {
    const std::size_t channel = machine_.conversion[i].channel.index;
    if (channel < max_channels && last_[channel].status != Status::ok) return false;
  }
  return true;
}

bool Safety::arm_first(Tick now) noexcept {
  if (state_ != BoardState::idle || !configured_ || !has_checksum_) return false;
  armed_at_ = now;
  return first_frame_ = true;
}

bool Safety::arm_second(Tick now) noexcept {
  const bool in_time = first_frame_ && now - armed_at_ <= static_cast<Tick>(config_.arm_window);
  first_frame_ = false;
  if (state_ != BoardState::idle || !in_time || !sensors_good()) return false;
  host_alive_at_ = now;
  // This takes more time than a tick of a run has.
  run_.emplace(machine_, limits_).expect_every_tick();
  out_.shut_all();
  for (std::uint32_t& scans : empty_) scans = 0;
  restart_check();
  enter(BoardState::armed);
  return true;
}

bool Safety::command(const Command& command, Tick now) noexcept {
  if (state_ == BoardState::armed) {
    start_ = now;
    enter(BoardState::running);
  }
  if (state_ != BoardState::running && state_ != BoardState::hold) return false;
  host_alive_at_ = now;
  run_->command(command);
  const bool holds = run_->supervised().holding;
  if (holds && state_ == BoardState::running) {
    fail(BoardState::hold, BoardFault::supervisor, now);
  } else if (!holds && state_ == BoardState::hold) {
    fault_ = BoardFault::none;
    enter(BoardState::running);
  }
  return true;
}

void Safety::shut_down(Tick now) noexcept {
  first_frame_ = false;
  if (state_ == BoardState::armed) enter(BoardState::idle);
  if (state_ == BoardState::running || state_ == BoardState::hold)
    vent(BoardFault::requested, Trip::Cause::requested, 0, now);
}

void Safety::finish(Tick now) noexcept {
  if (state_ != BoardState::running && state_ != BoardState::hold) return;
  run_->shut_down(now - start_);
  fail(BoardState::vent, BoardFault::requested, now);
}

// --- faults -------------------------------------------------------------------------------------

void Safety::fail(BoardState state, BoardFault fault, Tick now) noexcept {
  if (state == BoardState::hold) held_since_ = now;
  if (state == BoardState::vent) vent_since_ = now;
  fault_ = fault;
  enter(state);
}

void Safety::vent(BoardFault fault, Trip::Cause cause, std::uint32_t limit, Tick now) noexcept {
  run_->end_run(cause, limit, now - start_);
  fail(BoardState::vent, fault, now);
}

// Dumps. Without current an inverted valve is open, every other one shut. If the constants have
// changed, the host has to send them again.
void Safety::dump(BoardFault fault) noexcept {
  out_.shut_all();
  forget_sensors();
  if (fault == BoardFault::parameters || fault == BoardFault::state) configured_ = false;
  fault_ = fault;
  enter(BoardState::dump);
}

void Safety::watch_host(Tick now) noexcept {
  const Tick silent = now - host_alive_at_;
  if (state_ == BoardState::armed) {
    if (silent < static_cast<Tick>(config_.host_vent)) return;
    fault_ = BoardFault::host_silent;
    enter(BoardState::idle);
    return;
  }
  if (silent >= static_cast<Tick>(config_.host_vent))
    return vent(BoardFault::host_silent, Trip::Cause::host, config_.host_vent, now);
  if (state_ == BoardState::running && silent >= static_cast<Tick>(config_.host_hold)) {
    run_->hold();
    fail(BoardState::hold, BoardFault::host_silent, now);
  }
  if (state_ == BoardState::hold && now - held_since_ >= static_cast<Tick>(config_.hold_limit))
    vent(BoardFault::held_too_long, Trip::Cause::held, config_.hold_limit, now);
}

// Changes to vent if the controller has ended the run by itself.
void Safety::watch_run(Tick now) noexcept {
  const Phase phase = run_->state().phase;
  if (phase != Phase::venting && phase != Phase::off) return;
  const bool supervisor = run_->supervised().trip.cause != Trip::Cause::none;
  fail(BoardState::vent, supervisor ? BoardFault::supervisor : BoardFault::controller, now);
}

void Safety::watch_vent(Tick now) noexcept {
  const bool over = run_->state().phase == Phase::off;
  if (!watches_empty()) {
    if (over) end_vent();
    return;
  }
  bool empty = true;
  for (std::size_t i = 0; i < max_channels; ++i)
    if (config_.empty_at[i] > 0) empty = empty && empty_[i] >= config_.empty_scans;
  if (empty) {
    if (over) end_vent();
    return;
  }
  if (now - vent_since_ >= static_cast<Tick>(config_.vent_limit))
    return dump(BoardFault::not_empty);
  if (over) out_.vent(now);  // longer than the controller vents
}

void Safety::end_vent() noexcept {
  out_.shut_all();
  forget_sensors();
  enter(fault_ == BoardFault::requested ? BoardState::idle : BoardState::fault);
}

// --- parameters ---------------------------------------------------------------------------------

// Returns the constants as they were received, and the copies that the run uses.
Safety::Span Safety::parameters(std::uint8_t which) const noexcept {
  if (which == 0) return {&machine_, size_of(machine_)};
  if (which == 1) return {&limits_, size_of(limits_)};
  if (which == 2) return {&config_, size_of(config_)};
  if (!run_) return {nullptr, 0};
  return which == 3 ? Span{&run_->config(), size_of(run_->config())}
                    : Span{&run_->limits(), size_of(run_->limits())};
}

void Safety::restart_check() noexcept {
  span_ = 0;
  place_ = sum_ = 0;
  has_checksum_ = false;
  std::uint32_t total = 0;
  for (std::uint8_t i = 0; i < spans; ++i) total += parameters(i).size;
  per_tick_ = total / config_.check_every + 1;
}

void Safety::next_parameters() noexcept {
  place_ = 0;
  do ++span_;
  while (span_ < spans && parameters(span_).size == 0);
}

// Checks a few bytes per tick. The first complete check determines the sum that later ones must
// have.
void Safety::check_parameters() noexcept {
  for (std::uint32_t left = per_tick_; left > 0 && span_ < spans;) {
    const Span span = parameters(span_);
    const std::uint32_t rest = span.size - place_, take = left < rest ? left : rest;
    sum_ = signals::crc32({static_cast<const std::uint8_t*>(span.at) + place_, take}, sum_);
    place_ += take;
    left -= take;
    if (place_ == span.size) next_parameters();
  }
  if (span_ < spans) return;
  if (has_checksum_ && sum_ != checksum_) return dump(BoardFault::parameters);
  checksum_ = sum_;
  has_checksum_ = true;
  span_ = 0;
  sum_ = 0;
}

void Safety::begin(Tick now) noexcept {
  begun_ = now;
  waiting_ = false;
  if (inverse_ != inverse(state_)) return dump(BoardFault::state);
  if (configured_) check_parameters();
  if (state_ == BoardState::armed || state_ == BoardState::running || state_ == BoardState::hold)
    watch_host(now);
}

bool Safety::starts_period(Tick now) noexcept {
  return runs() && run_->starts_period(now - start_);
}

std::span<const Edge> Safety::edges(Tick now) noexcept {
  driven_ = now;
  if (!runs()) return {};
  const std::span<const Edge> edges = run_->edges(now - start_);
  for (const Edge& edge : edges) out_.drive(edge);
  if (state_ != BoardState::vent) watch_run(now);
  if (state_ == BoardState::vent) watch_vent(now);
  return edges;
}

// Returns the conversion to read. Outside a run the scan continues by itself.
const Conversion* Safety::due(Tick now) noexcept {
  const Conversion* c = nullptr;
  if (runs()) {
    c = run_->due(now - start_);
  } else if (configured_) {
    if (scan_tick_ == 0) cursor_ = 0;
    if (cursor_ < machine_.conversions && machine_.conversion[cursor_].read == scan_tick_)
      c = &machine_.conversion[cursor_++];
    if (++scan_tick_ >= machine_.period) scan_tick_ = 0;
  }
  waiting_ = c != nullptr;
  return c;
}

// Returns the conversion to start. Outside a run due() has already advanced the scan by a tick.
const Conversion* Safety::begins(Tick now) const noexcept {
  if (runs()) return run_->begins(now - start_);
  if (!configured_ || cursor_ >= machine_.conversions) return nullptr;
  const Conversion& next = machine_.conversion[cursor_];
  return next.start + 1 == scan_tick_ ? &next : nullptr;
}

void Safety::take(const Conversion& conversion, Reading reading, Tick now) noexcept {
  waiting_ = false;
  const std::size_t channel = conversion.channel.index;
  if (channel >= max_channels) return;
  last_[channel] = reading;
  if (runs()) {
    run_->take(conversion, reading, now - start_);
    if (state_ == BoardState::vent) count_empty(channel, reading);
    return;
  }
  const SensorLimits& limit = limits_.sensor[channel];
  const bool possible = reading.counts >= limit.low && reading.counts <= limit.high;
  if (reading.status == Status::ok && !possible) last_[channel].status = Status::invalid;
}

void Safety::count_empty(std::size_t channel, Reading reading) noexcept {
  const bool low = reading.status == Status::ok && reading.counts <= config_.empty_at[channel];
  empty_[channel] = low ? empty_[channel] + 1 : 0;
}

OpenMask Safety::open(Tick now) noexcept {
  opened_ = now;
  return out_.at(now);
}

std::uint32_t Safety::word(Tick now, bool active_low) noexcept {
  const OpenMask open = this->open(now);
  return state_ == BoardState::dump ? rest_word(active_low)
                                    : drive_word(open, out_.inverted(), active_low);
}

bool Safety::end(Tick now) noexcept {
  const bool whole = begun_ == now && driven_ == now && opened_ == now && !waiting_;
  return whole && inverse_ == inverse(state_);
}

}  // namespace sinew::control
