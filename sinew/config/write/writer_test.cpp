// The reader reads back the writer's text to the same bits.
#include "sinew/config/write/writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/config/reader.h"

namespace sinew::config::writer_test {
namespace {

enum class Law { stop, zero };

struct Part {
  std::string name;
  double length = 0.5;
  double pressure = 1e5;
  double ratio = 0.25;
  double unset = std::nan("");
  int count = 3;
  bool enabled = true;
  Law law = Law::stop;
  std::string note = "a \"quoted\" \\ note\twith a tab";
  std::vector<double> valid = {1, 2};
  std::vector<double> curve = {1, 2, 3};
  std::vector<std::string> words = {"*"};
  std::map<std::string, double> angles = {{"hip", 1.5}};

  bool operator==(const Part& o) const {
    return name == o.name && length == o.length && pressure == o.pressure && ratio == o.ratio &&
           count == o.count && enabled == o.enabled && law == o.law && note == o.note &&
           valid == o.valid && curve == o.curve && words == o.words && angles == o.angles;
  }
};

struct Whole {
  std::vector<Part> parts;
  std::vector<Part> tests;
  Part own;
};

template <class Visitor>
void fields(Visitor& v, Part& p) {
  v.group({.name = "inner"}, [&](auto& inner) {
    inner.number({.name = "length", .unit = "m", .min = 0, .max = 10, .doc = "a | bar"}, p.length);
  });
  v.number({.name = "pressure", .unit = "Pa abs", .min = 0, .doc = "of the air"}, p.pressure);
  v.number({.name = "ratio", .unit = "1"}, p.ratio);
  v.number({.name = "unset", .unit = "m", .optional = true}, p.unset);
  v.integer({.name = "count"}, p.count);
  v.flag({.name = "enabled"}, p.enabled);
  v.choice({.name = "law"}, p.law, {{"stop", Law::stop}, {"zero", Law::zero}});
  v.text({.name = "note"}, p.note);
  v.numbers({.name = "valid", .unit = "Pa gauge"}, p.valid);
  v.polynomial({.name = "curve", .unit = "m"}, p.curve, "m");
  v.texts({.name = "words"}, p.words);
  v.named_numbers({.name = "angles", .unit = "rad"}, p.angles);
}

template <class Visitor>
void fields(Visitor& v, Whole& w) {
  v.each({.name = "part"}, w.parts, [](auto& inner, Part& p) { fields(inner, p); });
  v.list({.name = "test"}, w.tests, [](auto& inner, Part& p) { fields(inner, p); });
  fields(v, w.own);
}

class Random {
 public:
  // Within the smallest range of all units (units/ranges.h).
  double real() { return mantissa_(engine_) * std::pow(10.0, exponent_(engine_)); }
  Part part(std::string name) {
    Part p;
    p.name = std::move(name);
    p.length = std::abs(mantissa_(engine_));
    p.pressure = std::abs(real());
    p.ratio = real();
    p.count = static_cast<int>(engine_() % 100);
    p.enabled = engine_() % 2 == 0;
    p.law = engine_() % 2 == 0 ? Law::stop : Law::zero;
    p.valid = {real(), real()};
    p.curve = {real(), real(), real(), real()};
    p.angles = {{"hip", real()}, {"knee", real()}};
    return p;
  }

 private:
  std::mt19937_64 engine_{41};
  std::uniform_real_distribution<double> mantissa_{-10, 10};
  std::uniform_int_distribution<int> exponent_{-17, 1};
};

Whole read_back(const std::string& toml, Origins* origins = nullptr) {
  const Node root = parse_text(toml, "resolved.toml");
  root.find("format")->used = true;
  Reader reader(root);
  Whole whole;
  fields(reader, whole);
  reader.finish();
  if (origins) *origins = reader.origins();
  return whole;
}

TEST(Writer, BringsBackTheSameBits) {
  Random random;
  for (int i = 0; i < 50; ++i) {
    Whole whole{{random.part("b"), random.part("a.dot"), random.part("758")},
                {random.part(""), random.part("")},
                random.part("")};
    Writer writer;
    writer.format("robot");
    fields(writer, whole);
    const Whole back = read_back(writer.text());
    EXPECT_EQ(back.parts, whole.parts) << writer.text();
    EXPECT_EQ(back.tests, whole.tests);
    EXPECT_EQ(back.own, whole.own);
    EXPECT_TRUE(std::isnan(back.own.unset));
  }
}

TEST(Writer, PrintsSiAndPlainToml) {
  Whole whole{{Part{.name = "a"}}, {}, {}};
  Writer writer;
  writer.format("robot");
  fields(writer, whole);
  const std::string text = writer.text();
  EXPECT_EQ(text.substr(0, text.find('\n')), "format = \"sinew.robot/1\"");
  EXPECT_NE(text.find("pressure = \"100000 Pa abs\"\nratio = 0.25\n"), std::string::npos) << text;
  EXPECT_NE(text.find("curve = [\"1 m\", 2.0, \"3 1/m\"]"), std::string::npos) << text;
  EXPECT_NE(text.find("[part.a.inner]\nlength = \"0.5 m\""), std::string::npos) << text;
}

TEST(Writer, KeepsWhereValuesCameFrom) {
  Whole whole{{Part{.name = "a"}}, {}, {}};
  Origins origins(2);
  origins[0].path = "part.a.inner.length";
  origins[0].source = "calibration";
  origins[0].fit = true;
  origins[0].range = {"0.4 m", "20 in"};
  origins[0].uncertainty = "1 %";
  origins[1].path = "ratio";
  origins[1].is_default = true;
  Writer writer(&origins);
  writer.format("robot");
  fields(writer, whole);
  EXPECT_NE(
      writer.text().find("length = { value = \"0.5 m\", source = \"calibration\", fit = true, "
                         "range = [\"0.4 m\", \"20 in\"], uncertainty = \"1 %\" }"),
      std::string::npos)
      << writer.text();
  Origins back;
  EXPECT_EQ(read_back(writer.text(), &back).own, whole.own);
  EXPECT_EQ(find_origin(back, "part.a.inner.length")->source, "calibration");
  EXPECT_TRUE(find_origin(back, "part.a.inner.length")->fit);
  EXPECT_EQ(find_origin(back, "ratio")->source, "default");
}

}  // namespace
}  // namespace sinew::config::writer_test
