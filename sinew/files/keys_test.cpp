// The listed keys agree with what the reader does.
#include "sinew/files/keys.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "sinew/config/compose.h"
#include "sinew/config/reader.h"
#include "sinew/files/key_tables.h"
#include "sinew/files/key_text.h"
#include "sinew/files/keys_test.h"
#include "sinew/files/values.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"
#include "sinew/tune/optimizer/tuning.h"
#include "sinew/units/quantity.h"

namespace sinew::files::keys_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// --- a file with one table of each kind ---

bool is_container(const Key& key) {
  return key.type == KeyType::table || key.type == KeyType::tables || key.type == KeyType::list;
}

// Returns the table of the key, created if it is missing, and the key's own name.
std::pair<config::Node*, std::string> place_of(config::Node& root, std::string path) {
  config::Node* table = &root;
  for (std::size_t dot; (dot = path.find('.')) != path.npos; path = path.substr(dot + 1)) {
    std::string part = path.substr(0, dot);
    const bool list = part.ends_with("[]");
    if (list) part.resize(part.size() - 2);
    config::Node* there = table->find(part);
    if (!there) there = &table->put(config::make_table(part));
    if (list) {
      there->kind = config::Node::Kind::array;
      if (there->children.empty()) there->children.push_back(config::make_table(""));
      there = &there->children.front();
    }
    table = there;
  }
  return {table, path};
}

config::Node with_all_tables(const std::vector<Key>& keys) {
  config::Node root;
  for (const Key& key : keys) place_of(root, key.path);
  return root;
}

const std::vector<std::string> read_kinds = {"robot",      "actuator", "valves", "wiring",
                                             "experiment", "rig",      "plan",   "tuning"};

// Keys that config/compose.h reads before the tables.
bool is_composed(const Key& key) {
  return key.path == "name" || key.path.starts_with("files") || key.path == "sinew_version" ||
         key.path.find(".catalogue") != key.path.npos ||
         (key.path == "robot" && key.kind == "experiment");
}

std::vector<const Key*> rows_of(const std::vector<Key>& keys, std::string_view path) {
  std::vector<const Key*> out;
  for (const Key& key : keys)
    if (is_key(key, path)) out.push_back(&key);
  return out;
}

TEST(Keys, DefaultsAndNeedsAreThoseOfAnEmptyTable) {
  for (const std::string& kind : read_kinds) {
    const std::vector<Key> keys = keys_of(kind);
    const config::Node root = with_all_tables(keys);
    config::Reader reader(root);
    visit_tables(reader, kind);
    std::set<std::string> met;
    for (const config::Origin& origin : reader.origins()) {
      bool found = false;
      for (const Key* key : rows_of(keys, origin.path)) {
        met.insert(key->path);
        // Another text gives the unit, or another file the value.
        found = found || key->path == "robot_name" || key->default_text == "the robot's" ||
                key->when.starts_with("measure = ") || key->when.starts_with("key = ");
        found = found || (!key->required && key->default_text == origin.text);
      }
      EXPECT_TRUE(found) << kind << " " << origin.path << " " << origin.text;
    }
    for (const config::Problem& problem : reader.problems()) {
      if (problem.found != "nothing") continue;
      bool found = false;
      for (const Key* key : rows_of(keys, problem.key)) {
        met.insert(key->path);
        found = found || key->required || key->path == "robot_name";
      }
      EXPECT_TRUE(found) << kind << " " << problem.key;
    }
    for (const Key& key : keys) {
      const bool read = !is_container(key) && !is_composed(key) && !key.path.ends_with("<name>");
      if (read && key.when.empty()) {
        EXPECT_TRUE(met.contains(key.path)) << kind << " " << key.path;
      }
    }
  }
}

// Sets every quantity beyond a limit at once; returns the reader's expectation for each.
std::map<std::string, std::string> expected_beyond(const std::string& kind, auto beyond) {
  const std::vector<Key> keys = keys_of(kind);
  config::Node root = with_all_tables(keys);
  for (const Key& key : keys) {
    if (key.type != KeyType::number || !key.when.empty()) continue;
    const std::optional<double> value = beyond(key);
    if (!value) continue;
    const auto [table, name] = place_of(root, key.path);
    table->put(config::make_text(name, units::format_quantity(*value, key.unit)));
  }
  config::Reader reader(root);
  visit_tables(reader, kind);
  std::map<std::string, std::string> out;
  for (const config::Problem& problem : reader.problems())
    for (const Key* key : rows_of(keys, problem.key))
      if (problem.found != "nothing") out.emplace(key->path, problem.expected);
  return out;
}

