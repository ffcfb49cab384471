// bench/peers/mjcf.h - the leg's numbers as an MJCF file.
#pragma once

#include <string>

#include "bench/peers/mujoco_leg.h"

namespace sinew::bench {

// Returns the MJCF text: x forward, z up; angles from x to z, that of the knee from the femur.
// `step` [s].
std::string mjcf(const plant::Setup& setup, double step, Integrator integrator);

}  // namespace sinew::bench
