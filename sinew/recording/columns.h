// recording/columns.h - where the wanted columns stand in a table, and what their numbers mean.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/recording/grid.h"
#include "sinew/recording/measured.h"
#include "sinew/recording/problems.h"

namespace sinew::recording {

// Numbers of a file's unit to SI: a pressure may have an offset.
struct ToSi {
  double slope = 1, offset = 0;
  // Returns a number of the file in SI, and the number that stands for a value of SI.
  double operator()(double number) const { return offset + slope * number; }
  double back(double si) const { return (si - offset) / slope; }
};

// Where a wanted column stands in the file.
struct Found {
  const Wanted* wanted = nullptr;
  std::size_t index = 0;  // of the file's column; of the first one where there are several
  bool is_at = false;     // it is the condition of the columns with an @
  ToSi conversion;
  std::optional<double> constant;  // of a value that is stated for the whole file, SI
  std::string unit;                // of the file, as it writes it
  std::string shown;  // the same as Sinew writes it; empty where Sinew has no such unit
};

// Finds columns of one grid. What it cannot find goes to `problems`.
class ColumnFinder {
 public:
  // Looks in `grid` for what `source` says of its columns; all three outlive it.
  ColumnFinder(const Grid& grid, const Source& source, Problems& problems)
      : grid_(grid), source_(source), problems_(problems) {}

  // A column that is optional and not there is left out.
  std::vector<Found> find(std::span<const Wanted> wanted);

  // The columns of `where`, and the values that let a row pass.
  std::vector<std::pair<std::size_t, std::string>> conditions();

 private:
  bool find_stated(const Wanted& w, std::vector<Found>& out);
  void add_offset(const Wanted& w, Found& f);
  void refuse_beside_stated(const Wanted& w, const std::vector<Found>& found);
  void find_one(const Wanted& w, std::vector<Found>& out);
  std::vector<std::string_view> names() const;
  std::string all_names() const;
  std::string near_name(const std::string& name) const;
  void refuse_twice(const std::string& name, std::size_t first);
  void check_names(std::span<const Wanted> wanted);
  void convert(const Heading& h, const Wanted& w, Found& f);
  void refuse_unit(const Heading& h, const Wanted& w, const std::string& unit,
                   const std::string& try_this);

  const Grid& grid_;
  const Source& source_;
  Problems& problems_;
};

// Returns units of the wanted dimension in which the file's number would be possible: "mm or in".
std::string possible_units(const Wanted& wanted, double number);

}  // namespace sinew::recording
