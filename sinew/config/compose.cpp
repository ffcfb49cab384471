#include "sinew/config/compose.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "sinew/config/changes.h"
#include "sinew/config/gains.h"
#include "sinew/config/shipped.h"
#include "sinew/units/letters.h"

namespace sinew::config {

namespace {

namespace fs = std::filesystem;

const char* const set_origin = "--set";

// --- paths of other files ---

void check_kind(const Node& root, const Node& entry, const std::string& key,
                std::string_view kind) {
  if (format_kind(root) == kind) return;
  fail(entry.where, key,
       fmt::format("{}, a file of kind {}", in_quotes(entry.text), format_kind(root)),
       fmt::format("a file of kind {}", kind));
}

// --- base ---

// Returns a file merged over its base.
Node load(const std::string& path) {
  Node own = parse_file(path);
  check_format(own);
  const Node* base_entry = own.find("base");
  if (!base_entry) return own;
  std::error_code none;
  if (fs::equivalent(path, file_of(*base_entry, "base"), none))
    fail(base_entry->where, "base", in_quotes(base_entry->text) + ", this file itself",
         "another file, whose values this one replaces");

  Node base = parse_file(file_of(*base_entry, "base"));
  check_format(base);
  check_kind(base, *base_entry, "base", format_kind(own));
  if (const Node* second = base.find("base")) {
    fail(second->where, "base", shown(*second),
         "a base without a base of its own: one level is allowed",
         "naming that file as the base in " + path);
  }
  base.where = own.where;
  for (const char* of_base_alone : {"reported", "reproduces"}) base.erase(of_base_alone);
  merge(base, own);
  base.erase("base");
  base.find("format")->used = true;
  return base;
}

Node load_named(const Node& entry, const std::string& key, std::string_view kind) {
  Node root = load(file_of(entry, key));
  check_kind(root, entry, key, kind);
  return root;
}

// --- the parts of a robot ---

// Returns the table `key` of the root; creates it if it is missing.
Node& root_table(Node& root, std::string_view key, const Location& where) {
  if (Node* there = root.find(key)) {
    if (!there->is_table()) fail(there->where, std::string(key), shown(*there), "a table");
    return *there;
  }
  return root.put(make_table(key, where));
}

// Adds an actuator's file as actuator.<name>.
void put_actuator(Node& root, Node actuator) {
  const Node* name = actuator.find("name");
  actuator.key = name ? name->text : fs::path(actuator.where.file).stem().string();
  Node& all = root_table(root, "actuator", actuator.where);
  if (const Node* twice = all.find(actuator.key)) {
    fail((name ? *name : actuator).where, "name", in_quotes(actuator.key),
         fmt::format("a name that {} does not use", twice->where.file));
  }
  actuator.erase("format");
  actuator.erase("name");
  all.put(std::move(actuator));
}

// Adds the tables of a valves or wiring file. Keys in the robot's own file, or in one with that
// robot as its base, take precedence.
void put_tables(Node& root, Node tables) {
  tables.erase("format");
  tables.erase("name");
  Node own = make_table("");
  for (const Node& table : tables.children)
    if (const Node* there = root.find(table.key)) own.put(*there);
  for (const Node& table : own.children) root.erase(table.key);
  merge(root, tables);
  merge(root, own);
}

void add_actuators(Node& root, const Node& entry) {
  const bool many = entry.kind == Node::Kind::array;
  if (!many) return put_actuator(root, load_named(entry, "files.actuator", "actuator"));
  for (const Node& one : entry.children) {
    put_actuator(root, load_named(one, "files.actuator", "actuator"));
  }
}

void add_valve_timing(Node& root, const Node& entry) {
  Node& low_level = root_table(root, "low_level", entry.where);
  const std::string path =
      fs::absolute(file_of(entry, "files.valve_timing")).lexically_normal().string();
  low_level.put(make_text("valve_timing", path, entry.where));
}

// Adds the gains; those of an experiment also set the desired stiffness of the first joint.
void add_gains(Node& root, const Node& entry) {
  put_gains(root, entry, file_of(entry, "files.gains"), format_kind(root) == "experiment");
}

// Removes `files` from the tree and adds the contents of the files.
void resolve_files(Node& root) {
  const Node* there = root.find("files");
  if (!there) return;
  const Node files = *there;
  if (!files.is_table()) fail(files.where, "files", shown(files), "a table of file names");
  root.erase("files");
  for (const Node& entry : files.children) {
    if (entry.key == "actuator") {
      add_actuators(root, entry);
    } else if (entry.key == "valves") {
      put_tables(root, load_named(entry, "files.valves", "valves"));
    } else if (entry.key == "wiring") {
      put_tables(root, load_named(entry, "files.wiring", "wiring"));
    } else if (entry.key == "valve_timing") {
      add_valve_timing(root, entry);
    } else if (entry.key == "gains") {
      add_gains(root, entry);
    } else {
      const std::vector<std::string_view> known = {"actuator", "valves", "valve_timing", "gains",
                                                   "wiring"};
      fail(entry.where, "files." + entry.key, "an unknown key", either(known),
           std::string(closest(entry.key, known)));
    }
  }
}

// Renames the robot's `name` to robot_name, its key in an experiment.
void rename_robot(Node& robot) {
  if (Node* name = robot.find("name")) name->key = "robot_name";
}

Node with_robot(Node root) {
  const Node* entry = root.find("robot");
  if (!entry) return root;
  Node robot = load_named(*entry, "robot", "robot");
  resolve_files(robot);
  rename_robot(robot);
  robot.erase("format");
  root.erase("robot");
  robot.where = root.where;
  merge(robot, root);
  return robot;
}

// Moves a single file's contents to their place in an experiment.
Node placed(Node root) {
  const std::string_view kind = format_kind(root);
  if (kind == "robot") rename_robot(root);
  if (kind != "actuator") return root;
  Node alone = make_table("", root.where);
  alone.put(*root.find("format"));
  put_actuator(alone, std::move(root));
  return alone;
}

// --- --set ---

Location set_location() { return {set_origin, 0, 0}; }

Node set_value(std::string_view key, std::string_view text) {
  if (text == "true" || text == "false") return make_flag(key, text == "true", set_location());
  const char* last = text.data() + text.size();
  const bool number_like = text.find_first_of("0123456789") < 2;  // not nan, not inf
  std::int64_t whole = 0;
  const auto integer = std::from_chars(text.data(), last, whole);
  if (integer.ptr == last && integer.ec == std::errc{} && number_like) {
    return make_integer(key, whole, set_location());
  }
  // Whole numbers beyond the range of integers as well: the reader checks its type.
  double real = 0;
  const auto number = std::from_chars(text.data(), last, real);
  if (number.ptr == last && number.ec == std::errc{} && number_like) {
    return make_number(key, real, set_location());
  }
  return make_text(key, std::string(text), set_location());
}

// Sets the origin of all nodes to --set.
void mark_as_set(Node& node) {
  node.where = set_location();
  for (Node& child : node.children) mark_as_set(child);
}

Node set_node(std::string_view key, std::string_view text) {
  const bool toml = !text.empty() && (text[0] == '[' || text[0] == '{' || text[0] == '"');
  if (!toml) return set_value(key, text);
  Node value = parse_text(fmt::format("value = {}", text), set_origin).children.front();
  value.key = key;
  mark_as_set(value);
  return value;
}

// Returns an element of an existing list, "polynomial[1]" or "fault[0]".
Node& element(Node& table, std::string_view segment, const std::string& key) {
  const std::size_t bracket = std::min(segment.find('['), segment.size());
  Node* list = table.find(segment.substr(0, bracket));
  if (list && list->is_value_table()) list = list->find("value");
  if (!list || list->kind != Node::Kind::array || list->children.empty())
    fail(set_location(), key, list ? shown(*list) : "nothing", "a list to set an element of");
  std::size_t index = 0;
  const char* last = segment.data() + segment.size() - 1;
  const char* first = segment.data() + std::min(bracket + 1, segment.size() - 1);
  const auto [end, error] = std::from_chars(first, last, index);
  if (error != std::errc{} || end != last || index >= list->children.size())
    fail(
        set_location(), key, in_quotes(segment.substr(bracket)),
        list->children.size() == 1 ? "[0]" : fmt::format("[0] to [{}]", list->children.size() - 1));
  return list->children[index];
}

// Returns the table of the next segment. Creates it unless its name is probably a typing error.
Node& set_step(Node& table, std::string_view segment, const std::string& key) {
  if (segment.ends_with(']')) {
    Node& one = element(table, segment, key);
    if (one.is_table()) return one;
    fail(set_location(), key, fmt::format("{} is {}", segment, shown(one)),
         "a table to set a key in");
  }
  if (Node* there = table.find(segment)) {
    if (there->is_table()) return *there;
    fail(set_location(), key, fmt::format("{} is {}", segment, shown(*there)),
         "a table to set a key in", "");
  }
  const std::string_view near = closest(segment, keys_of(table));
  if (!near.empty()) {
    fail(set_location(), key, fmt::format("no table {}", in_quotes(segment)), "a table that exists",
         in_quotes(near));
  }
  return table.put(make_table(segment, set_location()));
}

// Replaces an element of an existing list, "polynomial[1]".
void set_element(Node& table, std::string_view segment, std::string_view text,
                 const std::string& key) {
  Node& old = element(table, segment, key);
  Node value = set_node("", text);
  value.replaced = written(old);
  old = std::move(value);
}

// --- valves of a catalogue ---

// Returns whether --set gave the value, or one of its parts; removes the other parts of a table.
bool leave_settings(Node& node) {
  if (node.where.file == set_origin || !node.is_table()) return node.where.file == set_origin;
  std::erase_if(node.children, [](Node& child) { return !leave_settings(child); });
  return !node.children.empty();
}

// Removes what a valve's files give if --set names another valve.
void leave_settings_of_named(Node& valve) {
  if (valve.find("catalogue")->where.file != set_origin) return;
  std::erase_if(valve.children, [](Node& child) {
    return child.key != "catalogue_file" && !leave_settings(child);
  });
}

// Returns the path of the catalogue that a valve's table names.
std::string catalogue_path(const Node& valve, const std::string& key) {
  const Node* file = valve.find("catalogue_file");
  if (!file) return (shipped_folder() / "data/valves.toml").string();
  return file_of(*file, key + "catalogue_file");
}

// Returns the valve of that name in a catalogue.
const Node& valve_in(const Node& catalogue, const Node& name, const std::string& key) {
  const Node* valves = catalogue.find("valve");
  const Node none = make_table("valve");
  const std::vector<std::string_view> names = keys_of(valves ? *valves : none);
  if (name.kind != Node::Kind::text || std::ranges::find(names, name.text) == names.end())
    fail(name.where, key, shown(name),
         fmt::format("a valve of {}: {}", catalogue.where.file, either(names)),
         closest_in_quotes(name.text, names));
  return *valves->find(name.text);
}

// Fills a valve's table with the values of a catalogue. A law of flow that differs from the
// catalogue's has other keys, so that flow is the table's own.
void fill_from(const Node& listed, Node& valve) {
  Node whole = listed;
  whole.key = valve.key;
  whole.where = valve.where;
  const auto law_of = [](const Node& of) {
    const Node* flow = of.find("flow");
    const Node* law = flow && flow->is_table() ? flow->find("law") : nullptr;
    return law ? law->text : std::string();
  };
  const std::string own = law_of(valve);
  if (!own.empty() && own != law_of(whole)) whole.erase("flow");
  for (const char* key : {"catalogue", "catalogue_file"}) valve.erase(key);
  merge(whole, valve);
  valve = std::move(whole);
}

}  // namespace

std::string file_of(const Node& entry, const std::string& key) {
  if (entry.kind != Node::Kind::text)
    fail(entry.where, key, shown(entry), "the name of a file, relative to this one");
  const fs::path folder = entry.where.line > 0 ? fs::path(entry.where.file).parent_path() : "";
  const std::string path = (folder / entry.text).lexically_normal().string();
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return path;
  const std::string own = find_shipped(entry.text);
  if (own.empty())
    fail(entry.where, key, in_quotes(entry.text), "a file that exists",
         "the path: looked for " + path);
  return own;
}

std::string_view format_kind(const Node& root) {
  const Node* node = root.find("format");
  if (!node) return {};
  const std::string_view stated = format_of(node->text).kind;
  const Kind* kind = changes().find(stated);
  return kind && !kind->now.empty() ? kind->now : stated;
}

bool is_on_stand(const Node& root) {
  const Node* node = root.find("format");
  for (const char* table : {"element", "load", "charge"})
    if (root.find(table)) return true;
  return node && format_of(node->text).kind == "rig";
}

std::string_view tables_kind(const Node& root) {
  const std::string_view kind = format_kind(root);
  return kind == "experiment" && is_on_stand(root) ? "rig" : kind;
}

namespace {

// Returns the key with actuator.<name> if it is one of an actuator's file, which omits that.
std::string with_actuator(const Node& root, std::string_view key) {
  const Node* actuators = format_kind(root) == "actuator" ? root.find("actuator") : nullptr;
  const std::string_view first = key.substr(0, key.find('.'));
  if (!actuators || actuators->children.empty() || root.find(first)) return std::string(key);
  return fmt::format("actuator.{}.{}", actuators->children.front().key, key);
}

}  // namespace

void apply_set(Node& root, std::string_view set) {
  const std::size_t equals = set.find('=');
  const std::string written(units::trimmed(set.substr(0, equals)));
  const bool empty_segment = written.empty() || written.front() == '.' || written.back() == '.' ||
                             written.find("..") != written.npos;
  if (equals == set.npos || empty_segment) {
    fail(set_location(), "", in_quotes(set), "key=value",
         "\"muscle.hip_flexor.mount_length=3.2 in\"");
  }
  if (std::ranges::count(written, '.') > 100)
    fail(set_location(), "", in_quotes(written), "a key of at most 100 parts");
  const std::string key = with_actuator(root, written);
  Node* table = &root;
  std::string_view rest = key;
  for (std::size_t dot; (dot = rest.find('.')) != rest.npos; rest.remove_prefix(dot + 1)) {
    table = &set_step(*table, rest.substr(0, dot), key);
  }
  const std::string_view value = units::trimmed(set.substr(equals + 1));
  if (rest.ends_with(']')) return set_element(*table, rest, value, key);
  table->put(set_node(rest, value));
}

Node compose(const std::string& path, const std::vector<std::string>& sets) {
  return Composer().compose(path, sets);
}

Node Composer::compose(const std::string& path, const std::vector<std::string>& sets) {
  // Another robot must be loaded before keys in its tables can be set.
  std::vector<std::string> files = {path}, others;
  for (const std::string& set : sets)
    (units::trimmed(set.substr(0, set.find('='))) == "robot" ? files : others).push_back(set);
  Node root = read(path, std::move(files));
  for (const std::string& set : others) apply_set(root, set);
  add_catalogue(root);
  return root;
}

// Completes the valves that name one of a catalogue.
void Composer::add_catalogue(Node& root) {
  Node* valves = root.find("valve");
  if (!valves || !valves->is_table()) return;
  for (Node& valve : valves->children) {
    const std::string key = "valve." + valve.key + ".";
    if (!valve.find("catalogue")) {
      if (const Node* file = valve.find("catalogue_file"))
        fail(file->where, key + "catalogue_file", shown(*file),
             "the name of one of its valves as " + key + "catalogue");
      continue;
    }
    leave_settings_of_named(valve);
    const std::string path = catalogue_path(valve, key);
    const Node& catalogue = read(path, {path});
    if (const Node* named = valve.find("catalogue_file"))
      check_kind(catalogue, *named, key + "catalogue_file", "valves");
    fill_from(valve_in(catalogue, *valve.find("catalogue"), key + "catalogue"), valve);
  }
}

// Returns the tree of these files, which are read at the first call.
const Node& Composer::read(const std::string& path, std::vector<std::string> files) {
  const std::lock_guard lock(mutex_);
  const auto there = read_.find(files);
  if (there != read_.end()) return there->second;
  Node root = load(path);
  for (std::size_t i = 1; i < files.size(); ++i) apply_set(root, files[i]);
  root = with_robot(std::move(root));
  resolve_files(root);
  return read_.emplace(std::move(files), placed(std::move(root))).first->second;
}

}  // namespace sinew::config
