// muscle.h - a braided muscle with its air and valves in a program of yours: all that component
// `muscle` of the CMake package has, by one include.
//
//   #include "sinew/muscle.h"
//
//   sinew::air::Muscle described;                // braid, losses, ends, valves: numbers in SI
//   sinew::air::DrivenMuscle muscle(described, air, supply, 0.08);  // 80 mm long
//   muscle.inlet(true);
//   muscle.advance(1e-3, length);                // 1 ms later your robot has made it so long
//   pull_with(muscle.tension());                 // [N]
//
// find_package(sinew COMPONENTS muscle) and sinew::muscle need a C++20 compiler and no library;
// docs/how-to/install.md describes how it is built alone.
//
// world/driven/driven_muscle.h      one muscle, which a loop of yours moves: begin here
// air/network.h            many muscles as half of an equation that your integrator solves
// actuator/…               the braid's laws alone: tension, stiffness, volume, losses
// gas/…                    air, valves with their delays, supply
// units/literals.h         10.0_lb, 100.0_psi, 3.2_in; inside everything is SI, pressures absolute
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/air/muscle.h"
#include "sinew/air/network.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/gas/valve.h"
#include "sinew/units/constants.h"
#include "sinew/units/literals.h"
#include "sinew/world/driven/driven_muscle.h"
