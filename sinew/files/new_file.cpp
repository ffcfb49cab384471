#include "sinew/files/new_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/config/shipped.h"
#include "sinew/config/text_file.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/files/check.h"
#include "sinew/robot/legs.h"
#include "sinew/run/folder/files.h"
#include "sinew/units/constants.h"

namespace sinew::files {

namespace {

// Properties of the muscle that the rest of the robot depends on.
struct Muscle {
  std::string name;
  double mount = 0;     // [m]
  double arm = 0;       // [m]
  double tension = 0;   // the largest  [N]
  double pressure = 0;  // the highest, gauge  [Pa]
};

// Largest angle from rest in the plan of a new experiment; it takes half of the muscle's way to
// either end.
constexpr double planned = 20 * std::numbers::pi / 180;  // [rad]
constexpr double share_of_way = 0.5;
constexpr double template_supply = 100 * units::psi;  // gauge [Pa]
constexpr double converter_range = 5;                 // [V]

Muscle muscle_of(const std::string& file) {
  const std::string kind(config::format_kind(config::compose(file)));
  if (kind != "actuator")
    config::fail({file, 0, 0}, "", fmt::format("format = \"sinew.{}/1\"", kind),
                 "an actuator's file, format = \"sinew.actuator/1\"",
                 "sinew identify static, which writes one from forces that you measured");
  const auto machine = experiment::load_machine_file(file);
  const actuator::Actuator& a = machine.experiment.actuators.front();
  const double shortest = std::max(actuator::shortest_length(a), a.bladder.valid_from);
  const double longest = std::min(a.long_end.length, a.bladder.valid_to);
  Muscle m{.name = a.name, .mount = 0.5 * (shortest + longest)};
  m.arm = share_of_way * 0.5 * (longest - shortest) / planned;
  m.pressure = std::min(template_supply, a.effectiveness.valid_to);
  const gas::Air& air = machine.experiment.air;
  m.tension = actuator::operating_point(a, longest, m.pressure,
                                        {air.atmosphere, air.polytropic_exponent, 0})
                  .tension;
  return m;
}

// Returns the position of the line that begins with `key`, searched from `from`; npos if none does.
std::size_t line_of(const std::string& text, std::string_view key, std::size_t from = 0) {
  for (std::size_t at = text.find(key, from); at != text.npos; at = text.find(key, at + 1)) {
    const bool begins = at == 0 || text[at - 1] == '\n';
    const char after = text[at + key.size()];
    if (begins && (after == ' ' || after == '=')) return at;
  }
  return text.npos;
}

// Sets the value in every line of `key`; keeps the alignment.
void set(std::string& text, std::string_view key, const std::string& value) {
  for (std::size_t at = line_of(text, key); at != text.npos; at = line_of(text, key, at + 1)) {
    const std::size_t equals = text.find("= ", at) + 2, end = text.find('\n', at);
    text.replace(equals, end - equals, value);
  }
}

void remove(std::string& text, std::string_view key) {
  for (std::size_t at = line_of(text, key); at != text.npos; at = line_of(text, key, at))
    text.erase(at, text.find('\n', at) + 1 - at);
}

std::string guessed(const std::string& value, std::string_view source) {
  return fmt::format("{{ value = \"{}\", guess = true, source = \"{}\" }}", value, source);
}

// Rounds to three digits, enough for a guess.
std::string rounded(double value, std::string_view unit) {
  const double digit = std::pow(10, std::floor(std::log10(std::max(value, 1e-9))) - 2);
  return fmt::format("{:g} {}", std::round(value / digit) * digit, unit);
}

}  // namespace

std::string with_muscle(std::string text, const std::string& file, const std::string& reference,
                        bool metric) {
  const Muscle m = muscle_of(file);
  const auto length = [metric](double si) {
    return metric ? rounded(si * 1e3, "mm") : rounded(si / units::inch, "in");
  };
  const std::string cell =
      metric ? rounded(converter_range / (1.1 * m.tension), "V/N")
             : rounded(converter_range / (1.1 * m.tension / units::pound_force), "V/lbf");
  const std::string supply = metric ? rounded(m.pressure / units::bar, "bar gauge")
                                    : rounded(m.pressure / units::psi, "psi gauge");

  set(text, "files",
      fmt::format("{{ actuator = {}, valves = \"valves.toml\" }}   # the muscle "
                  "that you identified, and valves",
                  reference));
  set(text, "actuator", config::toml_string(m.name));
  set(text, "mount_length",
      guessed(length(m.mount), "replace: half way between the lengths of the muscle's file"));
  set(text, "moment_arm",
      guessed(length(m.arm), "replace: 20 deg take half of the way that the muscle has there"));
  for (const std::string_view key : {"bladder_stiffness", "bladder_rest_length"}) remove(text, key);
  const auto replace_in_line = [&text](std::string_view key, std::string_view begin,
                                       const std::string& with) {
    for (std::size_t at = line_of(text, key); at != text.npos; at = line_of(text, key, at + 1)) {
      const std::size_t line_end = text.find('\n', at), from = text.find(begin, at);
      if (from > line_end) continue;
      const std::size_t value = text.find('"', from) + 1;
      const std::string_view old(text.data() + value, text.find('"', value) - value);
      const bool is_cell = old.ends_with("V/lbf") || old.ends_with("V/N");
      if (key == "supply" || is_cell) text.replace(value, old.size(), with);
    }
  };
  for (const std::string_view key : {"real", "assumed"}) replace_in_line(key, "scale", cell);
  replace_in_line("supply", "pressure = { value", supply);
  return text;
}

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> kinds_of_files{
    "robot", "actuator", "valves", "wiring", "experiment", "plan", "tuning", "rig", "mapping"};
constexpr std::size_t longest_name = 64;

// Joint of the templates, and its rest angle there.
constexpr std::string_view template_joint = "lever";
constexpr double template_rest_deg = 270;

struct Joint {
  std::string name;
  std::string in_plan;  // without its leg: a plan drives all legs alike
  double rest_deg = template_rest_deg;
  bool driven = true;  // whether muscles drive it
  std::string leg;     // empty for a robot with one leg, whose figures have no leg's name
};

// Base of the new file: a robot or an experiment, and the joints that it drives.
struct Subject {
  fs::path file;
  std::vector<Joint> joints{
      {.name = std::string(template_joint), .in_plan = std::string(template_joint)}};
  bool has_ground = false;      // whether the feet of a robot could touch it
  bool plan_has_gains = false;  // its [control.gains] hold instead of the robot's
  bool seals = true;            // whether the valves of the first driven joint shut its muscles off
};

void require_new_kind(const std::string& kind) {
  if (std::ranges::count(kinds_of_files, kind) > 0) return;
  const std::vector<std::string_view> words(kinds_of_files.begin(), kinds_of_files.end());
  config::fail({"new", 0, 0}, "", config::in_quotes(kind), config::either(words),
               config::closest_in_quotes(kind, words));
}

// Checks a name, which becomes the name of a folder or file and occurs in keys and comments.
void require_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  };
  if (!name.empty() && name.size() <= longest_name && name[0] != '-' &&
      std::ranges::all_of(name, is_plain))
    return;
  std::string plain = fs::path(name).stem().string();
  std::ranges::replace(plain, ' ', '-');
  if (!std::ranges::all_of(plain, is_plain) || plain.starts_with('-') || plain == name)
    plain.clear();
  config::fail(
      {"new", 0, 0}, "",
      name.size() > longest_name ? fmt::format("a name of {} letters", name.size())
                                 : config::in_quotes(name),
      fmt::format("a name of a to z, 0 to 9, - and _, {} letters at most; the folder is an "
                  "option of its own",
                  longest_name),
      plain.empty() ? "" : "\"" + plain.substr(0, longest_name) + "\"");
}

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// Chooses from "3.15 in | 80 mm" in a template.
void choose_units(std::string& text, bool metric) {
  constexpr std::string_view between = " | ";
  for (std::size_t at = text.find(between); at != text.npos; at = text.find(between, at)) {
    const std::size_t begin = text.rfind('"', at) + 1, end = text.find('"', at);
    if (metric)
      text.erase(begin, at + between.size() - begin);
    else
      text.erase(at, end - at);
  }
}

