// fmu/muscle/models.h - list of the models of the module sinew_fmu_muscle.
#pragma once

#include <variant>

#include "fmu/muscle/joint.h"
#include "fmu/muscle/muscle.h"
#include "fmu/muscle/tube.h"

namespace sinew::fmu {

using Models = std::variant<Tube, Muscle, Joint>;

}  // namespace sinew::fmu
