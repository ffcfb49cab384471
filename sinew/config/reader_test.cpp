// Reader with small structs: values, provenance, and every kind of message.
#include "sinew/config/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sinew/units/literals.h"
#include "sinew/units/quantity.h"
#include "sinew/units/ranges.h"

namespace sinew::config::reader_test {
namespace {

using namespace units::literals;

enum class Law { stop, zero };

struct Spring {
  std::string name;
  double length = 0;
  double stiffness = 7;
  double pressure = 0;
  double ratio = 0.5;
  int count = 1;
  bool enabled = false;
  Law law = Law::zero;
  std::string note = "none";
  std::vector<double> valid;
  std::vector<double> curve;
  std::vector<std::string> words;
  std::map<std::string, double> angles;
};

template <class Visitor>
void fields(Visitor& v, Spring& s) {
  v.number({.name = "length", .unit = "m", .min = 0, .max = 1, .doc = "at rest"}, s.length);
  v.number({.name = "stiffness", .unit = "N/m", .min = 0, .optional = true}, s.stiffness);
  v.number({.name = "pressure", .unit = "Pa abs", .optional = true}, s.pressure);
  v.number({.name = "ratio", .unit = "1", .optional = true}, s.ratio);
  v.integer({.name = "count", .min = 1, .max = 4, .optional = true}, s.count);
  v.flag({.name = "enabled", .optional = true}, s.enabled);
  v.choice({.name = "law", .optional = true}, s.law, {{"stop", Law::stop}, {"zero", Law::zero}});
  v.text({.name = "note", .optional = true}, s.note);
  v.numbers({.name = "valid", .unit = "Pa abs", .optional = true}, s.valid);
  v.polynomial({.name = "curve", .unit = "1", .optional = true}, s.curve, "Pa");
  v.texts({.name = "words", .optional = true}, s.words);
  v.named_numbers({.name = "angles", .unit = "rad", .optional = true}, s.angles);
}

struct Machine {
  std::vector<Spring> springs;
  double height = 0;
  std::vector<Spring> tests;
};

template <class Visitor>
void fields(Visitor& v, Machine& m) {
  v.each({.name = "spring"}, m.springs, [](auto& inner, Spring& s) { fields(inner, s); });
  v.group({.name = "ground", .optional = true},
          [&](auto& inner) { inner.number({.name = "height", .unit = "m"}, m.height); });
  v.list({.name = "test", .optional = true}, m.tests,
         [](auto& inner, Spring& s) { fields(inner, s); });
}

// Reads one spring at the root.
struct Reading {
  explicit Reading(std::string_view toml, ReaderOptions options = {})
      : root(parse_text(toml, "a.toml")), reader(root, std::move(options)) {
    fields(reader, spring);
    try {
      reader.finish();
    } catch (const Error& error) {
      message = error.what();
    }
  }
  const Origin& origin(std::string_view path) const { return *find_origin(reader.origins(), path); }