// Replaces NEW by the name in a value, `name = "NEW"`, and by the file elsewhere, in comments.
void put_name(std::string& text, const std::string& name, const std::string& file) {
  constexpr std::string_view mark = "NEW", before_value = "= \"";
  for (std::size_t at = text.find(mark); at != text.npos;) {
    const bool is_value = std::string_view(text).substr(0, at).ends_with(before_value);
    const std::string& word = is_value ? name : file;
    text.replace(at, mark.size(), word);
    at = text.find(mark, at + word.size());
  }
}

// Returns a file's name for a shell command in a comment.
std::string in_comment(const fs::path& file) {
  const std::string name = file.string();
  const auto is_control = [](char c) { return (c >= 0 && c < 0x20) || c == 0x7F; };
  if (std::ranges::any_of(name, is_control)) return file.filename().string();
  return name.find(' ') == name.npos ? name : "\"" + name + "\"";
}

// Shifts angles to the joint's rest angle: "290 deg" in the template is 20 deg beyond it.
std::string about(const Joint& joint, std::string text) {
  for (std::size_t end = text.find(" deg\""); end != text.npos;
       end = text.find(" deg\"", end + 5)) {
    const std::size_t begin = text.rfind('"', end) + 1;
    const double angle = std::stod(text.substr(begin, end - begin));
    const std::string moved = fmt::format("{:g}", angle - template_rest_deg + joint.rest_deg);
    text.replace(begin, end - begin, moved);
    end = begin + moved.size();
  }
  return text;
}

