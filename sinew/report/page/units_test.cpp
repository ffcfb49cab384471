// report/page/units_test.cpp - the table of units in a page agrees with the library.
#include "sinew/report/page/content.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "sinew/units/key_endings.h"
#include "sinew/units/spelling.h"
#include "sinew/units/unit.h"
#include "tests/places.h"

namespace sinew::report::units_test {
namespace {

using Json = nlohmann::json;

units::ShownUnits chosen(std::string_view text) { return units::read_shown_units(text).units; }

Json set_of(const Json& table, const std::string& name) {
  for (const Json& set : table["sets"])
    if (set["name"] == name) return set;
  return {};
}

// Returns (value + offset) * scale, less the room's pressure for a gauge unit.
double shown(const Json& unit, double value, double room) {
  const double offset = unit.value("gauge", false) ? -room : unit.value("offset", 0.0);
  return (value + offset) * unit["scale"].get<double>();
}

TEST(PageUnits, ShowWhatTheLibraryShowsInEverySet) {
  const auto own = chosen("metric,pressure=kPa gauge,temperature=degR");
  const Json table = Json::parse(units_json(own));
  const std::pair<std::string, units::ShownUnits> sets[] = {{"si", units::UnitSet::si},
                                                            {"thesis", units::UnitSet::thesis},
                                                            {"metric", units::UnitSet::metric},
                                                            {"own", own}};
  ASSERT_EQ(table["sets"].size(), std::size(sets));
  for (const auto& [name, units] : sets)
    for (const auto& entry : units::shown_entries(units)) {
      const Json unit = set_of(table, name)["units"][std::string(entry.unit)];
      const units::ShownUnit wanted = units.of(entry.unit, units::ShownUnits::unknown_size, 95000);
      EXPECT_EQ(unit["label"], wanted.label()) << name << " " << entry.unit;
      EXPECT_NEAR(shown(unit, 3.2e5, 95000), wanted.of(3.2e5), 1e-9 * std::abs(wanted.of(3.2e5)))
          << name << " " << entry.unit;
    }
}

TEST(PageUnits, ThePageBeginsInTheRequestedOnes) {
  EXPECT_EQ(Json::parse(units_json(units::UnitSet::metric))["start"], "metric");
  EXPECT_EQ(Json::parse(units_json(units::UnitSet::metric))["sets"].size(), 3u);
  const Json own = Json::parse(units_json(chosen("thesis,length=mm")));
  EXPECT_EQ(own["start"], "own");
  EXPECT_EQ(set_of(own, "own")["about"], "mm, s, deg, lbf, psi gauge");
}

TEST(PageUnits, ALargeNumberHasALargeUnit) {
  const Json table = Json::parse(units_json(units::UnitSet::metric));
  EXPECT_EQ(set_of(table, "metric")["units"]["s"]["large"]["label"], "s");
  EXPECT_EQ(set_of(table, "si")["units"]["kg"]["large"]["label"], "kg");
  EXPECT_FALSE(set_of(table, "si")["units"]["m"].contains("large"));
}

// Returns the script with the library's tables. Units with an offset cannot be part of a formula.
std::string quantities_script() {
  std::string units, endings;
  std::size_t line = 0;  // start of the last one
  const auto add = [&](std::string& to, const std::string& entry) {
    const bool is_full = to.size() + entry.size() > line + 116;
    if (is_full || to.empty()) to += "\n ", line = to.size() - 2;
    to += " " + entry + ",";
  };
  const auto powers_of = [](const units::Dimension& d) {
    const std::pair<const char*, int> bases[] = {
        {"kg", d.mass},   {"m", d.length},    {"s", d.time},    {"K", d.temperature},
        {"rad", d.angle}, {"count", d.count}, {"V", d.voltage}, {"A", d.current}};
    std::vector<std::string> powers;
    for (const auto& [base, power] : bases)
      if (power != 0) powers.push_back(fmt::format("{}: {}", base, power));
    return powers.empty() ? std::string("{}") : fmt::format("{{ {} }}", fmt::join(powers, ", "));
  };
  const auto add_unit = [&](std::string_view name, const units::Unit& unit, double factor) {
    const bool is_word = name != "%";
    add(units, fmt::format("{0}{1}{0}: [{2}, {3}]", is_word ? "" : "'", name,
                           factor * unit.to_si(1), powers_of(unit.dimension)));
  };
  for (const units::Unit& unit : units::known_units)
    if (unit.offset == 0) add_unit(unit.name, unit, 1);
  const units::Spelling mbar = units::spellings("mbar").front();
  add_unit("mbar", units::read_unit(mbar.unit).unit, mbar.factor);
  for (const auto& [ending, unit] : units::key_endings)
    add(endings, fmt::format("['{}', '{}']", ending, unit));
  return fmt::format(
      "// Tables of the library, written by sinew/report/page/units_test.cpp.\n\n"
      "// Units by name: size in SI and powers of the base units.\n"
      "export const known_units = {{{}\n}};\n\n"
      "// Endings of keys and their units; the longest first.\n"
      "export const key_endings = [{}\n];\n",
      units, endings);
}

TEST(PageUnits, ScriptsOfThePageHaveTheTablesOfTheLibrary) {
  const std::string name = sinew::test::source_dir() + "/web/src/quantities.js";
  std::ifstream file(name);
  const std::string found((std::istreambuf_iterator<char>(file)), {});
  if (found == quantities_script()) return;
  const std::string wanted = ::testing::TempDir() + "quantities.js";
  std::ofstream(wanted) << quantities_script();
  ADD_FAILURE() << name << " differs from the library's tables: cp " << wanted << " " << name;
}

}  // namespace
}  // namespace sinew::report::units_test
