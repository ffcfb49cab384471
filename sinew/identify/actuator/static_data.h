// identify/actuator/static_data.h - force at a length and a pressure: tables, or recordings of a
// muscle that is filled and vented at one length.
//
// A table has one point per row. A recording (a `time` column) is cut into branches at the turns of
// its pressure, each branch into bins of pressure, each bin is its median: outliers and the noise
// of thousands of samples go, and no bin is made by hand. Zeros: a recording begins vented, so what
// the sensors read there is their zero, unless it is too much to be one; a table tells the force's
// zero by its slack rows, where force does not ask for the pressure.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Did the pressure fall or rise before the reading?
enum class Branch { vent = -1, unknown = 0, fill = 1 };

// A reading at rest.
struct StaticPoint {
  double length = 0;       // [m]
  double pressure = 0;     // gauge, zero taken off [Pa]
  double force = 0;        // zero taken off [N]
  double rest_length = 0;  // of its muscle; 0: not known [m]
  Branch branch = Branch::unknown;
  bool fitted = true;  // false: held out
};

struct Zero {
  double force = 0, pressure = 0;  // what the sensors read without force, without pressure
  std::string from;                // "the vented start", empty: not taken off
};

// Readings that are not among the points, for one reason.
struct StaticOmitted {
  std::string reason, told_by;      // as in identify/fit/evidence.h
  std::size_t count = 0;            // how many they are
  std::vector<StaticPoint> points;  // some of them, where they are many
  std::vector<std::string> why;     // of each of these; may be empty
};

struct StaticData {
  std::vector<StaticPoint> points;
  std::vector<StaticOmitted> left_out;
  std::vector<std::string> notes, warnings;

  // Returns those of a reason, which may be new.
  StaticOmitted& omitted(const std::string& reason, const std::string& told_by);
};

// Holds what is known of a file's points beside its columns.
struct StaticInput {
  double rest_length = 0;  // 0: not known [m]
  bool fitted = true;
};

// force or load, pressure; length or contraction, rest_length, branch, time where there are such
// columns.
std::span<const Wanted> static_columns();

// Adds a file's points. Throws Refusal for files that no static model can be had from: a clipped
// sensor, a pressure that never changes, no length.
Zero add_points(const Measured& measured, const StaticInput& input, StaticData& data);

// One order, whatever that of the rows was.
void sort_points(std::vector<StaticPoint>& points);

// Groups of values that differ by less than `gap`; where one group would be wider than `most`,
// equal steps of `most`/2 instead. The group of each value, counted from the smallest.
std::vector<int> groups_of(std::span<const double> values, double gap, double most);

// Readings of one mount differ by less than this share of the longest length.
inline constexpr double widest_mount = 0.02;

// Returns the group of each length, counted from the smallest: those that differ by less than `gap`
// are of one mount, unless their chain is wider than `widest`. Such a chain is a sweep, and is
// parted in equal steps of about widest/2.
std::vector<int> mount_groups(std::span<const double> lengths, double gap, double widest);

}  // namespace sinew::identify
