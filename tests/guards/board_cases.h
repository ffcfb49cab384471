// tests/guards/board_cases.h - faults between a host, a board and its machine, drawn from a seed,
// and the reactions that docs/reference/supervision.md promises.
//
// A case is run by a test that has a board: boards_test.cpp the program in a thread of its own,
// boards_emulated_test.cpp the real firmware in QEMU.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sinew/run/simulation/remote_boards.h"
#include "sinew/run/simulation/run.h"
#include "tests/guards/board_line.h"
#include "tests/guards/board_monitor.h"

namespace sinew::run {

struct Case {
  unsigned seed = 0;
  experiment::Experiment experiment;
  std::string name;  // of the fault
  Spoil down = Spoil::nothing, up = Spoil::nothing;
  double share = 0, from = 0, lasts = 1e9;  // of the line's disturbance [s]
  double board_at = -1;                     // when a fault occurs at the board [s]
  plant::BoardFailure failure;              // its kind
  bool is_sound = false;                    // there is no fault
  bool of_angle = false;                    // an angle's sensor fails
};

// The experiments of the cases.
const std::vector<experiment::Experiment>& board_scripts();

// A case of a line, a machine, or a board that is reset.
Case draw(unsigned seed);
// Lines, machines, boards and cases without a fault in turn, and the kinds of each in turn: a few
// seeds cover all of them. A board may be reset, hang, or miss some ticks.
Case draw_by_turns(unsigned seed);

// The line of a case: a test passes every portion of bytes through it.
class Proxy {
 public:
  // In lock step a board waits for its host as a period begins: that is when a host sends.
  Proxy(const Case& c, Monitor& monitor, bool in_lock_step);

  void starts() { runs_ = true; }  // the run: before and after it bytes pass unchanged
  void ends() { runs_ = false; }
  bool active() const;
  // To the board, from a line that leads to it.
  bool write(const plant::BoardLine& line, std::span<const std::uint8_t> bytes);
  // To the host.
  std::vector<std::uint8_t> up(std::vector<std::uint8_t> bytes);
  // A period after the last message that came through before a line that falls silent kept one
  // back; -1: it has kept none. A host that receives nothing either sends its next one much later.
  signals::Tick silent_from() const { return silent_from_; }

 private:
  signals::Tick now() const;

  Case case_;
  Monitor* monitor_;
  bool in_lock_step_;
  Spoiler down_, up_;
  bool runs_ = false;
  signals::Tick last_word_ = 0, silent_from_ = -1;
};

// --- the result ---------------------------------------------------------------------------------

struct Told {
  std::vector<std::string> unsafe;  // violations
  bool noticed = false, ended = false;
  signals::Tick reaction = -1, bound = -1;  // where the table has one [ticks]
};

// Has the host detected a fault? A computer that is late with a command or misses a period of
// telemetry does not count where `by_clock`.
bool was_noticed(const Outcome& out, const plant::RemoteBoard& remote, bool by_clock);

// Compares the record of the wires with docs/reference/supervision.md. Commands are sent `lead`
// periods ahead.
Told judge(const Case& c, const Outcome& out, const plant::RemoteBoard& remote,
           const Monitor& monitor, const Proxy& proxy, int lead);

// The table at a campaign's end: a row for each kind of fault.
class Sums {
 public:
  // Fails the test where something is unsafe.
  void add(const Case& c, const Told& told);
  void print() const;

 private:
  struct Sum {
    int cases = 0, noticed = 0, ended = 0;
    signals::Tick slowest = -1, bound = -1;
  };
  std::map<std::string, Sum> sums_;
};

// The seeds of a campaign: 1 to SINEW_GUARD_COUNT or `usual`, or the one of SINEW_GUARD_SEED.
struct Seeds {
  unsigned first = 1, last = 1;
};
int guard_count(int usual);
Seeds seeds(int usual);

}  // namespace sinew::run
