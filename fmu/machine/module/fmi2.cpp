// fmu/machine/module/fmi2.cpp - FMI 2.0 functions of the model machine.
#include "fmu/machine/models.h"

#include "fmu/slave/fmi2_functions.h"
