// design/air.h - how long a robot walks on its own air, 5.1, 6.4, 7.1: what it takes, what a store
// yields (gas/storage.h), and the time, steps and distance that follow.
//
//   t = (m_use - m_fill)/(q - q_c)     n = t q/m_n                d = t q/m_d
//
//   m_use   air that the store yields down to the lowest pressure in the line [kg]
//   m_fill  air that fills the machine before it walks [kg]
//   q       consumption [kg/s]          q_c   flow of the compressor [kg/s]
//   m_n     per step [kg]               m_d   per metre [kg/m]
//
//   q = n f (rho(p) V(L_s) - rho(0) V(L_l) + (rho(p) - rho(0)) V_ext)      of muscles that are
//   filled
//                                                                          and vented in turn
//
//   n    muscles        f    fillings of each per second [1/s]     p    gauge pressure when full
//   [Pa] L_l, L_s   lengths when vented and when full [m]               rho  P/(R T) [kg/m3]
//
// Valid for a steady consumption and air at the temperature of the room. A muscle that is vented
// only in part takes less.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/gas/air.h"
#include "sinew/gas/storage.h"

namespace sinew::design {

// Consumption of a machine; a number is NaN if unknown.
struct AirUse {
  double per_second = 0;  // [kg/s]
  double per_step = 0;    // [kg]
  double per_metre = 0;   // [kg/m]
  double filling = 0;     // before the first step [kg]
};

// A bottle or tank behind a regulator; pressures are absolute.
struct AirStore {
  double volume = 0;    // [m3]
  double pressure = 0;  // pressure of the full store, absolute [Pa]
  double lowest = 0;    // in the line, at which the machine stops [Pa]
};

// Air that a store yields, for the two limits of heat exchange with its walls.
struct Yield {
  double air = 0;  // [kg]
  gas::AirLeft left;
};

// Return the yield with walls at the temperature of the room, and with walls that pass no heat. The
// yield is zero if the store's pressure is below the lowest one.
Yield yield_at_room_temperature(const AirStore& store, const gas::Air& air);
Yield yield_without_heat(const AirStore& store, const gas::Air& air);

// Duration of a store; a number is NaN if the consumption lacks what it needs, and infinite if the
// store is never empty.
struct Lasting {
  double time = 0;      // [s]
  double steps = 0;     // [-]
  double distance = 0;  // [m]
};

// Returns the duration of an amount of air [kg] together with a compressor's flow [kg/s].
Lasting lasting(double air, const AirUse& use, double compressor_flow);

// Returns the air that fills one muscle, vented at one length and full at another [kg]. `pressure`
// is gauge; `external_volume` is that of its hose and fittings [m3].
double air_of_filling(const actuator::Actuator& a, double external_volume, double vented_length,
                      double full_length, double pressure, const gas::Air& air);

// Throws config::Error about a setting if the muscle cannot have that length: below its shortest or
// above its longest one. `written` is the setting's text, empty if the length is a default.
void require_length(const actuator::Actuator& a, double length, std::string_view setting,
                    const std::string& written);

// Returns the value below which a share of the numbers is, linear between them; NaN without
// numbers. NaN is left out.
double quantile(std::vector<double> numbers, double share);

}  // namespace sinew::design
