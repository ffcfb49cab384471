// bench/peers/mjcf.h - the leg's numbers as an MJCF file.
#pragma once

#include <string>

#include "bench/peers/mujoco_leg.h"

namespace sinew::bench {

// x forward, z up; hinges turn from x to z, the knee's from the femur. `step` [s].
std::string mjcf(const plant::Setup& setup, double step, Integrator integrator);

}  // namespace sinew::bench