// Repeats "{ lever = X }" for each joint: for all joints at the start, for those of one leg in a
// plan.
void name_joints(std::string& text, const std::vector<Joint>& joints) {
  const std::string opening = fmt::format("{{ {} = ", template_joint);
  for (std::size_t at = text.find(opening); at != text.npos; at = text.find(opening, at + 1)) {
    const std::size_t end = text.find(" }", at);
    const std::string value = text.substr(at + opening.size(), end - at - opening.size());
    const bool at_start = text.compare(text.rfind("\n[", at) + 1, 7, "[start]") == 0;
    std::string all;
    std::set<std::string> named;
    for (const Joint& joint : joints)
      if (const std::string& name = at_start ? joint.name : joint.in_plan;
          (at_start || joint.driven) && named.insert(name).second)
        all += fmt::format("{}{} = {}", all.empty() ? "{ " : ", ", name, about(joint, value));
    text.replace(at, end - at, all);
  }
}

// Names the first driven joint in the keys of a study. All legs share the gains of a plan, and the
// figures of a leg's joint have the names that a summary has.
void name_first_joint(std::string& text, const Subject& subject) {
  const Joint& first = *std::ranges::find_if(subject.joints, &Joint::driven);
  const std::string name(template_joint);
  const bool of_plan = subject.plan_has_gains || !first.leg.empty();
  replace_all(text, fmt::format("\"joint.{}.angle_gain=", name),
              of_plan ? fmt::format("\"control.gains.{}.angle=", first.in_plan)
                      : fmt::format("\"joint.{}.angle_gain=", first.name));
  replace_all(text, fmt::format("stiffness.{}=", name), "stiffness." + first.in_plan + "=");
  const std::string figures = first.leg.empty()
                                  ? fmt::format("joints.{}.", first.name)
                                  : fmt::format("legs.{}.joints.{}.", first.leg, first.in_plan);
  replace_all(text, fmt::format("joints.{}.", name), figures);
  if (subject.seals) return;
  // Valves that never shut leave no joint passive; they take much air instead.
  replace_all(text, figures + "passiveness > 10 %", "air_used_kg < 100 g");
  replace_all(text, figures + "passiveness [%], ", "");
}

