// identify/actuator/static_data.h - readings of force at a length and a pressure: from tables,
// or from recordings of a muscle that is filled and vented at one length.
//
// A table has one point per row. A recording (it has a `time` column) is cut into branches where
// its pressure reverses, each branch into pressure bins; a bin's point is its median, which
// removes outliers and noise. Zeros: a recording begins vented, and the readings there are the
// sensors' zeros unless they are too large for that. The force zero of a table comes from its slack
// rows, in which the force does not depend on the pressure.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Direction of the pressure before the reading: fill is rising, vent is falling.
enum class Branch { vent = -1, unknown = 0, fill = 1 };

// A reading at rest.
struct StaticPoint {
  double length = 0;       // [m]
  double pressure = 0;     // gauge, zero subtracted [Pa]
  double force = 0;        // zero subtracted [N]
  double rest_length = 0;  // rest length of its muscle [m]; 0: unknown
  Branch branch = Branch::unknown;
  bool fitted = true;   // false: held out
  double weight = 1;    // independent readings of which it is the average
  double variance = 0;  // variance of the force among these readings [N2]
};

struct Zero {
  double force = 0, pressure = 0;  // readings without load and without pressure
  std::string from;                // e.g. "the vented start"; empty: not subtracted
};

// Readings that are not among the points, for one reason.
struct StaticOmitted {
  std::string reason, criterion;    // as in identify/contest/fit.h
  std::size_t count = 0;            // number of readings
  std::vector<StaticPoint> points;  // these readings, or a selection
  std::vector<std::string> why;     // cause for each of `points`; may be empty
};

struct StaticData {
  std::vector<StaticPoint> points;
  std::vector<StaticOmitted> left_out;
  std::vector<std::string> notes, warnings;

  // Returns the readings left out for a reason, adding an entry if it is new.
  StaticOmitted& omitted(const std::string& reason, const std::string& criterion);
};

// Properties of a file's points that are not in its columns.
struct StaticInput {
  double rest_length = 0;  // 0: unknown [m]
  bool fitted = true;
};

// Returns the columns that are used: force or load, pressure; length or contraction, and
// rest_length, branch and time if present.
std::span<const ColumnSpec> static_columns();

// Adds a file's points. Throws Refusal for files that cannot give a static model: a clipped sensor,
// a constant pressure, no length.
Zero add_points(const Measured& measured, const StaticInput& input, StaticData& data);

// Return the rest lengths of the muscles of these points, ascending; the points of one of them; one
// value of each point; and whether a point is of this branch.
std::set<double> muscles_in(std::span<const StaticPoint> points);
std::vector<StaticPoint> points_of(std::span<const StaticPoint> points, double rest_length);
std::vector<double> values_of(std::span<const StaticPoint> points, double StaticPoint::*value);
bool has_branch(std::span<const StaticPoint> points, Branch branch);

// Gives muscles without a rest length the longest length of the points. Returns that length; 0 if
// each has a rest length.
double give_longest(std::vector<StaticPoint>& points);

// Sorts the points, so that the result does not depend on the order of the rows.
void sort_points(std::vector<StaticPoint>& points);

// Returns the group of each value, counted from the smallest. Values that differ by less than
// `gap` are one group; a group wider than `most` is divided into equal steps of about `most`/2.
std::vector<int> groups_of(std::span<const double> values, double gap, double most);

// Readings of one mount differ by less than this share of the longest length.
inline constexpr double widest_mount = 0.02;

// Returns the group of each length, counted from the smallest. Lengths that differ by less
// than `gap` are of one mount, unless their chain is wider than `widest`. Such a chain is a
// sweep, which is divided into equal steps of about widest/2.
std::vector<int> mount_groups(std::span<const double> lengths, double gap, double widest);

}  // namespace sinew::identify
