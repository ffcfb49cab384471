// run/setup/valve_text.h - what a valve lets pass, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "sinew/gas/valve_flow.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// What a valve makes of the duty that it is asked for, both a share of the period.
struct Delivered {
  double duty = 0, delivered = 0;
};

// Holds the times that a volume takes, and in words what its air exchanges with the walls.
struct Transfers {
  std::string exchange;
  std::vector<gas::Transfer> times;
};

// Return lines of text: its flow and delays; how long a volume [m3] takes between the pressures of
// `flow`; what it makes of duties at a frequency, in the words that were asked with. Of none there
// is no text. `shown`: in whose units, where somebody asked for some; gauges count from the `room`
// [Pa].
std::string text_of(const gas::Valve& valve, const gas::ValveFlow& flow,
                    const units::ShownUnits* shown = nullptr);
std::string text_of(const std::vector<Transfers>& times, double volume, const gas::ValveFlow& flow,
                    const units::ShownUnits* shown = nullptr, double room = units::atmosphere);
std::string text_of(const std::vector<Delivered>& duties, const std::string& frequency);

// Returns a sentence where the flow is the straight line that is there for integration: near equal
// pressures it is far below the law. Empty elsewhere.
std::string doubt_of(const gas::Valve& valve, const gas::ValveFlow& flow);

// Returns all of it as an object of JSON, in SI.
std::string json_of(const gas::Valve& valve, const gas::ValveFlow& flow,
                    const std::vector<Transfers>& times, const std::vector<Delivered>& duties);

}  // namespace sinew::run
