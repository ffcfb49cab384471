// experiment/fault_parts.h - the parts of a machine that can break, and the words of the list
// [[fault]] for what can happen to each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

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

}  // namespace sinew::experiment
