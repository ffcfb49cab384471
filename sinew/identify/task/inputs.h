// identify/task/inputs.h - what the table of each method must hold, for people who are about to
// measure: its columns, which of them are needed, and a table to fill in.
//
// The columns are those that the method reads, its list of Wanted. What no such list says stands in
// one row per method in inputs.cpp: which columns are needed in which kind of table, and a few
// example rows. A new method adds its row there; a test asks every method for it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// One kind of table that a method takes, with an example. Lists are texts with commas.
struct TableKind {
  std::string_view name;    // "chart"; empty: the method takes one kind alone
  std::string_view row;     // what a row is
  std::string_view needed;  // "pressure,force|load": these columns, of force and load one
  std::string_view header;  // of the example, "length [mm],force [N]"
  std::string_view rows;    // of the example, a line each
};

// What one method takes.
struct MethodInputs {
  std::string_view method;               // "static"
  std::vector<Wanted> (*columns)();      // all that it reads
  std::span<const TableKind> kinds;      // the first one is the usual one
  std::vector<std::string_view> advice;  // what columns alone do not say, in sentences
};

// Returns the methods, in the order of their help.
std::span<const MethodInputs> method_inputs();

// Returns one of them. Throws config::Error for a method that there is not.
const MethodInputs& inputs_of(std::string_view method);

// Returns the units that a column may be in: those that Sinew has of its quantity.
std::vector<std::string> accepted_units(const Wanted& column);

// Returns what a column measures: "length", "pressure", "a word".
std::string quantity_of(const Wanted& column);

// Returns whether a column is needed: "required", "required, or load", "required for chart",
// "optional".
std::string need_of(const MethodInputs& inputs, std::string_view column);

// Returns all of it, as `sinew identify columns --json` prints it.
Json to_json(const MethodInputs& inputs);

// Returns a CSV that the method reads as it is, with comments that say what to fill in. `kind` is
// one of its kinds of tables; empty: the usual one. Throws config::Error for one that there is not.
std::string template_of(const MethodInputs& inputs, std::string_view kind = "");

// Returns a table of the columns with their units, then what a row is and advice.
std::string text_of(const MethodInputs& inputs);

}  // namespace sinew::identify