  Node root;
  Reader reader;
  Spring spring;
  std::string message;
};

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(Reader, FillsAStruct) {
  const Reading r(R"(
length = "3.15 in"
stiffness = { value = "500 lbf/in", source = "appendix A" }
pressure = "62 psi gauge"
ratio = "85 %"
count = 2
enabled = true
law = { value = "stop", source = "[31]" }
note = "ok"
valid = ["0 psi gauge", "110 psi gauge"]
curve = { value = ["0.9969", "0.0005 1/psi", "-0.00002 1/psi2"], source = "[30]" }
words = ["a", "b"]
angles = { hip = "300 deg", knee = "292 deg" }
)");
  EXPECT_EQ(r.message, "");
  EXPECT_EQ(r.spring.length, 3.15_in);
  EXPECT_DOUBLE_EQ(r.spring.stiffness, 500.0_lbf / 1.0_in);
  EXPECT_EQ(r.spring.pressure, units::absolute(62.0_psi));
  EXPECT_EQ(r.spring.ratio, 0.85);
  EXPECT_EQ(r.spring.count, 2);
  EXPECT_TRUE(r.spring.enabled);
  EXPECT_EQ(r.spring.law, Law::stop);
  EXPECT_EQ(r.spring.note, "ok");
  EXPECT_EQ(r.spring.valid, (std::vector{units::atmosphere, units::absolute(110.0_psi)}));
  ASSERT_EQ(r.spring.curve.size(), 3u);
  EXPECT_EQ(r.spring.curve[0], 0.9969);
  EXPECT_DOUBLE_EQ(r.spring.curve[2], -0.00002 / (1.0_psi * 1.0_psi));
  EXPECT_EQ(r.spring.words, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(r.spring.angles.at("knee"), 292.0_deg);
}

TEST(Reader, AnOptionalValueKeepsItsDefault) {
  const Reading r("length = \"1 m\"");
  EXPECT_EQ(r.message, "");
  EXPECT_EQ(r.spring.stiffness, 7);
  EXPECT_TRUE(r.origin("stiffness").is_default);
  EXPECT_EQ(r.origin("stiffness").text, "7 N/m");
  EXPECT_EQ(r.origin("law").text, "zero");
}

TEST(Reader, TheCallersAtmosphereCounts) {
  const Reading r("length = \"1 m\"\npressure = \"0 psi gauge\"", {.atmosphere = 9e4});
  EXPECT_EQ(r.spring.pressure, 9e4);
}

TEST(Reader, AMissingKeyIsReportedWithItsMeaning) {
  EXPECT_EQ(Reading("ratio = 1").message,
            "a.toml:1:1: length: missing; expected m (length), 0 m to 1 m: at rest");
}

// A missing key has the same description as a wrong one.
TEST(Reader, AMissingKeyIsReportedWithItsWordsAndItsKind) {
  const Node root = parse_text("x = 1\n", "a.toml");
  Reader reader(root);
  Law law{};
  int legs = 0;
  bool runs = false;
  std::string name;
  std::vector<std::string> names;
  std::vector<double> numbers;
  reader.choice({.name = "law", .doc = "of friction"}, law,
                {{"stop", Law::stop}, {"zero", Law::zero}});
  reader.integer({.name = "legs", .min = 1, .max = 8, .doc = "of the robot"}, legs);
  reader.flag({.name = "runs", .doc = "at once"}, runs);
  reader.text({.name = "name", .doc = "for people"}, name);
  reader.texts({.name = "names"}, names);
  reader.numbers({.name = "numbers", .unit = "s", .min = 0}, numbers);
  EXPECT_EQ(to_text(reader.problems()),
            "a.toml:1:1: law: missing; expected \"stop\" or \"zero\": of friction\n"
            "a.toml:1:1: legs: missing; expected a whole number, 1 to 8: of the robot\n"
            "a.toml:1:1: runs: missing; expected true or false: at once\n"
            "a.toml:1:1: name: missing; expected a text: for people\n"
            "a.toml:1:1: names: missing; expected a list of texts\n"
            "a.toml:1:1: numbers: missing; expected a list, each value s (time), at least 0 s");
}

TEST(Reader, AWrongTypeIsReported) {
  EXPECT_TRUE(contains(Reading("length = 3.15").message,
                       "a.toml:1:1: length: found 3.15 without a unit; expected m (length); try "
                       "\"3.15 mm\" or \"3.15 in\""));
  const auto also = [](std::string line) { return Reading("length = \"1 m\"\n" + line).message; };
  EXPECT_EQ(also("count = \"2\""), "a.toml:2:1: count: found \"2\"; expected a whole number");
  EXPECT_EQ(also("count = 9"), "a.toml:2:1: count: found 9; expected 1 to 4");
  EXPECT_EQ(also("enabled = 1"), "a.toml:2:1: enabled: found 1; expected true or false");
  EXPECT_EQ(also("note = 3"), "a.toml:2:1: note: found 3; expected text; try \"3\"");
  EXPECT_EQ(also("words = \"a\""),
            "a.toml:2:1: words: found \"a\"; expected a list; try brackets around it: [ … ]");
  EXPECT_EQ(also("angles = 3"), "a.toml:2:1: angles: found 3; expected a table");
  EXPECT_TRUE(contains(also("ratio = { vale = 3 }"), "ratio: found a table; expected a number"));
}

TEST(Reader, AValueOutOfBoundsIsReportedInSi) {
  EXPECT_EQ(Reading("length = \"5 ft\"").message,
            "a.toml:1:1: length: found \"5 ft\", which is 1.524 m; expected 0 m to 1 m");
  EXPECT_EQ(Reading("length = \"1 m\"\nstiffness = \"-1 N/m\"").message,
            "a.toml:2:1: stiffness: found \"-1 N/m\"; expected at least 0 N/m");
}

TEST(Reader, AWholeNumberThatNoIntegerHoldsIsOutOfBounds) {
  const auto of = [](const Node& count) {
    Node root = parse_text("length = \"1 m\"", "a.toml");
    root.put(count);
    Reader reader(root);
    Spring spring;
    fields(reader, spring);
    return to_text(reader.problems());
  };
  EXPECT_TRUE(contains(of(make_number("count", 0x1p63)), "expected 1 to 4"));
  EXPECT_TRUE(contains(of(make_number("count", -1e300)), "expected 1 to 4"));
  EXPECT_TRUE(contains(of(make_integer("count", INT64_MIN)), "expected 1 to 4"));
  EXPECT_TRUE(contains(of(make_integer("count", (std::int64_t{1} << 32) + 2)), "expected 1 to 4"));
  EXPECT_TRUE(contains(of(make_number("count", 2)), "expected a whole number"));
}

// A default that is not finite means "not set".
TEST(Reader, ADefaultThatIsNoneIsNotSet) {
  const Node root = parse_text("", "a.toml");
  Reader reader(root);
  double arm = std::numeric_limits<double>::quiet_NaN();
  reader.number({.name = "arm", .unit = "m", .optional = true}, arm);
  ASSERT_EQ(reader.origins().size(), 1u);
  EXPECT_EQ(reader.origins()[0].text, "not set");
}

// The limits are the unit's, not the field's.
TEST(Reader, NoMachineIsAsLargeAsThat) {
  EXPECT_EQ(Reading("length = \"1 m\"\nstiffness = \"1e300 N/m\"").message,
            "a.toml:2:1: stiffness: found \"1e300 N/m\", which is 1e+300 N/m; expected at most "
            "1e+10 N/m: steel of a robot's size is not stiffer");
  EXPECT_EQ(Reading("length = \"1 m\"\nratio = -1e300").message,
            "a.toml:2:1: ratio: found -1e+300; expected at least -1e+09: no plain number of a "
            "machine is larger");
  EXPECT_TRUE(contains(Reading("length = \"1 m\"\ncurve = [1, \"1e300 1/Pa\"]").message,
                       "curve: found \"1e300 1/Pa\""));
}

TEST(Reader, TheReasonOfARangeIsReported) {
  double share = 0, period = 0;
  const Node root = parse_text("share = 1.2\nperiod = \"1 us\"\n", "a.toml");
  Reader reader(root);
  reader.number({.name = "share", .unit = "1", .min = 0, .max = 1, .why = "a share"}, share);
  reader.number({.name = "period", .unit = "s", .min = 0, .least = 1e-4, .why = "a tick"}, period);
  EXPECT_EQ(to_text(reader.problems()),
            "a.toml:1:1: share: found 1.2; expected 0 to 1: a share\n"
            "a.toml:2:1: period: found \"1 us\", which is 1e-06 s; expected 0, or at least "
            "0.0001 s: a tick");
}

// A unit without a row would have the widest range.
TEST(Reader, EveryRangeIsOfAUnit) {
  for (const units::Range& range : units::ranges) {
    EXPECT_FALSE(units::parse_quantity("1 " + std::string(range.unit), range.unit).mistake)
        << range.unit;
    EXPECT_GT(range.most, 0) << range.unit;
    EXPECT_FALSE(range.why.empty()) << range.unit;
  }
}

TEST(Reader, NanIsReported) {
  EXPECT_EQ(Reading("length = \"1 m\"\nratio = nan").message,
            "a.toml:2:1: ratio: found nan; expected a finite number");
}

TEST(Reader, AChoiceListsItsWords) {
  EXPECT_EQ(Reading("length = \"1 m\"\nlaw = \"stpo\"").message,
            "a.toml:2:1: law: found \"stpo\"; expected \"stop\" or \"zero\"; try \"stop\"");
}

TEST(Reader, AnUnknownKeyGetsASuggestion) {
  EXPECT_TRUE(contains(Reading("length = \"1 m\"\nstifness = \"1 N/m\"").message,
                       "a.toml:2:1: stifness: found an unknown key; expected "));
  EXPECT_TRUE(
      contains(Reading("length = \"1 m\"\nstifness = \"1 N/m\"").message, "; try stiffness"));
  EXPECT_TRUE(contains(Reading("length = { value = \"1 m\", sorce = \"x\" }").message,
                       "length.sorce: found an unknown key"));
}

TEST(Reader, AnUnknownKeyHasItsPathInTablesAndLists) {
  const Node root = parse_text(
      "[spring.a]\nlength = \"1 m\"\nlenght = 1\n[[test]]\nlength = \"1 m\"\ncuont = 2\n",
      "a.toml");
  Reader reader(root);
  Machine machine;
  fields(reader, machine);
  EXPECT_THROW(reader.finish(), Error);
  const std::string text = to_text(reader.problems());
  EXPECT_TRUE(contains(text, "a.toml:3:1: spring.a.lenght: found an unknown key")) << text;
  EXPECT_TRUE(contains(text, "try length"));
  EXPECT_TRUE(contains(text, "a.toml:6:1: test[0].cuont: found an unknown key")) << text;
}

TEST(Reader, AllProblemsComeAtOnce) {
  const Reading r("length = 1\ncount = 9\nnoise = 1\n");
  EXPECT_EQ(std::count(r.message.begin(), r.message.end(), '\n'), 2);
  EXPECT_EQ(r.reader.problems().size(), 3u);
}

TEST(Reader, ProvenanceIsThatOfTheFile) {
  const Reading r(R"(source = "table 6-1"
length = { value = "3.1 in", fit = true, range = ["3.05 in", "3.25 in"], uncertainty = "0.01 in", source = "calibration" }
stiffness = "3 N/m"
ratio = { value = 0.3, guess = true }
)");
  EXPECT_EQ(r.message, "");
  const Origin& length = r.origin("length");
  EXPECT_EQ(length.text, "3.1 in");
  EXPECT_EQ(length.source, "calibration");
  EXPECT_TRUE(length.fit);
  EXPECT_EQ(length.range, (std::vector<std::string>{"3.05 in", "3.25 in"}));
  EXPECT_EQ((*length.range_si)[1], 3.25_in);
  EXPECT_EQ(length.uncertainty, "0.01 in");
  EXPECT_EQ(length.where.line, 2);
  EXPECT_EQ(r.origin("stiffness").source, "table 6-1");
  EXPECT_EQ(r.origin("ratio").source, "table 6-1");
  EXPECT_TRUE(r.origin("ratio").guess);
  EXPECT_TRUE(r.reader.warnings().empty());
}

TEST(Reader, ATablesRangeCoversWhatHasItsUnit) {
  const Reading r("fit = true\nrange = [\"1 in\", \"2 in\"]\nlength = \"3 in\"\nratio = 0.85\n");
  EXPECT_EQ(r.message, "");
  EXPECT_TRUE(r.origin("length").fit);
  EXPECT_TRUE(r.origin("length").range_si);
  EXPECT_FALSE(r.origin("ratio").range_si);
  ASSERT_EQ(r.reader.warnings().size(), 1u);
  EXPECT_EQ(to_text(r.reader.warnings()[0]),
            "a.toml:3:1: length: found \"3 in\"; expected a value in its own range 1 in to 2 in; "
            "try a wider range, or check the fit");
}

TEST(Reader, ASourceDoesNotReachIntoAnotherFile) {
  Node root = parse_text("source = \"base\"\nlength = \"1 m\"\nratio = 1\n", "base.toml");
  merge(root, parse_text("ratio = 2\n", "own.toml"));
  Reader reader(root);
  Spring spring;
  fields(reader, spring);
  reader.finish();
  EXPECT_EQ(find_origin(reader.origins(), "length")->source, "base");
  EXPECT_EQ(find_origin(reader.origins(), "ratio")->source, "");
}

TEST(Reader, ADamagedRangeOrUncertaintyIsReported) {
  EXPECT_TRUE(contains(Reading("length = { value = \"1 m\", range = [\"2 m\", \"1 m\"] }").message,
                       "length.range: found 2 m, 1 m; expected two quantities, the lower"));
  EXPECT_TRUE(contains(Reading("length = { value = \"1 m\", range = [\"2 s\", \"3 s\"] }").message,
                       "length.range: found \"2 s\", s (time); expected m (length)"));
  EXPECT_TRUE(contains(Reading("length = { value = \"1 m\", uncertainty = \"2 s\" }").message,
                       "length.uncertainty: found \"2 s\""));
  EXPECT_EQ(Reading("length = { value = \"1 m\", uncertainty = \"2 %\" }").message, "");
  EXPECT_TRUE(contains(Reading("length = { value = \"1 m\", fit = true, guess = true }").message,
                       "found both fit and guess"));
}

TEST(Reader, ANumberWithoutASourceIsAsBadAsTheCallerRequests) {
  const auto needed = [](bool is) {
    return ReaderOptions{.needs_source = [is](const std::string&) { return is; }};
  };
  const std::string toml = "length = \"1 m\"\nnote = \"no source needed\"";
  const Reading told(toml, needed(false));
  EXPECT_EQ(told.message, "");
  ASSERT_EQ(told.reader.unsourced().size(), 1u);
  EXPECT_EQ(told.reader.unsourced()[0].key, "length");
  EXPECT_EQ(Reading(toml, needed(true)).message,
            "a.toml:1:1: length: found \"1 m\" without a source; expected where the value comes "
            "from; try { value = \"1 m\", source = \"…\" }");
}

TEST(Reader, NamedTablesKeepTheirOrder) {
  const Node root = parse_text(
      "[spring.z]\nlength = \"1 m\"\n[spring.a]\nlength = \"2 m\"\n[ground]\nheight = \"-13 in\"\n"
      "[[test]]\nlength = \"0.1 m\"\n[[test]]\nlength = \"0.2 m\"\n",
      "a.toml");
  Reader reader(root);
  Machine machine;
  fields(reader, machine);
  try {
    reader.finish();
    FAIL() << "2 m is too long";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.toml:4:1: spring.a.length: found \"2 m\"; expected 0 m to 1 m");
  }
  ASSERT_EQ(machine.springs.size(), 2u);
  EXPECT_EQ(machine.springs[0].name, "z");
  EXPECT_EQ(machine.height, -13.0_in);
  ASSERT_EQ(machine.tests.size(), 2u);
  EXPECT_EQ(machine.tests[1].length, 0.2);
}

TEST(Reader, AMissingTableIsReportedOnce) {
  const Node root = parse_text("spring = 3\n", "a.toml");
  Reader reader(root);
  Machine machine;
  fields(reader, machine);
  EXPECT_THROW(reader.finish(), Error);
  EXPECT_EQ(to_text(reader.problems()), "a.toml:1:1: spring: found 3; expected a table");
}

TEST(Reader, AVisitorMayComplainAndAPartMayBeRead) {
  const Node root = parse_text("length = \"1 m\"\nother = 1\n", "a.toml");
  Reader reader(root);
  Spring spring;
  fields(reader, spring);
  EXPECT_NO_THROW(reader.finish_part());
  reader.report_conflict("length", "1 m", "less than the other one");
  EXPECT_THROW(reader.finish_part(), Error);
  EXPECT_EQ(to_text(reader.problems()),
            "a.toml:1:1: length: found 1 m; expected less than the other one");
}

}  // namespace
}  // namespace sinew::config::reader_test