const config::Node* value_of(const config::Node& table, const char* key) {
  const config::Node* node = table.find(key);
  return node && node->is_value_table() ? node->find("value") : node;
}

// Returns the leg of a joint: "left" for left_hip if the robot has a leg of that name; else empty.
std::string leg_of(const std::string& joint, const config::Node& root) {
  if (const config::Node* legs = root.find("leg"))
    for (const config::Node& leg : legs->children)
      if (joint.starts_with(leg.key + "_")) return leg.key;
  return "";
}

// Returns whether all valves of the joint's muscles shut, so that the joint can be passive.
bool valves_shut(const config::Node& root, const std::string& joint) {
  const analysis::Machine machine = analysis::read_machine(root);
  return std::ranges::all_of(machine.robot.muscles, [&](const robot::Muscle& m) {
    const bool is_of = m.joint == joint || m.second.joint == joint;
    return !is_of || analysis::valve_of(machine, m.inlet).kind == gas::Valve::Kind::two_way;
  });
}

// Returns the joints with their rest angles.
std::vector<Joint> joints_of(const config::Node& root) {
  std::vector<Joint> out;
  if (const config::Node* table = root.find("joint"))
    for (const config::Node& joint : table->children) {
      const config::Node* kind = value_of(joint, "kind");
      const config::Node* rest = value_of(joint, "rest_angle");
      const double angle =
          rest ? config::quantity(rest->text, "rad", joint.key + ".rest_angle") : 0;
      const std::string leg = leg_of(joint.key, root);
      out.push_back({.name = joint.key,
                     .in_plan = robot::name_in_leg(leg, joint.key),
                     .rest_deg = angle * 180 / std::numbers::pi,
                     .driven = !kind || kind->text != "passive",
                     .leg = leg});
    }
  return out;
}

// Returns whether the file is a study, which runs an experiment many times.
bool is_study(std::string_view kind) { return kind == "plan" || kind == "tuning"; }

// Returns the base: the file that was given, or one shipped with Sinew.
Subject subject_of(const std::string& kind, const NewOptions& options) {
  const bool study = is_study(kind);
  if (kind != "experiment" && !study) {
    if (options.of.empty()) return {};
    config::fail(
        {options.of, 0, 0}, "", fmt::format("a file for a new {} to be of", kind),
        "an experiment, which is of a robot, or a plan or tuning, which is of an experiment");
  }
  if (options.of.empty())
    return {config::shipped_folder() /
            (study ? "experiments/one-joint.toml" : "robots/one-joint/robot.toml")};
  const config::Node root = config::compose(options.of);
  const std::string_view wanted = study ? "experiment" : "robot";
  if (const std::string_view found = config::format_kind(root); found != wanted)
    config::fail({options.of, 0, 0}, "",
                 fmt::format("format = \"{}\"", config::newest_format(found)),
                 fmt::format("the {} that the new {} is of, format = \"{}\"", wanted, kind,
                             config::newest_format(wanted)));
  Subject out{options.of, joints_of(root)};
  const auto first = std::ranges::find_if(out.joints, &Joint::driven);
  if (first == out.joints.end())
    config::fail({options.of, 0, 0}, "joint", "no joint with muscles", "one at least");
  const config::Node* ground = config::value_at(root, "ground.present");
  out.has_ground = ground && (ground->is_value_table() ? ground->find("value") : ground)->flag;
  if (!study) return out;
  const std::string gains = fmt::format("control.gains.{}.angle", first->in_plan);
  out.plan_has_gains = config::value_at(root, gains) != nullptr;
  out.seals = valves_shut(root, first->name);
  return out;
}

// Returns the path of a file relative to the folder `from`.
std::string relative_to(const fs::path& from, const fs::path& file) {
  const fs::path folder = fs::weakly_canonical(fs::absolute(from));
  return fs::weakly_canonical(fs::absolute(file)).lexically_relative(folder).string();
}

