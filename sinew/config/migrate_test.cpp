// Migration of older files. Of the product's formats only that of experiments has a second number,
// so the tests have a history of their own, in which robots have number 3.
#include "sinew/config/migrate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <set>

#include "sinew/config/reader.h"
#include "sinew/config/text_file.h"
#include "tests/places.h"

namespace sinew::config::migrate_test {
namespace {

namespace fs = std::filesystem;

const Changes& history() {
  static const Changes all{
      .kinds = {{"robot", 3}, {"actuator", 2}, {"valves", 1}},
      .keys = {
          {.kind = "robot", .format = 2, .from = "muscle.*.delay", .to = "opening_delay"},
          {.kind = "robot", .format = 2, .from = "cam", .to = "pulley"},
          {.kind = "robot", .format = 3, .from = "muscle.*.opening_delay", .to = "opening.delay"},
          {.kind = "robot", .format = 3, .from = "reported.worth", .to = "class"},
          {.kind = "robot", .format = 3, .from = "gravity", .why = "air.gravity of the experiment"},
          {.kind = "actuator", .format = 2, .from = "braid.angle", .to = "mesh_angle"}}};
  return all;
}

std::string message(const std::string& text, const Changes& changes = history()) {
  try {
    migrated(text, "x.toml", changes);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

const std::string old_robot =
    "# a robot\n"
    "format = \"sinew.robot/1\"   # the first\n"
    "\n"
    "[muscle.flexor]             # the one in front\n"
    "delay   = \"4 ms\"            # of its valve\n"
    "length  = { value = \"3 in\", source = \"delay = '5 ms' is no key here\" }\n"
    "\n"
    "[muscle]\n"
    "\"ext\".\"delay\" = \"5 ms\"\n"
    "middle = { length = \"2 in\", delay = \"6 ms\" }\n"
    "[cam.disc]\n"
    "radius=\"1 in\"\n"
    "[[reported]]\n"
    "worth = \"\"\"\n"
    "delay = 3\n"
    "\"\"\"\n"
    "[[reported]]\n"
    "worth='put in'\t# [cam]\n";

const std::string new_robot =
    "# a robot\n"
    "format = \"sinew.robot/3\"   # the first\n"
    "\n"
    "[muscle.flexor]             # the one in front\n"
    "opening.delay   = \"4 ms\"            # of its valve\n"
    "length  = { value = \"3 in\", source = \"delay = '5 ms' is no key here\" }\n"
    "\n"
    "[muscle]\n"
    "\"ext\".opening.delay = \"5 ms\"\n"
    "middle = { length = \"2 in\", opening.delay = \"6 ms\" }\n"
    "[pulley.disc]\n"
    "radius=\"1 in\"\n"
    "[[reported]]\n"
    "class = \"\"\"\n"
    "delay = 3\n"
    "\"\"\"\n"
    "[[reported]]\n"
    "class='put in'\t# [cam]\n";

TEST(Migrate, RenamesKeysAndKeepsEveryOtherByte) {
  const Migrated done = migrated(old_robot, "x.toml", history());
  EXPECT_EQ(done.text, new_robot);
  EXPECT_EQ(done.kind, "robot");
  EXPECT_EQ(done.from, 1);
  EXPECT_EQ(done.to, 3);
  ASSERT_EQ(done.edits.size(), 10U);
  EXPECT_EQ(done.edits[0].line, 5);
  EXPECT_EQ(done.edits[0].was, "muscle.flexor.delay");
  EXPECT_EQ(done.edits[0].is, "muscle.flexor.opening_delay");
  EXPECT_EQ(done.edits.back().is, "sinew.robot/3");
}

TEST(Migrate, LeavesAloneWhatIsOfToday) {
  const Migrated done = migrated(new_robot, "x.toml", history());
  EXPECT_TRUE(done.edits.empty());
  EXPECT_EQ(done.text, new_robot);
}

TEST(Migrate, BeginsWhereTheFileIs) {
  const Migrated done =
      migrated("format = \"sinew.robot/2\"\n[muscle.a]\nopening_delay = 1\ndelay = 2\n", "x.toml",
               history());
  EXPECT_EQ(done.text, "format = \"sinew.robot/3\"\n[muscle.a]\nopening.delay = 1\ndelay = 2\n");
}

std::string with_dos_ends(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

TEST(Migrate, EndsOfLinesAndAMarkAtTheBeginningStay) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(migrated(mark + with_dos_ends(old_robot), "x.toml", history()).text,
            mark + with_dos_ends(new_robot));
  const std::string bare = "# one\r\n# two\r\n[valve.a]\r\nkind = \"2-way\"";
  EXPECT_EQ(
      migrated(mark + bare, "x.toml", history()).text,
      mark + "# one\r\n# two\r\nformat = \"sinew.valves/1\"\r\n[valve.a]\r\nkind = \"2-way\"");
}

// An older file is read like the migrated one.
TEST(Migrate, AnOlderFileIsReadAsIfItWere) {
  const fs::path file =
      fs::temp_directory_path() / ("sinew-migrate-" + std::to_string(getpid()) + ".toml");
  std::ofstream(file, std::ios::binary) << old_robot;
  const Node root = parse_file(file.string(), history());
  fs::remove(file);
  EXPECT_EQ(root.find("format")->text, "sinew.robot/3");
  const Node& flexor = *root.find("muscle")->find("flexor");
  EXPECT_EQ(flexor.find("opening")->find("delay")->text, "4 ms");
  EXPECT_EQ(flexor.find("opening")->where.line, 5);
}

// An old key in a file of the current format is refused, and its replacement is suggested.
TEST(Migrate, AReaderNamesTheKeyInPlaceOfOneThatIsGone) {
  const Node root = parse_text(
      "format = \"sinew.robot/3\"\ngravity = 3\n[muscle.a]\ndelay = 1\n[actuator.bpa]\nbraid.angle "
      "= 2\n",
      "x.toml");
  ReaderOptions options;
  options.changes = &history();
  Reader reader(root, options);
  std::string format, what;
  reader.text({.name = "format"}, format);
  struct Named {
    std::string name;
  };
  std::vector<Named> muscles;
  reader.each({.name = "muscle"}, muscles, [](Reader&, Named&) {});
  try {
    reader.finish();
  } catch (const Error& e) {
    what = e.what();
  }
  EXPECT_NE(what.find("muscle.a.delay: found a key that is gone"), what.npos) << what;
  EXPECT_NE(what.find("try muscle.a.opening_delay, which replaces it since sinew.robot/2"),
            what.npos)
      << what;
  EXPECT_NE(what.find("air.gravity of the experiment; it is gone since sinew.robot/3"), what.npos)
      << what;
  EXPECT_TRUE(removed_key("actuator.bpa.braid.angle", history()));
  EXPECT_TRUE(removed_key("reported[4].worth", history()));
  EXPECT_FALSE(removed_key("reported[4].value", history()));
}

TEST(Migrate, ReportsWhatItCannotDo) {
  const std::map<std::string, std::string> cases = {
      {"format = \"sinew.robot/4\"\n",
       "x.toml:1:1: format: found \"sinew.robot/4\"; expected \"sinew.robot/3\" or older"},
      {"format = \"sinew.robot/0\"\n", "found \"sinew.robot/0\"; expected \"sinew.<kind>/1\""},
      {"format = \"sinew.robot\"\n", "found \"sinew.robot\""},
      {"format = \"sinew.robot/1.5\"\n", "found \"sinew.robot/1.5\""},
      {"format = \"sinew.robt/1\"\n", "try format = \"sinew.robot/3\""},
      {"format = \"mujoco/1\"\n", "found \"mujoco/1\""},
      {"format = 1\n", "format: found 1; expected"},
      {"[format]\nrobot = 1\n", "format: found a table; expected"},
      {"x = 1\n", "x.toml:1:1: format: missing; expected \"sinew.<kind>/1\""},
      {"", "format: missing"},
      {"format = \"sinew.robot/1\"\ngravity = 3\n",
       "x.toml:2:1: gravity: found a key that is gone; expected air.gravity of the experiment"},
      {"format = \"sinew.robot/1\"\n[muscle.a]\ndelay = 1\nopening_delay = 2\n",
       "x.toml:3:1: muscle.a.delay: found a key that is gone; expected muscle.a.opening_delay "
       "alone, which the file has too"},
      {"format = \"sinew.robot/1\"\nx = 1\nx = 2\n", "x.toml:3:"},
      {"format = \"sinew.robot/1\"\nlength = 3 in\n", "x.toml:2:"},
      {std::string("format = \"sinew.robot/1\"\0\n", 26), "a syntax error"},
      {"\x89PNG\r\n\x1a\n", "a syntax error"},
      {"format = \"sinew.robot/1\"\n[[a]\n", "a syntax error"},
      {"format = \"sinew.robot/99999999999999999999\"\n",
       "found \"sinew.robot/99999999999999999999\""},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(message(text).find(expected), std::string::npos)
        << text << "\nsaid: " << message(text);
}

// --- all shipped files ---

std::vector<fs::path> files_in(std::initializer_list<const char*> folders) {
  std::vector<fs::path> files;
  for (const char* folder : folders)
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(sinew::test::source_dir()) / folder))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

std::vector<fs::path> shipped() { return files_in({"robots", "experiments", "studies"}); }

void collect(const Node& node, const std::string& path, std::set<std::string>& keys) {
  for (const Node& child : node.children) {
    const bool dot = !path.empty() && !child.key.empty();
    const std::string key = path + (dot ? "." : "") + child.key;
    keys.insert(key);
    collect(child, key, keys);
  }
}

TEST(KeyPlaces, AreThoseOfTheParser) {
  for (const fs::path& file : files_in({"robots", "experiments", "studies", "tests/old"})) {
    const std::string text = read_text_file(file.string(), "TOML");
    std::set<std::string> parsed, found;
    collect(parse_text(text, file.string()), "", parsed);
    std::size_t before = 0;
    for (const KeyPlace& place : key_places(text)) {
      found.insert(dotted(place.path));
      EXPECT_GE(place.begin, before);
      before = place.end;
      EXPECT_EQ(text.substr(place.begin, place.end - place.begin).find_first_of(" =[]{}\n"),
                std::string::npos);
    }
    EXPECT_EQ(found, parsed) << file;
  }
}

TEST(Migrate, EveryShippedFileIsOfToday) {
  ASSERT_GT(shipped().size(), 90U);
  for (const fs::path& file : shipped()) {
    const std::string text = read_text_file(file.string(), "TOML");
    const Migrated done = migrated(text, file.string());
    EXPECT_TRUE(done.edits.empty()) << file;
    EXPECT_EQ(done.text, text) << file;
  }
}

// A file of an older format is read as its migrated form, which needs no further migration.
TEST(Migrate, FilesOfOlderFormatsAreReadAsMigrated) {
  ASSERT_GT(files_in({"tests/old"}).size(), 3U);
  for (const fs::path& file : files_in({"tests/old"})) {
    const Migrated done = migrated(read_text_file(file.string(), "TOML"), file.string());
    EXPECT_TRUE(migrated(done.text, file.string()).edits.empty()) << file;
    std::set<std::string> expected, found;
    collect(parse_text(done.text, ""), "", expected);
    collect(parse_file(file.string()), "", found);
    EXPECT_EQ(found, expected) << file;
  }
}

// Keys or the base determine the kind of a file without a format.
TEST(Migrate, FindsTheFormatOfEveryShippedFile) {
  for (const fs::path& file : shipped()) {
    const std::string text = read_text_file(file.string(), "TOML");
    const std::size_t begin = text.find("format "), end = text.find('\n', begin) + 1;
    const std::string line = text.substr(begin, end - begin);
    const Migrated done = migrated(text.substr(0, begin) + text.substr(end), file.string());
    EXPECT_NE(line.find(newest_format(done.kind)), line.npos) << file << " is no " << done.kind;
    EXPECT_EQ(done.from, 0);
    std::set<std::string> expected, found;
    collect(parse_text(text, ""), "", expected);
    collect(parse_text(done.text, ""), "", found);
    EXPECT_EQ(found, expected) << file;
  }
}

}  // namespace
}  // namespace sinew::config::migrate_test
