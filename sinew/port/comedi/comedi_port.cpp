#include "sinew/port/comedi/comedi_port.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cmath>

#include "sinew/control/supervise/output_stage.h"
#include "sinew/host/module.h"

namespace sinew::plant {

using signals::Reading;
using signals::Status;
using signals::Tick;

namespace {

// Delay of the loop behind its tick at which the machine is no longer driven
// (docs/reference/supervision.md) [ticks].
constexpr Tick too_late = 100;
// Consecutive failed conversions of a channel that end a run.
constexpr int too_many = 3;

std::int64_t nanoseconds(Tick ticks) {
  return static_cast<std::int64_t>(
      std::llround(1e9 * signals::tick_seconds * static_cast<double>(ticks)));
}

// Blocks signals that would end the program for as long as an object of this class exists.
class Undisturbed {
 public:
  Undisturbed() noexcept {
    sigset_t all;
    sigemptyset(&all);
    for (const int s : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&all, s);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~Undisturbed() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Undisturbed(const Undisturbed&) = delete;
  Undisturbed& operator=(const Undisturbed&) = delete;

 private:
  sigset_t before_{};
};

std::string what_to_do(const std::string& said) {
  if (said.find("denied") != said.npos)
    return "; this user may not open it: sudo usermod -aG iocard $USER, then log in again";
  if (said.find("No such") != said.npos)
    return "; is the card's driver loaded? lsmod | grep comedi, then dmesg | tail";
  return "";
}

}  // namespace

const SinewCard& card_functions() {
  void* module = host::open_module("sinew_comedi.so");
  if (!module)
    throw CardError(
        "this program was built without comedi, or libcomedi is not installed; try: apt-get "
        "install libcomedi-dev, then cmake --preset release && cmake --build --preset all");
  const auto get =
      reinterpret_cast<const SinewCard* (*)()>(host::function_of(module, "sinew_card_1"));
  if (!get)
    throw CardError("sinew_comedi.so is of another version of Sinew; build and install both again");
  return *get();
}

ComediPort::ComediPort(const std::string& device, CardMachine machine, const host::TickTimer& beat)
    : functions_(&card_functions()),
      device_(device),
      machine_(std::move(machine)),
      beat_(&beat),
      last_(machine_.inputs.size()),
      bad_in_a_row_(machine_.inputs.size()) {
  for (const CardMachine::Output& o : machine_.outputs) {
    if (o.bit < 0) continue;
    const std::uint32_t mask = 1u << o.bit;
    bits_ |= mask;
    if (o.vents && !o.inverted) vent_ |= mask;
    if (o.inlet) inlets_ |= mask;
  }
  open();
  try {
    fit();
  } catch (...) {
    functions_->close(card_);
    throw;
  }
}

ComediPort::~ComediPort() {
  if (started_ && !stopped_) (void)stop(0);
  (void)write(0);
  functions_->close(card_);
}

void ComediPort::refuse(const std::string& what) const { throw CardError(device_ + ": " + what); }

void ComediPort::open() {
  card_ = functions_->open(device_.c_str());
  if (card_) return;
  const std::string said = functions_->error_text();
  refuse(said + what_to_do(said));
}

// Throws CardError if the card does not fit, before an output is touched.
void ComediPort::fit() {
  int bits = 0, channels = 0;  // numbers count from 0
  for (const auto& o : machine_.outputs) bits = std::max(bits, o.bit + 1);
  for (const auto& i : machine_.inputs) channels = std::max(channels, i.channel + 1);
  if (!functions_->find_subdevices(card_, machine_.full_scale, bits, &facts_))
    refuse(functions_->error_text());
  board_ = facts_.board;
  fit_inputs(channels);
  if (facts_.output < 0) refuse(board_ + ": found no digital output; expected one for each valve");
  if (facts_.outputs < bits)
    refuse(
        fmt::format("{}: found {} digital outputs in a subdevice; expected {}, as a valve is on "
                    "bit {}; try another card, or other bits",
                    board_, facts_.outputs, bits, bits - 1));
  take_outputs();
}

void ComediPort::fit_inputs(int channels) {
  if (facts_.input < 0) refuse(board_ + ": found no analog input; expected a converter");
  if (facts_.inputs < channels)
    refuse(
        fmt::format("{}: found {} analog inputs; expected {}, as a sensor is on channel {}; try "
                    "another card, or sensor.<name>.channel",
                    board_, facts_.inputs, channels, channels - 1));
  if (facts_.range < 0)
    refuse(
        fmt::format("{}: found {:g} to {:g} V for its widest range; expected one over 0 to {:g} "
                    "V, the transducers' (converter.full_scale)",
                    board_, facts_.low, facts_.high, machine_.full_scale));
  const double step = (facts_.high - facts_.low) / std::max(facts_.top, 1u);
  const double wanted = machine_.full_scale / machine_.top;
  if (step > wanted * 1.001)
    refuse(
        fmt::format("{}: found steps of {:.3g} mV; expected {:.3g} mV or finer, the robot's "
                    "(converter.bits, converter.full_scale)",
                    board_, 1e3 * step, 1e3 * wanted));
  gain_ = step / wanted;
  offset_ = facts_.low / wanted;
}

// Configures the needed lines as outputs. All coils are without current before and after.
void ComediPort::take_outputs() {
  const auto failed = [this] { refuse(std::string("the outputs: ") + functions_->error_text()); };
  if (!functions_->own(card_, facts_.output))
    refuse(fmt::format("the outputs: {}; has another program the card?", functions_->error_text()));
  if (!write(0)) failed();
  for (const auto& o : machine_.outputs)
    if (o.bit >= 0 && !functions_->make_output(card_, facts_.output, o.bit))
      refuse(fmt::format("{} on bit {} cannot be made an output: {}", o.valve, o.bit,
                         functions_->error_text()));
  // A card may forget what was written while its lines were inputs.
  if (!write(0)) failed();
}

// Switches the current of the valves' coils, one bit each. A bit is electrical, as an edge is:
// whether current opens or shuts a valve is known to the controller only.
bool ComediPort::write(std::uint32_t coils) noexcept {
  return functions_->write(card_, facts_.output, bits_,
                           control::drive_word(coils, 0, machine_.active_low) & bits_);
}

Status ComediPort::start(const signals::Scan&) noexcept {
  started_ = true;
  stopped_ = vented_ = false;
  coils_ = 0;
  why_ = Why::nothing;
  venting_since_ = dead_ = -1;
  std::ranges::fill(bad_in_a_row_, 0);
  watch_the_vent(0);
  if (write(coils_)) return Status::ok;
  why_ = Why::write;
  return Status::fault;
}

// Returns whether the loop keeps its time. Once it was too late the result stays false. It is
// checked before each write, since pulses that should be apart would be written together.
bool ComediPort::on_time() noexcept {
  if (why_ == Why::nothing && beat_->behind() >= too_late) why_ = Why::behind;
  return why_ == Why::nothing;
}

Status ComediPort::drive(signals::Edge edge) noexcept {
  if (!on_time()) return Status::fault;
  const CardMachine::Output& output = machine_.outputs[edge.valve.index];
  if (output.bit < 0) return Status::ok;
  const std::uint32_t mask = 1u << output.bit;
  const std::uint32_t coils = edge.open ? coils_ | mask : coils_ & ~mask;
  if (!write(coils)) {
    why_ = Why::write;
    return Status::fault;
  }
  coils_ = coils;
  watch_the_vent(edge.at);
  return Status::ok;
}

// Records whether the machine has vented: a run that ended normally has vented by itself, and
// stop() need not vent again.
void ComediPort::watch_the_vent(Tick at) noexcept {
  if (coils_ == vent_) {
    if (venting_since_ < 0) venting_since_ = at;
    return;
  }
  if (venting_since_ >= 0 && at - venting_since_ >= machine_.vent) vented_ = true;
  venting_since_ = -1;
  if ((coils_ & inlets_) != 0) vented_ = false;
}

// Counts a failed conversion. drive() continues after it, since the controller vents the machine.
Reading ComediPort::bad(std::size_t channel, Status status) noexcept {
  if (++bad_in_a_row_[channel] >= too_many && dead_ < 0) dead_ = static_cast<int>(channel);
  return {last_[channel], dead_ < 0 ? status : Status::fault};
}

Reading ComediPort::read(signals::Channel channel, Tick) noexcept {
  std::uint16_t& last = last_[channel.index];
  if (!on_time() || dead_ >= 0) return {last, Status::fault};
  const std::int64_t before = host::now_ns();
  std::uint32_t n = 0;
  const bool good = functions_->convert(card_, facts_.input, machine_.inputs[channel.index].channel,
                                        facts_.range, &n);
  if (host::now_ns() - before > nanoseconds(1)) return bad(channel.index, Status::late);
  if (!good) return bad(channel.index, Status::invalid);
  const double count = offset_ + gain_ * n;
  last = static_cast<std::uint16_t>(
      std::clamp(std::floor(count + 0.5), 0.0, static_cast<double>(machine_.top)));
  bad_in_a_row_[channel.index] = 0;
  return {last, Status::ok};
}

// Vents and shuts all valves. It continues after a failed write: one valve that still obeys is
// better than none.
bool ComediPort::vent_and_rest() noexcept {
  bool good = true;
  if (!vented_) {
    good = write(vent_);
    host::sleep_until_ns(host::now_ns() + nanoseconds(machine_.vent));
  }
  return write(0) && good;
}

Status ComediPort::stop(Tick now) noexcept {
  if (stopped_) return Status::ok;
  const Undisturbed until_it_is_safe;
  stopped_ = true;
  if (venting_since_ >= 0 && now - venting_since_ >= machine_.vent) vented_ = true;
  if (vent_and_rest()) return why_ == Why::nothing ? Status::ok : Status::fault;
  if (why_ == Why::nothing) why_ = Why::write;
  return Status::fault;
}

std::string ComediPort::problem() const {
  if (why_ == Why::write)
    return device_ +
           ": the card does not take what is to be written to its outputs: shut the air off, no "
           "valve can be relied on";
  if (why_ == Why::behind)
    return fmt::format(
        "{}: this computer came {} ms late or more, and the machine was vented; see sinew doctor",
        device_, nanoseconds(too_late) / 1'000'000);
  if (dead_ >= 0)
    return fmt::format("{}: {} conversions of {} in a row failed or took longer than a tick",
                       device_, too_many, machine_.inputs[static_cast<std::size_t>(dead_)].sensor);
  return "";
}

}  // namespace sinew::plant