TEST(Keys, RangesAreThoseThatTheReaderStates) {
  std::size_t checked = 0;
  for (const std::string& kind : read_kinds) {
    const auto low = expected_beyond(kind, [](const Key& key) -> std::optional<double> {
      if (!std::isfinite(key.min)) return std::nullopt;
      return key.min - 1;
    });
    const auto small = expected_beyond(kind, [](const Key& key) -> std::optional<double> {
      if (key.least == 0) return std::nullopt;
      return key.least / 2;
    });
    const auto high = expected_beyond(kind, [](const Key& key) -> std::optional<double> {
      return std::isfinite(key.max) ? key.max + std::abs(key.max) + 1 : 2 * key.most;
    });
    for (Key key : keys_of(kind)) {
      if (key.type != KeyType::number || !key.when.empty()) continue;
      if (key.least > 0) {
        EXPECT_THAT(range_of(key), HasSubstr("0, or at least")) << key.path;
        ASSERT_TRUE(small.contains(key.path)) << kind << " " << key.path;
        const std::string least = units::format_quantity(key.least, key.unit);
        EXPECT_THAT(small.at(key.path), StartsWith("0, or at least " + least)) << key.path;
        EXPECT_THAT(range_of(key), HasSubstr(least)) << key.path;
      }
      key.least = 0;
      const std::string range = range_of(key);
      if (std::isfinite(key.min)) {
        ASSERT_TRUE(low.contains(key.path)) << kind << " " << key.path;
        EXPECT_THAT(low.at(key.path), StartsWith(range)) << key.path;
      }
      ASSERT_TRUE(high.contains(key.path)) << kind << " " << key.path;
      if (std::isfinite(key.max)) {
        EXPECT_THAT(high.at(key.path), StartsWith(range)) << key.path;
      } else {
        const std::string most = units::format_quantity(key.most, key.unit);
        EXPECT_THAT(high.at(key.path), StartsWith("at most " + most)) << key.path;
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 100u);
}

// --- shipped files ---

std::vector<Key> keys_within(const std::string& kind) {
  std::vector<Key> out;
  for (const std::string& one : kinds_within(kind))
    for (Key& key : keys_of(one)) out.push_back(std::move(key));
  return out;
}

config::Origins origins_of(const std::string& file, const std::string& kind) {
  if (kind == "tuning") return tune::load_tuning_file(file).origins;
  return values(file).origins;
}

// Returns the rows of each requested path for a kind of file, as most files share theirs.
class Known {
 public:
  explicit Known(const std::string& kind) : keys_(keys_within(kind)) {}

  const std::vector<const Key*>& rows(const std::string& path) {
    const auto [at, is_new] = rows_.try_emplace(path);
    if (is_new) at->second = rows_of(keys_, path);
    return at->second;
  }

 private:
  std::vector<Key> keys_;
  std::map<std::string, std::vector<const Key*>> rows_;
};

TEST(Keys, KnowEveryValueOfEveryShippedFile) {
  std::size_t seen = 0;
  std::map<std::string, Known> known;
  for (const auto& [file, kind] : shipped_files()) {
    if (kind == "plan") continue;  // its keys are covered by the schema's test
    Known& keys = known.try_emplace(kind, kind).first->second;
    for (const config::Origin& origin : origins_of(file, kind)) {
      if (origin.path == "format" || origin.path == "sinew_version") continue;
      bool unit = false, same = !origin.is_default;
      for (const Key* key : keys.rows(origin.path)) {
        unit = unit || key->unit == origin.unit;
        same = same || key->default_text == origin.text || key->default_text == "the robot's";
      }
      EXPECT_TRUE(unit) << file << " " << origin.path << " [" << origin.unit << "]";
      EXPECT_TRUE(same) << file << " " << origin.path << " = " << origin.text;
      ++seen;
    }
  }
  EXPECT_GT(seen, 5000u);
}

// --- search ---

std::vector<std::string> paths(const std::vector<Key>& keys) {
  std::vector<std::string> out;
  for (const Key& key : keys) out.push_back(key.path);
  return out;
}

TEST(Keys, ARealNameStandsInThePlaceOfName) {
  EXPECT_THAT(paths(find_keys({"joint.hip.damping"})),
              ::testing::ElementsAre("joint.<name>.damping"));
  EXPECT_THAT(paths(find_keys({"fault[0].at"}, "experiment")),
              ::testing::ElementsAre("fault[].at"));
  EXPECT_THAT(paths(find_keys({"fault.at"}, "rig")), ::testing::ElementsAre("fault[].at"));
  EXPECT_THAT(paths(find_keys({"actuator.bpa.effectiveness.polynomial[1]"})),
              ::testing::ElementsAre("actuator.<name>.effectiveness.polynomial"));
  EXPECT_THAT(paths(find_keys({"joint.hip.stop"})),
              ::testing::ElementsAre("joint.<name>.stop", "joint.<name>.stop.angles",
                                     "joint.<name>.stop.stiffness", "joint.<name>.stop.damping"));
}

TEST(Keys, WordsMustAllBeThereInEitherCase) {
  const auto both = find_keys({"DAMPING", "viscous"});
  ASSERT_FALSE(both.empty());
  for (const Key& key : both) EXPECT_THAT(key.path + key.doc, HasSubstr("damping"));
  EXPECT_LT(both.size(), find_keys({"damping"}).size());
  const auto choice = find_keys({"bounded observer"}, "robot");
  EXPECT_THAT(paths(choice), ::testing::Contains("joint.<name>.velocity.estimator"));
}

TEST(Keys, AKeyThatDependsOnAWordNamesIt) {
  const auto scale = find_keys({"sensor.hip_angle.real.scale"}, "robot");
  ASSERT_EQ(scale.size(), 5u);
  for (const Key& key : scale) {
    EXPECT_THAT(key.when, StartsWith("kind = \"")) << key.unit;
    EXPECT_EQ(key.unit == "V/N", key.when == "kind = \"tension\"") << key.unit;
  }
  const auto arm = find_keys({"joint.hip.moment_arm"});
  ASSERT_EQ(arm.size(), 1u);
  EXPECT_EQ(arm[0].when, "kind = \"driven\"");
  const auto least = find_keys({"joint.hip.velocity.acceleration"});
  ASSERT_EQ(least.size(), 2u);
  EXPECT_FALSE(least[0].required);
  EXPECT_TRUE(least[1].required);
  EXPECT_EQ(least[1].when, "kind = \"driven\" and estimator = \"bounded observer\" or \"kalman\"");
}

std::string text_of_page(const std::string& path) {
  std::ifstream in(test::source_dir() + "/" + path);
  std::string out{std::istreambuf_iterator<char>(in), {}};
  std::ranges::replace(out, '\n', ' ');
  return out;
}

// Documentation states the limits in words; these are the sizes in the code.
TEST(Keys, LimitsOfTheDocsAreThoseOfTheCode) {
  using namespace robot;
  const std::map<std::string, std::vector<std::string>> stated{
      {"docs/how-to/own-robot.md",
       {fmt::format("with up to {} joints", max_joints),
        fmt::format("| joints and links, driven or passive | {} |", max_joints),
        fmt::format("(actuators in parallel are one) | {}: {} valves |", max_muscles,
                    2 * max_muscles),
        fmt::format("| discs of all feet | {} |", max_discs),
        fmt::format("| legs; joints and muscles of one | {}; {} and {} |", max_legs, max_leg_joints,
                    max_leg_muscles),
        fmt::format("| boards; joints, channels and bits of one | {}; {}, {} and {} |", max_boards,
                    board_joints, board_channels, board_bits),
        fmt::format("| sensors, one a channel | {}, {} of them on a board |", max_sensors,
                    board_channels),
        fmt::format("more than {} joints or {} sensors: [several boards]", board_joints,
                    board_channels)}},
      {"README.md", {fmt::format("trees of up to {} links", max_joints)}},
      {"CHANGELOG.md",
       {fmt::format("tree of up to {} links", max_joints),
        fmt::format("up to {} muscles", max_muscles)}},
      {"docs/architecture.md",
       {fmt::format("up to {} joints, {} channels and {} bits of outputs", board_joints,
                    board_channels, board_bits)}}};
  for (const auto& [page, texts] : stated)
    for (const std::string& text : texts)
      EXPECT_THAT(text_of_page(page), testing::HasSubstr(text)) << page;
}

// A number in SI is given its unit also for a table that a file lacks.
TEST(Keys, HaveTheUnitOfTheirNumbers) {
  EXPECT_EQ(unit_of("plant_steps.body"), "s");
  EXPECT_EQ(unit_of("control.gains.hip.angle"), "1/count");
  EXPECT_EQ(unit_of("actuator.bpa.long_end.length"), "m");
  EXPECT_EQ(unit_of("long_end.length"), "m");  // in an actuator's file
  EXPECT_EQ(unit_of("seed"), "");
  EXPECT_EQ(unit_of("robot"), "");
  EXPECT_EQ(unit_of("nothing.of.the.kind"), "");
}

TEST(Keys, TheNearestIsSuggested) {
  for (const auto& [word, near] :
       {std::pair{"dampnig", "damping"},
        {"joint.hip.dampnig", "joint.hip.damping"},
        {"muscle.hip_flexor.mount_lenght", "muscle.hip_flexor.mount_length"},
        {"efectiveness", "effectiveness"}}) {
    try {
      find_keys({word});
      ADD_FAILURE() << word;
    } catch (const config::Error& e) {
      EXPECT_EQ(e.problems().front().try_this, near);
    }
  }
}

}  // namespace
}  // namespace sinew::files::keys_test
