#include "sinew/units/shown.h"

#include <array>
#include <cmath>

#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"

namespace sinew::units {
namespace {

constexpr std::array<std::pair<std::string_view, UnitSet>, 3> sets = {
    {{"si", UnitSet::si}, {"thesis", UnitSet::thesis}, {"metric", UnitSet::metric}}};

// Returns the reference that a pressure's unit requires: "Pa gauge" is shown in "bar gauge".
std::string_view reference_asked(std::string_view unit) {
  return unit == "Pa abs" ? "abs" : unit == "Pa gauge" ? "gauge" : "";
}

const ShownQuantity* quantity_in(std::string_view unit) {
  if (!reference_asked(unit).empty()) unit = "Pa";
  for (const ShownQuantity& q : shown_quantities)
    if (q.unit == unit) return &q;
  return nullptr;
}

const ShownQuantity* quantity_named(std::string_view name) {
  for (const ShownQuantity& q : shown_quantities)
    if (q.name == name) return &q;
  return nullptr;
}

const ShownChoice& choice_of(const ShownQuantity& q, UnitSet set) {
  return set == UnitSet::si ? q.si : set == UnitSet::thesis ? q.thesis : q.metric;
}

// Returns the shown unit of that name; `held` is the SI unit of the values.
ShownUnit shown_unit(std::string_view name, std::string_view held, double room) {
  const auto [text, reference] = unit_and_reference(name);
  const Unit unit = read_unit(text).unit;
  ShownUnit out{std::string(name), unit.denominator / unit.numerator, -unit.offset};
  if (out.offset == 0) out.offset = 0;  // not -0
  const std::string_view from = reference_asked(held);
  if (!from.empty()) {
    out.name = std::string(text) + " " + std::string(from);
  } else if (held == "Pa" && reference == "gauge") {
    out.gauge = true;
    out.offset = -room;
  }
  return out;
}

std::string names_of_quantities() {
  std::string out;
  for (const ShownQuantity& q : shown_quantities)
    out += (out.empty() ? "" : ", ") + std::string(q.name);
  return out;
}

const char* const example = "\"metric\", or \"metric,pressure=kPa gauge,length=cm\"";

// Returns a word that begins like the wrong one, else an example.
std::string hint_for(std::string_view word) {
  for (const auto& [name, set] : sets)
    if (word.size() > 1 && name.starts_with(word.substr(0, 2))) return in_quotes(name);
  return example;
}

// Returns the mistake of a unit that does not suit the quantity. Completes `unit` to its full name.
std::optional<Mistake> check_unit(const ShownQuantity& q, std::string& unit) {
  const auto [text, reference] = unit_and_reference(unit);
  const std::string usual(q.metric.usual);
  const std::string wanted =
      "a unit of " + std::string(q.name) + ", as " + std::string(q.thesis.usual) + " or " + usual;
  if (!read_unit(text).ok || text.empty())
    return Mistake{in_quotes(unit) + ", which is no unit", wanted,
                   std::string(q.name) + "=" + usual};
  if (!measures(text, q.unit))
    return Mistake{in_quotes(unit) + ", which measures something else", wanted,
                   std::string(q.name) + "=" + usual};
  const bool difference = q.unit == "Pa diff";
  const std::string bare(text);
  if (difference) {
    if (!reference.empty() && reference != "diff")
      return Mistake{in_quotes(unit), "a difference of pressures",
                     std::string(q.name) + "=" + bare};
    unit = bare + " diff";
  } else if (q.unit == "Pa" && reference != "gauge" && reference != "abs") {
    return Mistake{in_quotes(unit) + ", a pressure without its reference", wanted,
                   "pressure=" + bare + " gauge, or pressure=" + bare + " abs"};
  } else if (q.unit != "Pa" && !reference.empty()) {
    return Mistake{in_quotes(unit), wanted, std::string(q.name) + "=" + bare};
  }
  return std::nullopt;
}

std::optional<Mistake> read_choice(std::string_view piece, std::size_t equals, ShownUnits& units) {
  std::string name(trimmed(piece.substr(0, equals)));
  for (char& c : name)
    if (c == '-' || c == '_') c = ' ';
  const ShownQuantity* q = quantity_named(name);
  if (!q)
    return Mistake{in_quotes(name) + ", which is no quantity", names_of_quantities(), example};
  std::string unit(trimmed(piece.substr(equals + 1)));
  if (auto mistake = check_unit(*q, unit)) return mistake;
  units.choose(q->name, unit);
  return std::nullopt;
}

}  // namespace

std::string_view to_text(UnitSet set) {
  for (const auto& [name, each] : sets)
    if (each == set) return name;
  return "";
}

std::string ShownUnit::label() const {
  return name.ends_with(" diff") ? name.substr(0, name.size() - 5) : name;
}

const std::string* ShownUnits::choice(std::string_view quantity) const {
  for (const auto& [name, unit] : choices_)
    if (name == quantity) return &unit;
  return nullptr;
}

void ShownUnits::choose(std::string_view quantity, std::string_view unit) {
  for (auto& [name, chosen] : choices_)
    if (name == quantity) {
      chosen = unit;
      return;
    }
  choices_.emplace_back(quantity, unit);
}

ShownUnit ShownUnits::of(std::string_view unit, double largest, double room) const {
  if (unit == "share") return {"%", 100};
  if (unit == "1" || unit.empty()) return {};
  const ShownQuantity* q = quantity_in(unit);
  if (!q) return {std::string(unit)};
  if (const std::string* chosen = choice(q->name)) return shown_unit(*chosen, unit, room);
  // A difference of pressures uses the unit chosen for pressures.
  if (const std::string* of_pressure = choice("pressure"); of_pressure && q->unit == "Pa diff")
    return shown_unit(std::string(unit_and_reference(*of_pressure)[0]) + " diff", unit, room);
  const ShownChoice& shown = choice_of(*q, set_);
  ShownUnit usual = shown_unit(shown.usual, unit, room);
  if (std::isnan(largest)) return usual;
  if (!shown.small.empty())
    if (ShownUnit small = shown_unit(shown.small, unit, room); small.scale * largest < 1000)
      return small;
  if (!shown.large.empty() && usual.scale * largest >= 1000)
    return shown_unit(shown.large, unit, room);
  return usual;
}

ShownUnit ShownUnits::of_difference(std::string_view unit, double largest) const {
  const bool pressure = unit == "Pa" || !reference_asked(unit).empty();
  ShownUnit out = of(pressure ? "Pa diff" : unit, largest);
  out.offset = 0;
  return out;
}

std::string ShownUnits::text(double value, std::string_view unit, int digits, double room) const {
  ShownUnit shown = of(unit, unknown_size, room);
  if (std::abs(shown.of(value)) >= 1000) shown = of(unit, std::abs(value), room);
  const std::string number = format_number(shown.of(value), digits);
  return shown.name.empty() ? number : number + " " + shown.name;
}

std::string ShownUnits::text() const {
  std::string out(to_text(set_));
  for (const auto& [name, unit] : choices_) out += "," + name + "=" + unit;
  return out;
}

ShownUnitsReading read_shown_units(std::string_view text, const ShownUnits& below) {
  ShownUnits units = below;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string_view piece = trimmed(text.substr(at, comma - at));
    const bool first = at == 0;
    at = comma + 1;
    if (const std::size_t equals = piece.find('='); equals != piece.npos) {
      if (auto mistake = read_choice(piece, equals, units)) return {{}, mistake};
      continue;
    }
    const auto set = std::ranges::find(sets, piece, [](const auto& s) { return s.first; });
    if (set == sets.end())
      return {
          {},
          Mistake{in_quotes(piece), "si, thesis or metric, then QUANTITY=UNIT", hint_for(piece)}};
    if (!first)
      return {{}, Mistake{in_quotes(text), "one set, named first", in_quotes(piece) + " alone"}};
    units = ShownUnits(set->second);
  }
  return {units, {}};
}

