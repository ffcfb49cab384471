// Broken measurements, as people bring them: the program says what it found, where, what it
// expected and what to try, and ends with 1. And foreign files, which it reads once it is told what
// their columns mean.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::identify_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::ordered_json;

struct Broken {
  const char* what;
  Words words;                     // after "identify"
  std::string text;                // of data.csv
  std::vector<std::string> parts;  // of the message
};

void expect_refused(const Broken& b) {
  const Workspace w;
  write_text(w / "data.csv", b.text);
  Words words{"identify"};
  words.insert(words.end(), b.words.begin(), b.words.end());
  words.insert(words.end(), {"data.csv", "-o", "out.toml"});
  const Result result = w.sinew(words);
  EXPECT_EQ(result.code, 1) << b.what << "\n" << result.out;
  EXPECT_THAT(result.out, IsEmpty()) << b.what;
  EXPECT_FALSE(std::filesystem::exists(w / "out.toml")) << b.what;
  EXPECT_THAT(result.err, AllOf(HasSubstr("data.csv"), HasSubstr("found "), HasSubstr("expected "),
                                HasSubstr("try ")))
      << b.what;
  for (const std::string& part : b.parts) EXPECT_THAT(result.err, HasSubstr(part)) << b.what;
}

// What a check before the fit refuses: it is named, with what to do, and nothing is written.
void expect_red(const std::string& check, const std::string& text, const std::string& advice) {
  const Workspace w;
  write_text(w / "data.csv", text);
  const Result result = w.sinew({"identify", "static", "data.csv", "-o", "out.toml"});
  EXPECT_EQ(result.code, 1) << check;
  EXPECT_THAT(result.out, IsEmpty()) << check;
  EXPECT_FALSE(std::filesystem::exists(w / "out.toml")) << check;
  EXPECT_THAT(result.err, AllOf(HasSubstr(check + ":"), HasSubstr(advice), HasSubstr("--anyway")));
}

// A braid's length and diameter.
const std::string mesh = "length [mm],diameter [mm]\n65,11.7\n75,10.5\n85,9.0\n95,6.8\n";

