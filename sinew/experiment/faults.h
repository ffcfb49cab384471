// experiment/faults.h - checks and texts for the list [[fault]] of an experiment.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/control/gait/change.h"
#include "sinew/experiment/experiment.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

// Parts of a machine that can fail, and the words of the list [[fault]] for the faults of each.

struct FaultPart {
  // transducer: a sensor of the test stand, which has no kind of fault
  enum class Kind { sensor, valve, regulator, muscle, supply, transducer };
  std::string name;
  Kind kind = Kind::sensor;
  int index = 0;  // in its kind; valves: 2 x muscle + (0 inlet | 1 exhaust), then the cylinder's
};

// Returns every part under the name that a fault's `of` uses; for a test stand, those of its air.
std::vector<FaultPart> fault_parts(const Experiment& experiment);

// Returns the kind of part that the named valve of `valves` is for the list [[fault]].
FaultPart::Kind kind_of_valve(std::span<const gas::Valve> valves, const std::string& name);

// Returns the part of that name; if there are several, the one that can have the fault.
std::optional<FaultPart> part_of(const Fault& fault, const std::vector<FaultPart>& parts);

// A word of the list [[fault]] and the kind of fault that it names.
struct FaultName {
  Fault::What what;
  std::string_view text;
};

// Returns the faults that a part of that kind can have.
std::span<const FaultName> faults_of(FaultPart::Kind kind);
bool can_have(FaultPart::Kind kind, Fault::What what);
std::string_view name_of(Fault::What what);

// Adds errors of the list: unknown parts, faults that a part cannot have, two faults of one part of
// the air at the same time.
void check_faults(const Experiment& experiment, std::vector<robot::Contradiction>& out);

// Checks faults of a machine with these parts.
void check_faults(std::span<const Fault> faults, const std::vector<FaultPart>& parts,
                  std::vector<robot::Contradiction>& out);

// Returns the log's topic that records whether a fault acts, such as
// "/true/valve/hip_flexor/inlet/fault".
std::string topic_of(const Fault& fault);

// Faults of one part, with their topic in the log.
struct FaultsOfPart {
  std::string topic;
  std::vector<Fault> faults;

  // Returns whether a fault acts at a time or has acted in the period before it [s]: a fault of the
  // air may be shorter than a sample.
  bool acted(double time, double period) const;
};

// Description of that topic for a part of the air.
inline constexpr const char* fault_description =
    "1 where one of the experiment's acts or has acted since the last sample";

// Returns the faults grouped by part, in the order of the list.
std::vector<FaultsOfPart> by_part(std::span<const Fault> faults);

// Returns a text such as "hip_flexor.inlet stuck open from 3 s to 3.2 s" or "hip_flexor leaking
// (0.1 mm2) from 1 s on".
std::string to_text(const Fault& fault);

// Returns the reason why a fault has no effect on a run that ends at tick `end`: it begins too
// late, its amount is 0, or it falls between two readings of its sensor. Empty: it acts.
std::string why_idle(const Experiment& experiment, const Fault& fault, signals::Tick end);

// Returns the reason for a fault that does not depend on readings.
std::string why_idle(const Fault& fault, signals::Tick end);

// Returns the reason why a change has no effect on a run that ends at a time [s]: the plan ends
// before its time. Empty: it has.
std::string why_idle(const Experiment& experiment, const gait::Change& change, double end);

}  // namespace sinew::experiment
