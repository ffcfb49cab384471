// fmu/muscle/module/fmi2.cpp - FMI 2.0 functions of the models tube, muscle and joint.
#include "fmu/muscle/models.h"

#include "fmu/slave/fmi2_functions.h"
