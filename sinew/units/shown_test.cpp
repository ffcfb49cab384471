// units/shown_test.cpp - units in which numbers are shown.
#include "sinew/units/shown.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "tests/places.h"

namespace sinew::units::shown_test {
namespace {

constexpr UnitSet all_sets[] = {UnitSet::si, UnitSet::thesis, UnitSet::metric};

ShownUnits chosen(std::string_view text) {
  const ShownUnitsReading reading = read_shown_units(text);
  EXPECT_FALSE(reading.mistake) << text << ": " << to_text(*reading.mistake);
  return reading.units;
}

TEST(ShownUnits, ShowingAndGoingBackGivesTheValueInEverySetAndUnit) {
  const ShownUnits custom = chosen("metric,pressure=kPa gauge,length=cm,temperature=degR");
  for (const ShownUnits& units :
       {ShownUnits(UnitSet::si), ShownUnits(UnitSet::thesis), ShownUnits(UnitSet::metric), custom})
    for (const ShownEntry& entry : shown_entries(units))
      for (const double si : {-3.5e5, -0.02, 0.0, 1e-6, 0.37, 101353.0, 4e7})
        for (const double size : {ShownUnits::unknown_size, std::abs(si)}) {
          const ShownUnit shown = units.of(entry.unit, size);
          EXPECT_NEAR(shown.back(shown.of(si)), si, 1e-12 * (std::abs(si) + 2e5)) << shown.name;
        }
}

// A shown unit is one that files can be read in: its scale is the grammar's.
TEST(ShownUnits, AreWhatTheirNamesSay) {
  for (const UnitSet set : all_sets)
    for (const ShownEntry& entry : shown_entries(set))
      for (const ShownUnit& shown : entry.shown) {
        const Unit unit = read_unit(unit_and_reference(shown.name)[0]).unit;
        const double zero = shown.gauge ? atmosphere : 0;
        const ShownUnit whole = ShownUnits(set).of(entry.unit, 1 / shown.scale);
        EXPECT_NEAR(whole.of(unit.to_si(7) + zero), 7, 1e-9) << entry.unit << " " << shown.name;
      }
}

TEST(ShownUnits, MetricIsThatOfALaboratory) {
  const ShownUnits metric(UnitSet::metric);
  EXPECT_EQ(metric.text(0.08, "m"), "80 mm");
  EXPECT_EQ(metric.text(120, "N"), "120 N");
  EXPECT_EQ(metric.text(atmosphere + 4.2 * bar, "Pa"), "4.2 bar gauge");
  EXPECT_EQ(metric.text(0.1 * bar, "Pa diff"), "0.1 bar diff");
  EXPECT_EQ(metric.of("Pa diff").label(), "bar");
  EXPECT_EQ(metric.text(30 * degree, "rad"), "30 deg");
  EXPECT_EQ(metric.text(0.35e-3, "s"), "0.35 ms");
  EXPECT_EQ(metric.text(13.71, "s"), "13.71 s");
  EXPECT_EQ(metric.text(1.432, "m"), "1432 mm");
  EXPECT_EQ(metric.text(293.15, "K"), "20 degC");
  EXPECT_EQ(metric.text(0.55, "share"), "55 %");
  EXPECT_EQ(metric.text(0.55, "1"), "0.55");
  EXPECT_EQ(metric.text(3, "furlong"), "3 furlong");
}

TEST(ShownUnits, OfUnitsThatDifferByAThousandTheFirstBelowAThousandIsShown) {
  const auto name = [](std::string_view unit, double largest, UnitSet set = UnitSet::si) {
    return ShownUnits(set).of(unit, largest).name;
  };
  EXPECT_EQ(name("m", 0.99), "mm");
  EXPECT_EQ(name("m", 1.5), "m");
  EXPECT_EQ(name("m", 5000), "m");
  EXPECT_EQ(name("m", ShownUnits::unknown_size), "m");
  EXPECT_EQ(name("kg", 1e-7), "mg");
  EXPECT_EQ(name("kg", 0.9), "g");
  EXPECT_EQ(name("kg", 20), "kg");
  EXPECT_EQ(name("N", 1e9), "N");
  EXPECT_EQ(name("m", 1.5, UnitSet::thesis), "in");
  EXPECT_EQ(name("m", 1.5, UnitSet::metric), "mm");
  EXPECT_EQ(name("s", 0.3, UnitSet::metric), "ms");
  EXPECT_EQ(name("s", 13.7, UnitSet::metric), "s");
}

TEST(ShownUnits, APressureKeepsTheRequestedReference) {
  const ShownUnits thesis(UnitSet::thesis);
  EXPECT_EQ(thesis.text(62 * psi, "Pa abs"), "62 psi abs");
  EXPECT_EQ(thesis.text(62 * psi, "Pa gauge"), "62 psi gauge");
  EXPECT_EQ(thesis.text(atmosphere + 62 * psi, "Pa"), "62 psi gauge");
  EXPECT_EQ(ShownUnits().text(101325, "Pa"), "101.3 kPa abs");
  EXPECT_NEAR(thesis.of("Pa", 0, 95000).of(95000 + psi), 1, 1e-12);  // a room on a mountain
}

TEST(ShownUnits, ADifferenceCountsFromNothing) {
  const ShownUnits units = chosen("metric,temperature=degC");
  EXPECT_EQ(units.of_difference("Pa").name, "bar diff");
  EXPECT_EQ(units.of_difference("Pa gauge").name, "bar diff");
  EXPECT_EQ(units.of_difference("K").of(5), 5);
  for (const ShownEntry& entry : shown_entries(units))
    EXPECT_EQ(units.of_difference(entry.unit).of(0), 0) << entry.unit;
}

TEST(ShownUnits, ChoicesStandOnTopOfASet) {
  const ShownUnits units = chosen("metric, pressure=kPa gauge,length=cm");
  EXPECT_EQ(units.text(0.08, "m"), "8 cm");
  EXPECT_EQ(units.text(atmosphere + 4.2 * bar, "Pa"), "420 kPa gauge");
  EXPECT_EQ(units.of("Pa diff").name, "kPa diff") << "a difference follows the pressure";
  EXPECT_EQ(units.of("m/s").name, "mm/s") << "what nobody chose is the set's";
  EXPECT_EQ(chosen(units.text()), units) << "its text reads back";
  EXPECT_EQ(chosen("si,pressure-difference=psi").of("Pa diff").name, "psi diff");
}

TEST(ShownUnits, ChoicesWithoutASetStandOnTopOfWhatWouldHold) {
  const ShownUnits below = chosen("metric,length=cm");
  const ShownUnits units = read_shown_units("force=kN", below).units;
  EXPECT_EQ(units.text(), "metric,length=cm,force=kN");
  EXPECT_EQ(read_shown_units("thesis", below).units.text(), "thesis") << "a set begins anew";
}

std::string docs_page(const std::string& name) {
  std::ifstream file(sinew::test::source_dir() + "/docs/reference/" + name);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string padded(std::string_view text, std::size_t width) {
  return std::string(text) + std::string(width - text.size(), ' ');
}

// `sinew help units` has a row for each quantity whose units differ between the sets.
TEST(ShownUnits, AreThoseOfTheHelp) {
  const std::string help = docs_page("help.md");
  for (const ShownQuantity& q : shown_quantities) {
    const std::string row = "\n" + padded(q.name, 21) + padded(q.si.usual, 13) +
                            padded(q.thesis.usual, 17) + std::string(q.metric.usual) + "\n";
    const bool differ = q.si.usual != q.thesis.usual || q.si.usual != q.metric.usual;
    EXPECT_EQ(help.find(row) != help.npos, differ) << "docs/reference/help.md: " << row;
  }
}

// `sinew help units` lists every unit once, with others of its dimension.
TEST(ShownUnits, ThatAreReadAreThoseOfTheHelp) {
  const std::string help = docs_page("help.md");
  const std::size_t begin = help.find("```text\n", help.find("Units that are read:")) + 8;
  std::istringstream rows(help.substr(begin, help.find("```", begin) - begin));
  std::set<std::string> listed;
  for (std::string row; std::getline(rows, row);) {
    std::istringstream names(row.substr(19));
    std::optional<Dimension> dimension;
    for (std::string name; names >> name;) {
      if (name.ends_with(',')) name.pop_back();
      const auto unit = find_unit(name);
      ASSERT_NE(unit, known_units.end()) << name;
      EXPECT_TRUE(listed.insert(name).second) << name << " twice";
      EXPECT_EQ(unit->dimension, dimension.value_or(unit->dimension)) << row;
      dimension = unit->dimension;
    }
  }
  EXPECT_EQ(listed.size(), known_units.size() - 1) << "all but %, which the text explains";
}

// docs/reference/units.md has the same table, row for row.
TEST(ShownUnits, AreThoseOfTheDocs) {
  const std::string docs = docs_page("units.md");
  const auto cell = [](const ShownChoice& c) {
    std::string out;
    for (const std::string_view unit : {c.small, c.usual, c.large})
      if (!unit.empty()) out += (out.empty() ? "`" : ", `") + std::string(unit) + "`";
    return out;
  };
  for (const ShownQuantity& q : shown_quantities) {
    const std::string row = "| " + std::string(q.name) + " | " + cell(q.si) + " | " +
                            cell(q.thesis) + " | " + cell(q.metric) + " |\n";
    EXPECT_NE(docs.find(row), docs.npos) << "docs/reference/units.md lacks " << row;
  }
}

TEST(ShownUnits, WrongWordsNameTheChoices) {
  const auto message = [](std::string_view text) {
    return to_text(read_shown_units(text).mistake.value());
  };
  EXPECT_EQ(
      message("imperial"),
      "found \"imperial\"; expected si, thesis or metric, then QUANTITY=UNIT; try \"metric\", "
      "or \"metric,pressure=kPa gauge,length=cm\"");
  EXPECT_EQ(message("meter"),
            "found \"meter\"; expected si, thesis or metric, then QUANTITY=UNIT; try \"metric\"");
  EXPECT_NE(
      message("metric,width=cm").find("found \"width\", which is no quantity; expected length"),
      std::string::npos);
  EXPECT_EQ(message("length=bar"),
            "found \"bar\", which measures something else; expected a unit of length, as in or mm; "
            "try length=mm");
  EXPECT_EQ(message("pressure=kPa"),
            "found \"kPa\", a pressure without its reference; expected a unit of pressure, as psi "
            "gauge or bar gauge; try pressure=kPa gauge, or pressure=kPa abs");
  EXPECT_EQ(message("length=cm,metric"),
            "found \"length=cm,metric\"; expected one set, named first; try \"metric\" alone");
  EXPECT_TRUE(read_shown_units("").mistake);
  EXPECT_TRUE(read_shown_units("metric,").mistake);
  EXPECT_TRUE(read_shown_units("length=mm gauge").mistake);
  EXPECT_TRUE(read_shown_units("length=").mistake);
}

TEST(QuantityUnit, IsReadWithWhatAPressureCountsFrom) {
  const auto back = [](const char* unit, double number) {
    const auto given = read_quantity_unit(unit, 1e5);
    return given ? std::string(given->stored) + " " + std::to_string(given->unit.back(number))
                 : "none";
  };
  EXPECT_EQ(back("bar gauge", 2), "Pa 300000.000000");
  EXPECT_EQ(back("bar abs", 2), "Pa 200000.000000");
  EXPECT_EQ(back("kPa diff", 2), "Pa diff 2000.000000");
  EXPECT_EQ(back("MPa", 2), "N/m2 2000000.000000") << "a stress";
  EXPECT_EQ(back("in", 2), "m 0.050800");
  EXPECT_EQ(back("degC", 0), "K 273.150000");
  EXPECT_EQ(back("kg m2", 1), "none");
  EXPECT_EQ(back("1", 1), "none");
}

}  // namespace
}  // namespace sinew::units::shown_test
