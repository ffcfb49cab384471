// run/setup/valve_text.h - flow, delays and duties of a valve as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "sinew/gas/valve_flow.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// A commanded duty and the duty that the valve delivers, both as a share of the period.
struct Delivered {
  double duty = 0, delivered = 0;
};

// The filling times of a volume, and a description of its air's exchange with the walls.
struct Transfers {
  std::string exchange;
  std::vector<gas::Transfer> times;
};

// Return lines of text: the valve's flow and delays; the times of a volume [m3] between the
// pressures of `flow`; the delivered duties at a frequency, which is printed as given. An empty
// list gives no text. `shown` selects the units; gauge pressures are relative to `room` [Pa].
std::string text_of(const gas::Valve& valve, const gas::ValveFlow& flow,
                    const units::ShownUnits* shown = nullptr);
std::string text_of(const std::vector<Transfers>& times, double volume, const gas::ValveFlow& flow,
                    const units::ShownUnits* shown = nullptr, double room = units::atmosphere);
std::string text_of(const std::vector<Delivered>& duties, const std::string& frequency);

// Returns a warning if the flow is in the linear section near equal pressures, which exists for
// integration and is far below the law; else empty.
std::string flow_warning(const gas::Valve& valve, const gas::ValveFlow& flow);

// Returns all values as a JSON object, in SI.
std::string json_of(const gas::Valve& valve, const gas::ValveFlow& flow,
                    const std::vector<Transfers>& times, const std::vector<Delivered>& duties);

}  // namespace sinew::run