// Returns the file's path relative to the folder `from`; a shipped file has its full path.
std::string reference(const fs::path& from, const fs::path& file) {
  const bool is_shipped =
      file.is_absolute() && relative_to(config::shipped_folder(), file)[0] != '.';
  return is_shipped ? file.string() : relative_to(from, file);
}

struct Draft {
  fs::path file;
  std::string text;
};

// Request for a new file.
struct Task {
  std::string kind, name;
  const NewOptions& options;
  Subject subject;
};

// Fills in the template `part`: robot, actuator, …
Draft draft(const Task& task, const std::string& part, const fs::path& file) {
  const fs::path from = config::shipped_folder() / "data/templates" / (part + ".toml");
  Draft out{file, config::read_text_file(from.string(), "a template of Sinew")};
  choose_units(out.text, task.options.metric);
  if (const std::string& muscle = task.options.actuator; part == "robot" && !muscle.empty())
    out.text = with_muscle(std::move(out.text), muscle,
                           config::toml_string(reference(file.parent_path(), muscle)),
                           task.options.metric);
  if (task.kind == "actuator") replace_all(out.text, "= \"bpa\"", "= \"NEW\"");
  name_joints(out.text, task.subject.joints);
  name_first_joint(out.text, task.subject);
  if (part == "experiment" && task.subject.has_ground)
    out.text +=
        "\n# The feet move in the air: about the joints' rest angles they could be in the ground.\n"
        "[ground]\npresent = false\n";
  put_name(out.text, task.name, in_comment(file));
  if (part == "experiment" || is_study(part)) {
    const std::string key = is_study(part) ? "experiment = " : "robot  = ";
    const std::string quoted = is_study(part) ? "\"experiment.toml\"" : "\"robot.toml\"";
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    replace_all(out.text, key + quoted,
                key + config::toml_string(reference(folder, task.subject.file)));
  }
  return out;
}

// Returns the files to write; a robot and a rig have their actuator and valves in their own folder.
std::vector<Draft> drafts(const std::string& kind, const std::string& name,
                          const NewOptions& options) {
  const fs::path folder(options.folder);
  if (!options.folder.empty() && fs::exists(folder) && !fs::is_directory(folder))
    config::fail({options.folder, 0, 0}, "", "a file", "a folder, or an unused name");
  const bool has_muscle = !options.actuator.empty();
  if (has_muscle && kind != "robot")
    config::fail({options.actuator, 0, 0}, "", fmt::format("an actuator for a new {}", kind),
                 "a robot, whose muscles it becomes");
  const Task task{kind, name, options, subject_of(kind, options)};
  if (kind != "robot" && kind != "rig") return {draft(task, kind, folder / (name + ".toml"))};
  std::vector<Draft> out;
  for (const std::string& part : {kind, std::string("actuator"), std::string("valves")})
    if (!(has_muscle && part == "actuator"))
      out.push_back(draft(task, part, folder / name / (part + ".toml")));
  return out;
}

}  // namespace

std::span<const std::string_view> new_kinds() { return kinds_of_files; }

NewFiles write_new(const std::string& kind, const std::string& name, const NewOptions& given) {
  NewOptions options = given;
  options.of = config::or_shipped(options.of);
  options.actuator = config::or_shipped(options.actuator);
  require_new_kind(kind);
  require_name(name);
  const std::vector<Draft> all = drafts(kind, name, options);
  for (const Draft& one : all)
    if (fs::exists(fs::symlink_status(one.file)))
      config::fail({one.file.string(), 0, 0}, "", "an existing file", "an unused name",
                   "another name, or to remove it");
  NewFiles out;
  for (const Draft& one : all) {
    if (one.file.has_parent_path()) run::make_folders(one.file.parent_path());
    run::write_file(one.file, one.text);
    out.files.push_back(one.file.string());
  }
  out.problems = check(out.files[0]).problems;
  return out;
}

}  // namespace sinew::files
