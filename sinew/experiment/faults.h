// experiment/faults.h - the list [[fault]] of an experiment as a whole: what is wrong with it, and
// how it is told.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

// The parts of a machine that can break, and the words of the list [[fault]] for what can happen to
// each.

struct FaultPart {
  // transducer: a sensor of the test stand, which none of the words is for
  enum class Kind { sensor, valve, regulator, muscle, supply, transducer };
  std::string name;
  Kind kind = Kind::sensor;
  int index = 0;  // of its kind; valves: 2 x muscle + (0 inlet | 1 exhaust), the cylinder's behind
};

// Returns every part, by the name that a fault's `of` gives it: of a test stand those of its air.
std::vector<FaultPart> fault_parts(const Experiment& experiment);

// Returns what a valve is to the list [[fault]], by its name among `valves`.
FaultPart::Kind kind_of_valve(std::span<const gas::Valve> valves, const std::string& name);

// Returns the part of that name, of several the one that the fault's word is for.
std::optional<FaultPart> part_of(const Fault& fault, const std::vector<FaultPart>& parts);

// A word of the list [[fault]], and what happens to a part by it.
struct FaultWord {
  Fault::What what;
  std::string_view text;
};

// Returns what can happen to a part of that kind.
std::span<const FaultWord> words_of(FaultPart::Kind kind);
bool has_word(FaultPart::Kind kind, Fault::What what);
std::string_view word_of(Fault::What what);

// Adds what cannot be: parts that do not exist, words of other parts, two faults of one part of the
// air at a time.
void check_faults(const Experiment& experiment, std::vector<robot::Contradiction>& out);

// The same of the faults of a machine with these parts.
void check_faults(std::span<const Fault> faults, const std::vector<FaultPart>& parts,
                  std::vector<robot::Contradiction>& out);

// Returns where the log has whether a fault acts, "/true/valve/hip_flexor/inlet/fault".
std::string topic_of(const Fault& fault);

// The faults of one part, by their topic in the log.
struct FaultsOfPart {
  std::string topic;
  std::vector<Fault> faults;

  // Answers whether one of them acts at a time or has acted in the period before it [s]: a part of
  // the air may be broken for less than a sample.
  bool acted(double time, double period) const;
};

// Describes that topic for a part of the air.
inline constexpr const char* fault_description =
    "1 where one of the experiment's acts or has acted since the last sample";

// Returns the faults by their parts, in the order of the list.
std::vector<FaultsOfPart> by_part(std::span<const Fault> faults);

// "hip_flexor.inlet stuck open from 3 s to 3.2 s", "hip_flexor leaking (0.1 mm2) from 1 s on".
std::string in_words(const Fault& fault);

// Returns why a fault changes nothing of a run that ends at `end`, at a tick: it begins too late,
// its amount is 0, or it falls between two readings of its sensor. Empty: it acts.
std::string why_idle(const Experiment& experiment, const Fault& fault, signals::Tick end);

// The same of a fault that acts whenever its time comes.
std::string why_idle(const Fault& fault, signals::Tick end);

}  // namespace sinew::experiment
