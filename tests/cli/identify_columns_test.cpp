// `sinew identify METHOD --columns` and `--template`: asked before there are data, of every method.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"

namespace sinew::test::identify_columns_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::ordered_json;

// The commands below `sinew identify` whose help has DATA in it: those that read a table.
std::vector<std::string> methods(const Workspace& w) {
  std::vector<std::string> out;
  std::istringstream help(w.sinew({"identify", "--help"}).out);
  bool commands = false;
  for (std::string line; std::getline(help, line);) {
    commands |= line.starts_with("commands") || line.starts_with("Commands");
    std::istringstream words(line);
    std::string name;
    if (!commands || !line.starts_with("  ") || !(words >> name)) continue;
    if (w.sinew({"identify", name, "--help"}).out.find("DATA") != std::string::npos)
      out.push_back(name);
  }
  return out;
}

TEST(IdentifyColumns, EveryMethodThatReadsATableTellsItsColumns) {
  const Workspace w;
  const std::vector<std::string> all = methods(w);
  ASSERT_GE(all.size(), 8u);
  for (const std::string& method : all) {
    const Result table = w.sinew({"identify", method, "--columns"});
    EXPECT_EQ(table.code, 0) << method << table.err;
    EXPECT_THAT(table.out, AllOf(HasSubstr("meaning"), HasSubstr("a row: "))) << method;
    const Result json = w.sinew({"identify", method, "--columns", "--json"});
    ASSERT_EQ(json.code, 0) << method << json.err;
    EXPECT_EQ(Json::parse(json.out)["method"], method);
  }
}

// What a method requires beside its table is not asked for; with --where the first word behind
// --columns is another option.
TEST(IdentifyColumns, NeedNothingElseOfTheLine) {
  const Workspace w;
  const Result result = w.sinew({"identify", "dynamic", "--columns", "--mass", "6 lb"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("of the trapped air"));
  const Result law = w.sinew({"identify", "static", "--columns"});
  for (const char* name : {"rest_length", "branch", "time", "fill or vent", "required, or load"})
    EXPECT_THAT(law.out, HasSubstr(name));
}

// With a value it is the header of a file, as before.
TEST(IdentifyColumns, AHeaderBehindThemIsAHeader) {
  const Workspace w;
  write_text(w / "bare.csv", "65,11.7\n75,10.5\n85,9.0\n95,6.8\n");
  const Result result =
      w.sinew({"identify", "geometry", "--columns", "length [mm],diameter [mm]", "bare.csv"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("thread_length"));
}

TEST(IdentifyColumns, ATemplateIsReadByItsMethod) {
  const Workspace w;
  const Result written = w.sinew({"identify", "geometry", "--template", "mesh.csv"});
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_THAT(written.err, HasSubstr("mesh.csv: written"));
  EXPECT_EQ(w.sinew({"identify", "geometry", "mesh.csv"}).code, 0);
  const Result check = w.sinew({"identify", "check", "--template=rig.csv"});
  ASSERT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(w.sinew({"identify", "check", "rig.csv"}).err, IsEmpty());
}

TEST(IdentifyColumns, ATemplateReplacesNothingThatIsNoTemplate) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"identify", "valve", "--kind", "chart", "--template", "v.csv"}).code, 0);
  EXPECT_THAT(read_text(w / "v.csv"), HasSubstr("upstream [bar abs]"));
  const Result again = w.sinew({"identify", "valve", "--template", "v.csv"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  EXPECT_EQ(w.sinew({"identify", "valve", "--template", "v.csv", "--force"}).code, 0);
  EXPECT_THAT(read_text(w / "v.csv"), HasSubstr("added_volume [L]"));
  write_text(w / "mine.csv", "length [mm],diameter [mm]\n65,11.7\n");
  const Result mine = w.sinew({"identify", "geometry", "--template", "mine.csv", "--force"});
  EXPECT_EQ(mine.code, 1);
  EXPECT_THAT(mine.err, HasSubstr("no template"));
  EXPECT_THAT(read_text(w / "mine.csv"), HasSubstr("65,11.7"));
}

TEST(IdentifyColumns, WrongMethodsAndKindsAreWrongUsage) {
  const Workspace w;
  const Result method = w.sinew({"identify", "columns", "statik"});
  EXPECT_EQ(method.code, 2);
  EXPECT_THAT(method.err, HasSubstr("static"));
  const Result kind = w.sinew({"identify", "valve", "--kind", "chrat", "--template", "v.csv"});
  EXPECT_EQ(kind.code, 2);
  EXPECT_THAT(kind.err, AllOf(HasSubstr("--kind: found \"chrat\""), HasSubstr("chart")));
}

}  // namespace
}  // namespace sinew::test::identify_columns_test
