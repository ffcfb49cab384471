// recording/columns.h - columns of a recording: their headings, which of them has a wanted
// quantity, and how its numbers are converted to SI. Used by the methods of identify, by
// calibrations of sensors and by imports.
//
// A column has the name that the user gives, or else the quantity's own name; its unit is the one
// that the user gives, or else the header's. A fault states the header's line and column, what was
// found, what is expected and which setting helps.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/rows.h"
#include "sinew/units/quantity.h"

namespace sinew::recording {

// Heading of a column: its name, its unit, and the condition under which its values were measured.
//
//   force [N]   force (N)   force / N   force in N   "force [N] @ pressure = 1 bar gauge"

struct Heading {
  std::string name;      // force
  std::string unit;      // as in the file: psig; empty: not given
  std::string at_name;   // pressure; empty for most columns
  std::string at_value;  // 1 bar gauge
  int column = 1;        // in the header's line; 0: the file has no such column
  std::string written;   // whole cell as in the file

  // Returns whether `text` is the heading's name or its whole text.
  bool is_called(std::string_view text) const { return name == text || written == text; }
};

// Reads a header cell: name, unit, and the condition after an @.
Heading heading_of(const Cell& cell);

// Returns whether the text can be a cell of a units line below the names: "[N]", "psig", "(mm)",
// "-" or empty.
bool is_unit_cell(std::string_view text);

// Returns the text without brackets around a unit.
std::string_view without_brackets(std::string_view text);

// Returns "units.force="kPa gauge"", a setting that gives a name a value, as advice. A name that is
// not one word is in the quotes, "units."Druck 1=kPa gauge"", so that a shell takes both as one.
std::string stated_setting(std::string_view setting, std::string_view name, std::string_view value);

// Header of one file.
struct Header {
  std::string file;
  int line = 0;  // line of the names; 0: not in the file
  std::vector<Heading> columns;

  // Returns the first column with that name or heading, if it exists.
  std::optional<std::size_t> called(std::string_view name) const;
  // Returns that column, or else the only one whose name ends with `name` after a dot or a slash.
  std::optional<std::size_t> find(std::string_view name) const;

  // Return the names of the columns and of the conditions after an @, as a list and as a text.
  std::vector<std::string_view> names() const;
  std::string all_names() const;
};

// value = slope x number + offset; a pressure may have an offset.
struct Conversion {
  double slope = 1, offset = 0;

  // Convert a number of the file to SI, and a value in SI to a number of the file.
  double operator()(double number) const {
    return slope == 1 && offset == 0 ? number : offset + slope * number;
  }
  double back(double si) const { return (si - offset) / slope; }
};

// Unit of a file's numbers as Sinew reads it.
struct FileUnit {
  Conversion conversion;
  std::string shown;  // in Sinew's spelling; empty: Sinew has no such unit
};

// Returns whether a channel of Sinew with the unit Pa holds gauge pressures, as the transducers of
// a test stand measure them; all other channels hold absolute ones.
bool is_gauge_channel(std::string_view name);

// Returns Sinew's unit that is nearest to the file's, "bar gauge" for "mbar(g)", and the conversion
// to it. An unknown unit is returned unchanged.
FileUnit own_unit(const std::string& unit);

// Returns the unit of a file for a quantity whose SI unit is `wanted`, by the first meaning of the
// text with the quantity's dimension; without such a meaning the advice for a message, which may be
// empty. Gauge pressures refer to `atmosphere` [Pa].
std::variant<FileUnit, std::string> file_unit(const std::string& unit, const std::string& wanted,
                                              double atmosphere);

// Parses a difference that is added to a quantity, "200 mm" or "0.1 bar diff". The result is in the
// unit `wanted`.
units::Parsed parse_offset(const std::string& text, std::string_view wanted, double atmosphere);

// Quantity that a column should have.
struct WantedColumn {
  std::string name;     // in settings and messages: "pressure", "/joint/elbow/angle"
  std::string unit;     // SI: "Pa gauge"
  std::string meaning;  // "in the muscle"
};

// Settings of a user: what the file does not state.
using Names = std::map<std::string, std::string>;

// Returns the column of a quantity, if there is one. `names` has the file's names of quantities;
// such a name may be the end of the column's, "force" for "log.force".
std::optional<std::size_t> column_of(const Header& header, const Names& names,
                                     std::string_view wanted);

// Returns the unit that a user gives a column, if any. A unit for a name that several columns have
// is the unit of each.
std::optional<std::string> given_unit(const Header& header, const Names& units, std::size_t column);

// Finds the columns of one header and their units. Faults are added to `problems`.
class ColumnResolver {
 public:
  // Keeps references to all but `atmosphere`, which must outlive this object. `names` has the
  // file's names of quantities, `units` the units of columns. Gauge pressures refer to `atmosphere`
  // [Pa].
  ColumnResolver(const Header& header, const Names& names, const Names& units, double atmosphere,
                 config::Problems& problems)
      : header_(header),
        names_(names),
        units_(units),
        atmosphere_(atmosphere),
        problems_(problems) {}

  // Returns the name that a quantity has in the file, as the user gives it, or else its own.
  std::string name_of(std::string_view wanted) const;

  // Returns the column of a quantity, if there is one.
  std::optional<std::size_t> find(std::string_view wanted) const {
    return column_of(header_, names_, wanted);
  }

  // Adds the problem of a quantity without a column.
  void refuse_missing(const WantedColumn& wanted);

  // Adds a problem for each further column with the name of this one, as either may be meant.
  // Columns with an @ belong together.
  void refuse_repeated(std::size_t column);

  // Returns the unit of a column's numbers as it is written; empty if it is not given.
  std::string unit_of(std::size_t column) const;

  // Returns the unit of a column for a quantity: the first meaning of its text that has the
  // quantity's dimension. Without such a meaning a problem is added.
  std::optional<FileUnit> convert(std::size_t column, const WantedColumn& wanted);

 private:
  void refuse_unit(std::size_t column, const WantedColumn& wanted, const std::string& advice);

  const Header& header_;
  const Names& names_;
  const Names& units_;
  double atmosphere_;
  config::Problems& problems_;
};

// Adds a problem for each name of a setting, "units" or "where", that no column of the header has.
void check_columns(const Header& header, const char* setting, const Names& values,
                   config::Problems& problems);

}  // namespace sinew::recording
