// fmu/machine/module/fmi3.cpp - FMI 3.0 functions of the model machine.
#include "fmu/machine/models.h"

#include "fmu/slave/fmi3_functions.h"
