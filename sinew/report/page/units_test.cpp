// report/page/units_test.cpp - the table of units in a page agrees with the library.
#include "sinew/report/page/content.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace sinew::report::units_test
