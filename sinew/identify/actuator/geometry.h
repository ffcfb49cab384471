// identify/actuator/geometry.h - thread length and turns of a braid from measurements without
// pressure.
//
// Either threads of the opened mesh are counted, [14]-[18] (actuator/braid.h:
// braid_from_trapezoids), or length and diameter are measured at several lengths, [1]-[4]:
//
//   L^2 + (n pi D)^2 = b^2        b thread length [m], n turns [-], D diameter of the mesh [m]
//
// A caliper measures the outside of the threads: `thread_thickness` is subtracted from the diameter
// once (half a thread on either side).
#pragma once

#include <span>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Returns the columns that are used: `length` and `diameter`.
std::span<const ColumnSpec> geometry_columns();

// The identified braid, and the quality of the fit.
struct GeometryResult {
  actuator::Braid braid;
  Report report;
};

// Fits a braid to the diameters at the measured lengths [m]. Throws Refusal if the lengths differ
// too little to separate b from n.
GeometryResult identify_geometry(const Measured& data, double thread_thickness = 0);

}  // namespace sinew::identify