std::optional<QuantityUnit> read_quantity_unit(std::string_view unit, double room) {
  const auto [text, reference] = unit_and_reference(unit);
  if (text.empty() || !read_unit(text).ok) return std::nullopt;
  for (const ShownQuantity& q : shown_quantities) {
    // Without a reference N/m2 is a stress, not a pressure.
    const std::string_view wanted = q.unit == "Pa diff" ? "diff" : "";
    const bool pressure = q.unit == "Pa";
    const bool has_reference =
        pressure ? reference == "gauge" || reference == "abs" : reference == wanted;
    if (has_reference && measures(text, q.unit))
      return QuantityUnit{q.unit, shown_unit(unit, q.unit, room)};
  }
  return std::nullopt;
}

std::vector<ShownEntry> shown_entries(const ShownUnits& units) {
  std::vector<ShownEntry> out{{"share", "share", {units.of("share")}, 0}};
  const auto add = [&](const ShownQuantity& q, std::string_view unit) {
    ShownEntry entry{unit, q.name, {}, 0};
    // Each size that affects the unit, from small to large; none affects a chosen unit.
    for (const double size : {0.0, ShownUnits::unknown_size, 1e30})
      if (ShownUnit u = units.of(unit, size, 0);
          entry.shown.empty() || entry.shown.back().name != u.name) {
        if (std::isnan(size)) entry.usual = entry.shown.size();
        entry.shown.push_back(std::move(u));
      }
    out.push_back(std::move(entry));
  };
  for (const ShownQuantity& q : shown_quantities) {
    add(q, q.unit);
    if (q.unit == "Pa")
      for (const std::string_view unit : {"Pa abs", "Pa gauge"}) add(q, unit);
  }
  return out;
}

}  // namespace sinew::units
