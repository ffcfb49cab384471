// units/field.h - how a folder describes its parameters.
//
// A folder with parameters has a header `<name>.fields.h` with one function template per struct:
//
//   template <class Visitor>
//   void fields(Visitor& v, Braid& braid) {
//     v.number({.name = "turns", .unit = "1", .min = 0.01, .doc = "of one thread"}, braid.turns);
//   }
//
// The same function reads the struct from a file, prints it, documents it and names the channels'
// metadata: the visitors stand in config/, which knows nothing of the structs.
//
// A visitor has:
//   v.number(Field, double&)                  a quantity; text at the border, SI inside
//   v.numbers(Field, std::vector<double>&)    a list of quantities of one unit
//   v.polynomial(Field, std::vector<double>&, per)   c0, c1, ... in unit, unit/per, unit/per^2 ...
//   v.integer(Field, int&)
//   v.flag(Field, bool&)
//   v.text(Field, std::string&)
//   v.texts(Field, std::vector<std::string>&)
//   v.choice(Field, Enum&, {{"stop", Enum::stop}, ...})
//   v.group(Field, [&](auto& v) {...})        a table with fixed keys
//   v.each(Field, std::vector<T>&, [&](auto& v, T&) {...})   a table of named tables; T has `name`
//   v.list(Field, std::vector<T>&, [&](auto& v, T&) {...})   an array of tables, in their order
//   v.named_numbers(Field, std::map<std::string, double>&)   { hip = "300 deg", knee = "292 deg" }
//
// Only a reader has v.complain(...); units/complain.h asks for it.
#pragma once

#include <limits>
#include <string_view>

namespace sinew::units {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Field {
  std::string_view name;  // key in the file
  // SI; "Pa abs", "Pa gauge" or "Pa diff" for a pressure; "1" for a bare number.
  std::string_view unit = "";
  double min = -unbounded;  // inclusive, in `unit`; beyond them units/ranges.h holds for the unit
  double max = unbounded;
  double least = 0;           // of what is not 0: 0 is "none", what is nearly 0 is a slip
  std::string_view why = "";  // of min, max and least, for messages: "an efficiency is a share"
  bool optional = false;      // absent: the struct's default stays
  std::string_view doc = "";  // one line
};

// One allowed word of a choice and what it stands for.
template <class Enum>
struct Choice {
  std::string_view word;
  Enum value;
};

}  // namespace sinew::units
