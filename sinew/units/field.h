// units/field.h - description of a folder's parameters.
//
// A folder with parameters has a header `<name>.fields.h` with one function template per struct:
//
//   template <class Visitor>
//   void fields(Visitor& v, Braid& braid) {
//     v.number({.name = "turns", .unit = "1", .min = 0.01, .doc = "of one thread"}, braid.turns);
//   }
//
// The same function reads the struct from a file, prints it, documents it and names the channels'
// metadata. The visitors are config::Reader and EachField (each_field.h).
//
// A visitor has:
//   v.number(Field, double&)                  a quantity; text in files, SI in the struct
//   v.numbers(Field, std::vector<double>&)    a list of quantities of one unit
//   v.polynomial(Field, std::vector<double>&, per)   c0, c1, ... in unit, unit/per, unit/per^2 ...
//   v.integer(Field, int&)
//   v.flag(Field, bool&)
//   v.text(Field, std::string&)
//   v.texts(Field, std::vector<std::string>&)
//   v.choice(Field, Enum&, {{"stop", Enum::stop}, ...})
//   v.group(Field, [&](auto& v) {...})        a table with fixed keys
//   v.each(Field, std::vector<T>&, [&](auto& v, T&) {...})   a table of named tables; T has `name`
//   v.list(Field, std::vector<T>&, [&](auto& v, T&) {...})   an array of tables, in order
//   v.named_numbers(Field, std::map<std::string, double>&)   { hip = "300 deg", knee = "292 deg" }
//
// A visitor that refuses keys which exclude each other also has v.report_conflict(...), which is
// called by units/report_conflict.h.
#pragma once

#include <limits>
#include <string_view>

namespace sinew::units {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Field {
  std::string_view name;  // key in the file
  // SI; "Pa abs", "Pa gauge" or "Pa diff" for a pressure; "1" for a plain number.
  std::string_view unit = "";
  double min = -unbounded;  // inclusive, in `unit`; otherwise units/ranges.h applies
  double max = unbounded;
  double least = 0;           // smallest nonzero size: 0 is allowed, nearly 0 is taken for an error
  std::string_view why = "";  // reason for these bounds, in messages: "an efficiency is a share"
  bool optional = false;      // absent: the struct's default is kept
  std::string_view doc = "";  // one line: a noun phrase, then what 0 or a missing key means
};

// One allowed word of a choice and its value.
template <class Enum>
struct Choice {
  std::string_view word;
  Enum value;
};

// Visit a quantity of at least 0, required or with a default, and a share from 0 to 1.
template <class Visitor>
void amount(Visitor& v, std::string_view name, std::string_view unit, std::string_view doc,
            double& value) {
  v.number({.name = name, .unit = unit, .min = 0, .doc = doc}, value);
}
template <class Visitor>
void optional_amount(Visitor& v, std::string_view name, std::string_view unit, std::string_view doc,
                     double& value) {
  v.number({.name = name, .unit = unit, .min = 0, .optional = true, .doc = doc}, value);
}
template <class Visitor>
void optional_share(Visitor& v, std::string_view name, std::string_view doc, double& value) {
  v.number({.name = name, .unit = "1", .min = 0, .max = 1, .optional = true, .doc = doc}, value);
}

}  // namespace sinew::units
