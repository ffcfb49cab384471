// Compares the record of the wires with the table of docs/reference/supervision.md.
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "tests/guards/board_cases.h"

namespace sinew::run {

using experiment::Fault;
using signals::Tick;

namespace {

// docs/reference/supervision.md  [ticks]; one period more, in which a silence or a false reading is
// not yet detected.
constexpr Tick hold_bound = 1'000, vent_bound = 10'000, sensor_bound = 300, period = 100;
constexpr Tick forever = std::numeric_limits<Tick>::max();

bool is_bad(const link::LineCount& line) {
  return line.length + line.crc16 + line.crc32 + line.half + line.skipped > 0;
}

std::string ticks(Tick n) { return std::to_string(n) + " ticks"; }

class Judge {
 public:
  Judge(const Case& c, const Outcome& out, const plant::RemoteBoard& remote, const Monitor& monitor,
        const Proxy& proxy, int lead)
      : case_(c),
        out_(out),
        remote_(remote),
        monitor_(monitor),
        proxy_(proxy),
        // A command is for the period that is `lead` ahead, and good for that and two more.
        word_(hold_bound + (2 + lead) * period),
        silence_(hold_bound + (1 + lead) * period),
        vent_(vent_bound + (1 + lead) * period) {}

  Told told(bool noticed) {
    told_ = {.noticed = noticed, .ended = out_.ended_early()};
    whatever_happens();
    if (proxy_.silent_from() >= 0) silence();
    if (case_.of_angle) angle();
    if (case_.failure.what != plant::BoardFailure::What::none) board();
    if (told_.bound >= 0 && told_.reaction > told_.bound)
      unsafe("an inlet was open " + ticks(told_.reaction) + " after it began; allowed " +
             ticks(told_.bound));
    return std::move(told_);
  }

 private:
  void unsafe(std::string what) { told_.unsafe.push_back(std::move(what)); }

  void whatever_happens() {
    const Monitor::Facts seen = monitor_.facts();
    if (seen.both_open) unsafe("inlet and exhaust of a muscle were open at once");
    if (seen.open_without_run) unsafe("a valve was open while nothing ran");
    if (!seen.at_rest()) unsafe("its valves do not come to rest");
    if (seen.unheard > word_)
      unsafe("an inlet was open " + ticks(seen.unheard) +
             " after the last word of the host; allowed " + ticks(word_));
    if (case_.is_sound && (told_.noticed || told_.ended))
      unsafe("nothing was wrong, and it tripped at something");
  }

  // No air enters 100 ms after the host fell silent, and 1 s after it all air is vented.
  void silence() {
    const Tick from = proxy_.silent_from();
    // One that receives commands again runs on.
    const auto end = static_cast<Tick>(1e4 * (case_.from + std::min(case_.lasts, 10.0)));
    if (end > from + silence_) {
      told_.reaction = std::max<Tick>(monitor_.last_inlet(from, end) - from, 0);
      told_.bound = silence_;
    }
    if (end < from + vent_) return;
    // Not the vent at the beginning of a run.
    const Tick vented = monitor_.vented(from + vent_bound - 10 * period);
    if (vented < 0 || vented > from + vent_)
      unsafe("a machine whose host is silent was " +
             (vented < 0 ? "not vented" : "vented after " + ticks(vented - from)));
  }

  // An angle's wire is broken or shorted: venting after three scans.
  void angle() {
    const Fault& f = case_.experiment.faults.front();
    if (f.what != Fault::What::open && f.what != Fault::What::shorted) return;
    if (!out_.ended_early()) unsafe("an angle without a wire was believed");
    const Tick began = static_cast<Tick>(1e4 * f.at);
    told_.bound = sensor_bound + period;
    const Tick vented = monitor_.vented(began);
    if (vented < 0) unsafe("an angle without a wire, and the machine was not vented");
    told_.reaction = std::max(monitor_.last_inlet(began, forever), vented) - began;
  }

  void board() {
    const Tick at = monitor_.facts().failure;
    if (at < 0) return;  // the run was over
    const bool stalls = case_.failure.what == plant::BoardFailure::What::stall;
    if (stalls && case_.failure.ticks < 100) return missed_ticks(at);
    if (!told_.noticed) unsafe("nobody has noticed that the board began anew");
    if (!stalls) return;
    if (remote_.fault() != control::BoardFault::watchdog || monitor_.facts().has_current)
      unsafe("a board that hung is not reset by its watchdog with all coils without current");
  }

  // Two or more: inlets are closed in the first tick after them, and the host receives a report.
  void missed_ticks(Tick at) {
    const Tick missed = case_.failure.ticks;
    const Tick shut = monitor_.inlets_shut(at);
    told_.bound = 1;
    told_.reaction = shut < 0 ? 10'000 : std::max<Tick>(shut - at - missed, 0);
    const auto worst = static_cast<Tick>(out_.supervised.worst_gap);
    if (out_.supervised.gaps == 0 || worst < missed - 1 || worst > missed + 1)
      unsafe("it missed " + ticks(missed) + ", and the host knows of " + ticks(worst));
  }

  const Case& case_;
  const Outcome& out_;
  const plant::RemoteBoard& remote_;
  const Monitor& monitor_;
  const Proxy& proxy_;
  Tick word_, silence_, vent_;
  Told told_;
};

}  // namespace

bool was_noticed(const Outcome& out, const plant::RemoteBoard& remote, bool by_clock) {
  const link::LinkStatistics& there = remote.line_there();
  bool sensors = out.supervised.rejected > 0;
  for (const control::SensorStatistics& s : out.supervised.sensor) sensors |= s.rejected > 0;
  const bool late = out.lost > 0 || there.late > 0;
  return out.ended_early() || (late && !by_clock) || sensors || out.controller.late > 0 ||
         out.supervised.gaps > 0 || out.supervised.rejected_commands > 0 || is_bad(remote.line()) ||
         is_bad(there.line) || there.lost + there.repeated > 0;
}

Told judge(const Case& c, const Outcome& out, const plant::RemoteBoard& remote,
           const Monitor& monitor, const Proxy& proxy, int lead) {
  const bool good_line = c.down == Spoil::nothing && c.up == Spoil::nothing;
  const bool noticed = was_noticed(out, remote, good_line && lead > 0);
  return Judge(c, out, remote, monitor, proxy, lead).told(noticed);
}

// --- the table ----------------------------------------------------------------------------------

void Sums::add(const Case& c, const Told& told) {
  for (const std::string& what : told.unsafe)
    ADD_FAILURE() << c.name << ", SINEW_GUARD_SEED=" << c.seed << ": " << what;
  Sum& sum = sums_[c.name];
  ++sum.cases;
  sum.noticed += told.noticed;
  sum.ended += told.ended;
  sum.slowest = std::max(sum.slowest, told.reaction);
  sum.bound = std::max(sum.bound, told.bound);
}

void Sums::print() const {
  for (const auto& [name, s] : sums_) {
    std::printf("guard: %-32s %4d cases, %4d noticed, %4d ended", name.c_str(), s.cases, s.noticed,
                s.ended);
    if (s.bound >= 0)
      std::printf(", slowest %.1f ms of %.1f", 0.1 * static_cast<double>(s.slowest),
                  0.1 * static_cast<double>(s.bound));
    std::printf("\n");
  }
}

}  // namespace sinew::run
