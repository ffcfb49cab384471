// identify/actuator/creep.h - shares and times of creep, from force that goes on growing at one
// length.
//
//   F = A (max(p - P0, 0) + sum c_i max(z_i - P0, 0))      z_i' = (p - z_i)/tau_i
//
// The law of actuator/creep.h with a static law that is a straight line over pressure, A and P0 of
// this length. While the pressure still moves, a slow creep and a threshold that is a little off
// look alike: the report says how much of the growth a law without creep explains.
#pragma once

#include <span>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/fit.h"

namespace sinew::identify {

// time, force, pressure.
std::span<const Wanted> creep_columns();

// The creep that was found, and how well it fits.
struct CreepResult {
  Report report;
  actuator::Creep creep;  // of the chosen model
};

// None, one and two elements are tried; every second row is held out to choose. Throws Refusal for
// fewer than 12 rows.
CreepResult identify_creep(const Measured& data);

}  // namespace sinew::identify
