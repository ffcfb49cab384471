// Editors' schema accepts the shipped files and rejects files of other formats.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "sinew/config/diagnostics.h"
#include "sinew/files/key_text.h"
#include "sinew/files/keys_test.h"

namespace sinew::files::key_schema_test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

Json json_of(const config::Node& node) {
  using Kind = config::Node::Kind;
  switch (node.kind) {
    case Kind::text:
      return node.text;
    case Kind::integer:
      return node.integer;
    case Kind::real:
      return node.real;
    case Kind::flag:
      return node.flag;
    case Kind::array: {
      Json out = Json::array();
      for (const config::Node& child : node.children) out.push_back(json_of(child));
      return out;
    }
    case Kind::table:
      break;
  }
  Json out = Json::object();
  for (const config::Node& child : node.children) out[child.key] = json_of(child);
  return out;
}

// Implements the part of draft 2020-12 that the schemas use. Returns place and fault, or "".
class Validator {
 public:
  explicit Validator(const Json& root) : root_(root) {}

  std::string wrong(const Json& value) const { return wrong(value, root_, ""); }

 private:
  static bool has_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
  }

  // Each pattern is compiled once, as compiling takes longer than all matches.
  static bool matches(const std::string& text, const std::string& pattern) {
    static std::map<std::string, std::regex> made;
    return std::regex_search(text, made.try_emplace(pattern, pattern).first->second);
  }

  std::string wrong(const Json& value, const Json& schema, const std::string& at) const {
    if (schema.is_boolean()) return schema.get<bool>() ? "" : at + ": an unknown key";
    if (schema.contains("$ref")) {
      const std::string name = schema["$ref"].get<std::string>().substr(8);  // #/$defs/
      return wrong(value, root_["$defs"].at(name), at);
    }
    if (schema.contains("anyOf")) {
      std::string all;
      for (const Json& one : schema["anyOf"]) {
        const std::string found = wrong(value, one, at);
        if (found.empty()) return "";
        all += found + "\n";
      }
      return all;
    }
    if (schema.contains("const") && value != schema["const"]) return at + ": another constant";
    if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end())
      return at + ": no such word";
    if (schema.contains("type") && !has_type(value, schema["type"])) return at + ": another type";
    if (schema.contains("pattern") && !matches(value.get<std::string>(), schema["pattern"]))
      return at + ": no quantity";
    if (schema.contains("minimum") && value < schema["minimum"]) return at + ": too small";
    if (schema.contains("maximum") && value > schema["maximum"]) return at + ": too large";
    return inside(value, schema, at);
  }

  std::string inside(const Json& value, const Json& schema, const std::string& at) const {
    std::string all;
    if (value.is_array() && schema.contains("items"))
      for (const Json& item : value) all += wrong(item, schema["items"], at + "[]");
    if (!value.is_object()) return all;
    if (schema.contains("required"))
      for (const Json& key : schema["required"])
        if (!value.contains(key.get<std::string>())) all += at + ": no " + key.get<std::string>();
    for (const auto& [key, child] : value.items()) {
      const Json& known = schema["properties"];
      const Json& one = known.contains(key) ? known[key] : schema["additionalProperties"];
      all += wrong(child, one, at + "." + key);
    }
    return all;
  }

  const Json root_;
};

TEST(KeySchema, TakesEveryShippedFile) {
  std::map<std::string, Validator> validators;
  for (const auto& [file, kind] : shipped_files()) {
    if (!validators.contains(kind)) validators.emplace(kind, Json::parse(schema_of(kind)));
    EXPECT_EQ(validators.at(kind).wrong(json_of(config::parse_file(file))), "") << file;
  }
  EXPECT_EQ(validators.size(), 8u) << "a kind of file that is not shipped";
}

TEST(KeySchema, RefusesWhatIsNoFileOfOurs) {
  const Validator robot(Json::parse(schema_of("robot")));
  const std::string format = "format = \"sinew.robot/1\"\n";
  const auto wrong = [&](const std::string& text) {
    return robot.wrong(json_of(config::parse_text(text, "test")));
  };
  EXPECT_EQ(wrong(format + "gravity = \"9.81 m/s2\""), "");
  EXPECT_EQ(wrong(format + "gravity = { value = \"9.81 m/s2\", source = \"here\" }"), "");
  EXPECT_THAT(wrong("gravity = \"9.81 m/s2\""), HasSubstr("no format"));
  EXPECT_THAT(wrong("format = \"sinew.plan/1\""), HasSubstr("another constant"));
  for (const auto& [text, what] :
       {std::pair{"gravitation = \"9.81 m/s2\"", "an unknown key"},
        {"gravity = 9.81", "another type"},
        {"gravity = \"much\"", "no quantity"},
        {"gravity = { value = \"9.81 m/s2\", surce = \"here\" }", "an unknown key"},
        {"joint.hip.damping = [\"1 N m s/rad\"]", "another type"},
        {"joint.hip.dampnig = \"1 N m s/rad\"", "an unknown key"},
        {"joint.hip.kind = \"drivn\"", "no such word"},
        {"joint.hip.stop.angles = \"1 deg\"", "another type"},
        {"muscle.a.count = 1.5", "another type"},
        {"muscle.a.count = 0", "too small"},
        {"muscle.a.count = 101", "too large"},
        {"trolley.present = \"yes\"", "another type"},
        {"foot.friction = -1", "too small"},
        {"files.actuator = 3", "another type"},
        {"leg.left.joints = \"hip\"", "another type"}})
    EXPECT_THAT(wrong(format + text), HasSubstr(what)) << text;
}

TEST(KeySchema, OfAKindThatThereIsNotIsRefused) {
  for (const char* kind : {"robots", "any", "", "sinew.robot/1"}) {
    try {
      schema_of(kind);
      ADD_FAILURE() << kind;
    } catch (const config::Error& e) {
      EXPECT_THAT(e.what(), HasSubstr("schema: found")) << kind;
    }
  }
}

}  // namespace
}  // namespace sinew::files::key_schema_test