// Returns the tension of an ideal braid at three lengths and four pressures from 100 kPa on.
std::string map(double pressure_step = 100e3) {
  std::string text = "length [mm],pressure [kPa gauge],force [N]\n";
  for (const double length : {0.080, 0.090, 0.100})
    for (int i = 0; i < 4; ++i) {
      const double pressure = 100e3 + pressure_step * i;
      const double force = pressure * (3 * length * length - 0.01148) / (4 * 3.14159 * 5.35);
      for (const double value : {1e3 * length, 1e-3 * pressure, force}) {
        text += std::to_string(value);
        text += value == force ? '\n' : ',';
      }
    }
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// --- the ten ---

TEST(BrokenInput, WrongUnit) {
  expect_refused({"a unit of another kind",
                  {"geometry"},
                  replaced(mesh, "length [mm]", "length [psi]"),
                  {"data.csv:1:1: length: found the unit \"psi\"; expected m (length)"}});
  expect_refused(
      {"meters that are millimeters",
       {"geometry"},
       replaced(mesh, "length [mm]", "length [m]"),
       {"data.csv:1:1: length: found values up to 95 m", "try --unit length=cm or mm or in"}});
  expect_refused(
      {"no unit",
       {"geometry"},
       replaced(mesh, "length [mm]", "length"),
       {"data.csv:1:1: length: found the column \"length\" without a unit", "--unit length="}});
  expect_refused({"a pressure of nobody knows what",
                  {"static"},
                  replaced(map(), "kPa gauge", "kPa"),
                  {"data.csv:1:13: pressure: found the unit \"kPa\"", "gauge"}});
  expect_refused(
      {"pascals that are kilopascals",
       {"static"},
       replaced(map(), "kPa gauge", "Pa gauge"),
       {"data.csv:1:13: pressure: found values up to 400 Pa gauge", "--unit pressure=kPa gauge"}});
}

TEST(BrokenInput, SwappedColumns) {
  expect_refused({"length and diameter",
                  {"geometry"},
                  replaced(mesh, "length [mm],diameter [mm]", "diameter [mm],length [mm]"),
                  {"they may be swapped"}});
  expect_refused({"load and output",
                  {"sensor"},
                  "gage [V],load [N]\n0,0\n10,0.4\n20,0.8\n60,2.4\n",
                  {"data.csv:3:1: gage: found 10 V", "at most 5 V", "they may be swapped"}});
  expect_red("mounts in order",
             replaced(map(), "pressure [kPa gauge],force [N]", "force [N],pressure [kPa gauge]"),
             "columns of force and pressure");
}

TEST(BrokenInput, ClippedSensor) {
  std::string text = "load [lbf],gage [V]\n";
  for (int load = 0; load <= 40; load += 2)
    text += std::to_string(load) + "," + std::to_string(std::min(1.2, 0.17 * load)) + "\n";
  expect_refused({"an amplifier that ends at 1.2 V",
                  {"sensor"},
                  text,
                  {"data.csv: gage: found 17 of 21 readings at an end (first in line 6)", "1.2 V",
                   "less gain"}});
}

TEST(BrokenInput, SaturatedConverter) {
  std::string text = "load [lbf],gage [count]\n";
  for (int load = 20; load <= 40; load += 2)
    text += std::to_string(load) + "," + std::to_string(std::min(4095, 139 * load)) + "\n";
  expect_refused({"4095 counts",
                  {"sensor"},
                  text,
                  {"data.csv: gage: found 6 of 11 readings at an end (first in line 7)", "4.999 V",
                   "--full-scale"}});
  expect_refused({"counts that twelve bits do not have",
                  {"sensor"},
                  "load [N],gage [count]\n0,0\n10,5000\n",
                  {"data.csv:3:1: gage: found 5000 count; expected 0 to 4095", "--bits"}});
}

TEST(BrokenInput, OneLengthOnly) {
  expect_refused(
      {"a mesh that was not moved",
       {"geometry"},
       "length [mm],diameter [mm]\n80,9.8\n80,9.9\n80.5,9.7\n",
       {"data.csv: length: found 80 mm throughout", "one length does not tell b from n"}});
  expect_red("lengths",  // of a muscle whose mesh is unknown
             "length [mm],pressure [kPa gauge],force [N]\n80,100,11\n80,200,22\n80,300,33\n"
             "80,400,44\n",
             "--actuator");
  expect_refused({"one load",
                  {"sensor"},
                  "load [N],gage [V]\n10,1\n10,1.1\n",
                  {"data.csv: gage: found one known value throughout, 10 N"}});
}

TEST(BrokenInput, ConstantPressure) {
  expect_refused({"a muscle at one pressure",
                  {"static"},
                  map(0),
                  {"data.csv: pressure: found 100 kPa gauge throughout", "several pressures"}});
  expect_refused({"a dead sensor",
                  {"sensor"},
                  "load [N],gage [V]\n10,2\n20,2\n30,2\n40,2\n",
                  {"data.csv: gage: found 2 V throughout", "wiring"}});
}

TEST(BrokenInput, RowsThatAreNoNumbers) {
  const std::string text = replaced(mesh, "10.5", "nan");
  expect_refused({"nan",
                  {"geometry"},
                  replaced(text, "9.0", ""),
                  {"data.csv:3:4: diameter: found \"nan\"; expected a finite number",
                   "data.csv:4:4: diameter: found an empty cell", "--drop-incomplete"}});
}

TEST(BrokenInput, DecimalCommas) {
  const Workspace w;
  write_text(w / "points.csv", mesh);
  write_text(w / "commas.csv", replaced(replaced(mesh, ",", ";"), ".", ","));
  for (const std::string name : {"points", "commas"}) {
    const Result r = w.sinew({"identify", "geometry", name + ".csv", "-o", name + ".toml"});
    EXPECT_EQ(r.code, 0) << r.err;
  }
  EXPECT_EQ(replaced(read_text(w / "commas.toml"), "commas.csv", "points.csv"),
            read_text(w / "points.toml"));
  expect_refused(
      {"commas between",
       {"geometry"},
       "length [mm],diameter [mm]\n65,0,11,7\n75,0,10,5\n",
       {"data.csv:2:1: row: found 4 cells (2 such rows); expected 2", "decimal points"}});
}

TEST(BrokenInput, NoHeader) {
  expect_refused({"numbers from the first line on",
                  {"geometry"},
                  "65,11.7\n75,10.5\n",
                  {"data.csv:1:1: header: found numbers in the first line", "--columns"}});
}

TEST(BrokenInput, TimeRunningBackwards) {
  expect_refused({"a swing that was recorded twice",
                  {"dynamic", "--actuator", "robots/leg/actuator.toml", "--mass", "6 lb"},
                  "time [s],length [mm]\n0,80\n0.1,81\n0.2,80\n0,80\n0.1,81\n",
                  {"data.csv:5:1: found 2 recordings one after the other"}});
  expect_refused({"two recordings in one file",
                  {"sensor"},
                  "time [s],load [N],gage [V]\n0,0,0\n1,10,0.4\n0,0,0\n1,20,0.8\n",
                  {"data.csv:4:1: found 2 recordings one after the other", "try --part 1"}});
}

TEST(BrokenInput, SeveralThingsAreToldAtOnce) {
  const Workspace w;
  write_text(w / "data.csv", replaced(replaced(mesh, "10.5", "ten"), "6.8", "nan"));
  const Result result = w.sinew({"identify", "geometry", "data.csv"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("data.csv:3:4: diameter: found \"ten\""),
                                HasSubstr("data.csv:5:4: diameter: found \"nan\"")));
}

// --- foreign files ---

// The same mesh in every dress gives the same braid.
TEST(ForeignFile, SaysTheSameInAnyDress) {
  const Workspace w;
  const auto turns = [&](const std::string& text, Words more) {
    write_text(w / "data.csv", text);
    Words words{"identify", "geometry", "data.csv", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.code == 0 ? Json::parse(result.out)["turns"].get<double>() : 0;
  };
  const double plain = turns(mesh, {});
  EXPECT_GT(plain, 1);
  const std::string body = mesh.substr(mesh.find('\n') + 1);
  EXPECT_EQ(turns("# a rig\n\n" + body, {"--columns", "length [mm],diameter [mm]"}), plain);
  EXPECT_EQ(turns("L;D\n" + replaced(body, ",", ";"),
                  {"--map", "length=L,diameter=D", "--unit", "L=mm", "--unit", "D=mm"}),
            plain);
  EXPECT_EQ(turns("L mm\td [mm]\r\n" + replaced(replaced(body, ",", "\t"), "\n", "\r\n"),
                  {"--map", "length=L mm", "--map", "diameter=d", "--unit", "L mm=mm"}),
            plain);
  EXPECT_EQ(turns("\xEF\xBB\xBF\"length [mm]\",\"diameter [mm]\",remark\n" +
                      replaced(body, "\n", ",\"by hand, twice\"\n"),
                  {}),
            plain);
}

TEST(ForeignFile, NamesThatDoNotExistAreTold) {
  const Workspace w;
  write_text(w / "data.csv", mesh);
  EXPECT_THAT(w.sinew({"identify", "geometry", "data.csv", "--map", "lenght=length"}).err,
              AllOf(HasSubstr("--map: found \"lenght\""), HasSubstr("try \"length\"")));
  EXPECT_THAT(w.sinew({"identify", "geometry", "data.csv", "--unit", "diamter=in"}).err,
              AllOf(HasSubstr("--unit: found \"diamter\""), HasSubstr("try \"diameter\"")));
  EXPECT_THAT(w.sinew({"identify", "geometry", "data.csv", "--unit", "diameter"}).err,
              HasSubstr("expected name=value"));
  EXPECT_THAT(w.sinew({"identify", "geometry", "absent.csv"}).err, HasSubstr("absent.csv"));
}

// A file's name may be any bytes: what is written and printed is UTF-8 all the same, and can be
// read.
TEST(Identify, OfAFileWhoseNameIsNoUtf8) {
  const Workspace w;
  const std::string name = "m\xFFsh.csv";
  write_text(w / name, mesh);
  const Result result = w.sinew({"identify", "geometry", name, "--json", "-o", "out.toml"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(Json::accept(result.out));
  EXPECT_EQ(w.sinew({"check", "out.toml"}).code, 0);
  const Result check = w.sinew({"check", "--json", name});
  EXPECT_TRUE(Json::accept(check.out)) << check.err;
}

}  // namespace
}  // namespace sinew::test::identify_test
