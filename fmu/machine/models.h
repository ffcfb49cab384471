// fmu/machine/models.h - list of the models of the module sinew_fmu_machine.
#pragma once

#include <variant>

#include "fmu/machine/machine.h"

namespace sinew::fmu {

using Models = std::variant<Machine>;

}  // namespace sinew::fmu
