// identify/actuator/geometry.h - thread length and turns of a braid, from what can be seen without
// pressure.
//
// Either the opened mesh is counted, [14]-[18] (actuator/braid.h: braid_from_trapezoids), or length
// and diameter are measured at several lengths, [1]-[4]:
//
//   L^2 + (n pi D)^2 = b^2        b thread length [m], n turns [-], D diameter of the mesh [m]
//
// A caliper meets the outside of the threads; `thread_thickness` is taken off the diameter once
// (half a thread on either side).
#pragma once

#include <span>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/fit.h"

namespace sinew::identify {

// Columns `length` and `diameter`.
std::span<const Wanted> geometry_columns();

// The braid that was found, and how well it fits.
struct GeometryResult {
  actuator::Braid braid;
  Report report;
};

// Residuals are of the diameter at the measured length  [m]. Throws Refusal if the lengths do not
// differ enough to tell b from n.
GeometryResult identify_geometry(const Measured& data, double thread_thickness = 0);

}  // namespace sinew::identify
