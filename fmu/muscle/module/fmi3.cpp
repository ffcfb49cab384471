// fmu/muscle/module/fmi3.cpp - FMI 3.0 functions of the models tube, muscle and joint.
#include "fmu/muscle/models.h"

#include "fmu/slave/fmi3_functions.h"
