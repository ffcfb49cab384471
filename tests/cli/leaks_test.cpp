// Whatever file a command is given, what it says is about that file: no name of a type, a library
// or a function of ours, and no end but by an exit code.
#include <gmock/gmock.h>

#include <sstream>

#include "tests/cli/program.h"

namespace sinew::test::leaks_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Only somebody who wrote the program could understand these words.
constexpr const char* internal[] = {
    "std::",        "basic_string",   "vector",      "invalid_argument",
    "out_of_range", "bad_alloc",      "json.exc",    "[json",
    "nlohmann",     "parse_error",    "SQLITE",      "SQL logic",
    "sqlite3_",     "boost",          "pagmo",       "terminate",
    "what()",       "filesystem",     "toml::",      "CLI::",
    "stod",         "stoi",           "nullptr",     "_M_",
    "unique_ptr",   "not expected: ", "is required", "not in {",
    "TEXT",         "errno"};

// Each line of a command is right but for FILE.
constexpr const char* lines[] = {
    "run FILE -o out --quiet",
    "analyze FILE",
    "report FILE -o out.html",
    "compare FILE FILE",
    "compare FILE FILE -o out.html",
    "export FILE --csv",
    "import FILE -o out",
    "replay FILE",
    "sweep FILE -o out.csv",
    "sweep FILE --vary seed=1,2 -o out.csv",
    "tune FILE -o out.db",
    "merge FILE -o out.db",
    "sensitivity FILE --set seed=1",
    "show FILE",
    "check FILE",
    "migrate FILE",
    "actuator FILE --length 3_in --pressure 60_psi_gauge",
    "valve FILE --upstream 60_psi_gauge",
    "kinematics FILE --angles 0_rad",
    "identify static FILE",
    "identify check FILE",
    "identify creep FILE",
    "identify dynamic FILE",
    "identify joint FILE",
    "identify valve FILE --kind chart",
    "identify sensor FILE",
    "identify geometry FILE",
    "figures FILE -o out",
    "firmware FILE -o out",
    "fmu export FILE -o out.fmu",
    "bring-up FILE --yes",
    "doctor FILE",
    "new experiment x --of FILE",
    "new plan x --of FILE",
};

// "60_psi_gauge" is one word.
Words words_of(const std::string& line, const std::string& file) {
  std::istringstream in(line);
  Words out;
  for (std::string word; in >> word;) {
    if (word == "FILE")
      word = file;
    else if (word.find("psi") != word.npos || word.ends_with("_in") || word.ends_with("_rad"))
      for (char& c : word) c = c == '_' ? ' ' : c;
    out.push_back(word);
  }
  return out;
}

TEST(Leaks, NothingInternalIsSaidOfAFileThatIsWrong) {
  const Workspace w;
  write_text(w / "empty.toml", "");
  write_text(w / "binary.toml", std::string("\x89MCAP0\r\n\0\xff\xfe\0", 12));
  write_text(w / "other.toml",
             "format = \"sinew.robot/1\"\nname = 3\n[link.x]\nlength = \"1 s\"\n");
  write_text(w / "cut.mcap", std::string("\x89MCAP0\r\n\x05", 9));
  write_text(w / "words.csv", "time [s],load [N]\n0,zero\n1,2\n");
  write_text(w / "text.db", "SQLite format 3, it is not\n");
  std::filesystem::create_directory(w / "folder");
  std::filesystem::create_directory(w / "run");
  write_text(w / "run/summary.json", "{\"format\": \"sinew.summary/1\", ");
  write_text(w / "run/log.mcap", "no log");
  write_text(w / "run/resolved.toml", "format = \"sinew.experiment/1\"\nrobot = 1\n");
  const char* files[] = {"none.toml", "folder",    "empty.toml", "binary.toml", "other.toml",
                         "cut.mcap",  "words.csv", "text.db",    "run"};
  for (const char* line : lines)
    for (const char* file : files) {
      const Result r = w.sinew(words_of(line, file));
      const std::string said = r.out + r.err;
      const std::string asked = std::string(line) + ": " + file;
      EXPECT_GE(r.code, 0) << asked << " was ended by a signal: " << said;
      EXPECT_LE(r.code, 2) << asked;
      EXPECT_TRUE(r.code == 0 || !said.empty()) << asked;
      for (const char* word : internal) EXPECT_THAT(said, Not(HasSubstr(word))) << asked;
    }
}

}  // namespace
}  // namespace sinew::test::leaks_test
