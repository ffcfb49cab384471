// identify/task/inputs.h - requirements on the table of each method, for users who prepare a
// measurement: its columns, which of them are required, and a template.
//
// The columns are those that the method reads, its list of ColumnSpec. All else is in one row per
// method in inputs.cpp: which columns are required in which kind of table, and a few example rows.
// Each new method needs a row there; a test checks this.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// One kind of table that a method takes, with an example. Lists are comma-separated texts.
struct TableKind {
  std::string_view name;    // e.g. "chart"; empty: the method takes one kind only
  std::string_view row;     // meaning of a row
  std::string_view needed;  // e.g. "pressure,force|load": pressure, and force or load
  std::string_view header;  // header of the example, e.g. "length [mm],force [N]"
  std::string_view rows;    // rows of the example, one per line
};

// Inputs of one method.
struct MethodInputs {
  std::string_view method;               // e.g. "static"
  std::vector<ColumnSpec> columns;       // all columns that it reads
  std::span<const TableKind> kinds;      // the most common one first
  std::vector<std::string_view> advice;  // further requirements, in sentences
};

// Returns the methods in the order of their help.
std::span<const MethodInputs> method_inputs();

// Returns the inputs of a method. Throws config::Error if it does not exist.
const MethodInputs& inputs_of(std::string_view method);

// Returns the units that a column may have: those that Sinew has for its quantity.
std::vector<std::string> accepted_units(const ColumnSpec& column);

// Returns the quantity of a column: "length", "pressure", "a word".
std::string quantity_of(const ColumnSpec& column);

// Returns whether a column is required, as text: "required", "required, or load", "required for
// chart", "optional".
std::string need_of(const MethodInputs& inputs, std::string_view column);

// Returns the inputs as `sinew identify columns --json` prints them.
Json to_json(const MethodInputs& inputs);

// Returns a CSV that the method can read, with comments that describe the fields to fill in.
// `kind` is one of its kinds of tables; empty: the first one. Throws config::Error if it does not
// exist.
std::string template_of(const MethodInputs& inputs, std::string_view kind = "");

// Returns a table of the columns with their units, then what a row is and advice.
std::string text_of(const MethodInputs& inputs);

}  // namespace sinew::identify
