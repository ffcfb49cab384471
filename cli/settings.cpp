#include "cli/settings.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "sinew/config/diagnostics.h"

namespace sinew::cli {

namespace {

// Settings that give each name a value, `names.load=NAME`, and what their options are called.
struct Renamed {
  std::string_view setting, option;
};
constexpr Renamed renamed[] = {
    {"names", "map"}, {"units", "unit"}, {"values", "value"}, {"offsets", "offset"}};

// Settings that messages of the library name with a value. Other words stay: "time=0" is no option.
constexpr std::string_view settings =
    " actuator added_volume align anyway arm base bits candidate columns compressor "
    "conductance contraction cycles dates decimal device diameter down droop "
    "droop_flow drop_incomplete encoding exponent external_volume fill_time flexion flexor_length "
    "flow "
    "force frequency full_scale hold_out json keep_force known label largest law_error lever "
    "line load machine made model moment_arm most motion muscle_pressure muscles names "
    "offsets only part per_volume points port pressure range rate reading report rest "
    "rest_length root sensors shard spread_times thousands time torque units values vary "
    "volume where ";

// Settings whose names are also keys of units, as in "length=mm": with a value in quotes alone.
constexpr std::string_view quoted_settings = " length ";

// Settings that can be the subject of a problem: at the begin of a line, or behind a file's name.
// A name with a line number is a key of that file.
constexpr std::string_view subjects =
    " candidate freeze known model names offsets part points prior range report rigs "
    "sensors "
    "shard tie units values vary where ";

// Settings that can be the subject at the begin of a line alone: a file may have such a column.
constexpr std::string_view quantities =
    " added_volume align align_by angles arm atmosphere base bits branch bridge channels "
    "clock closing_delay compressor compressor_mass concentration conductance "
    "contracted_length contraction count criterion critical_ratio cycles dates decimal "
    "diameter down droop droop_flow duration duty encoding error event excitation exponent "
    "extensor_length external_volume fill_time fit fit_where flexion flexor_length flow font "
    "foot force fps frequency from full_scale gage_factor gages gain greatest_duty height "
    "hold_out kind label law_error least_duty length length_error lever limb limb_lever line "
    "load longest lowest machine made mass modulus moment_arm most motion mount_time "
    "muscle_pressure muscles name noise opening_delay output poisson port predict "
    "predict_dat pressure prior rate reading rest rest_angle rest_length sensitivity "
    "shortest side speed start step step_time supply temperature thousands thread_thickness "
    "threads time title to torque trapezoids uncertainty use vent_time vent_to volume width "
    "window within yield ";

bool is_one_of(std::string_view word, std::string_view words) {
  return words.find(" " + std::string(word) + " ") != words.npos;
}

bool is_letter_of_a_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string option_of(std::string_view setting) {
  const auto* other = std::ranges::find(renamed, setting, &Renamed::setting);
  std::string out = "--" + std::string(other == std::end(renamed) ? setting : other->option);
  std::ranges::replace(out, '_', '-');
  return out;
}

bool begins_a_line(std::string_view before) { return before.empty() || before.ends_with('\n'); }

bool can_be_subject(std::string_view before) {
  if (begins_a_line(before)) return true;
  return before.size() > 2 && before.ends_with(": ") &&
         std::isdigit(before[before.size() - 3]) == 0;
}

// Returns the setting that begins at `at` as its option, "" for none; `taken` is its length.
std::string option_at(std::string_view whole, std::size_t at, std::size_t& taken) {
  const std::string_view text = whole.substr(at);
  const std::size_t end =
      static_cast<std::size_t>(std::ranges::find_if_not(text, is_letter_of_a_name) - text.begin());
  const std::string_view name = text.substr(0, end), rest = text.substr(end);
  taken = end;
  if (is_one_of(name, subjects) && rest.starts_with(": found ") &&
      can_be_subject(whole.substr(0, at)))
    return option_of(name);
  if (is_one_of(name, quantities) && rest.starts_with(": found ") &&
      begins_a_line(whole.substr(0, at)))
    return option_of(name);
  const bool is_quoted = is_one_of(name, quoted_settings) && rest.starts_with("=\"");
  if ((!is_one_of(name, settings) && !is_quoted) || rest.size() < 2) return "";
  const bool named = std::ranges::count(renamed, name, &Renamed::setting) > 0;
  const bool value = rest[0] == '=' && rest[1] != ' ' && rest[1] != '=';
  const bool begins_name = is_letter_of_a_name(rest[1]) || rest[1] == '/';  // as a channel
  if (!(named ? rest[0] == '.' && begins_name : value)) return "";
  taken += 1;
  if (!rest.substr(1).starts_with("true")) return option_of(name) + " ";
  taken += 4;
  return option_of(name);
}

}  // namespace

std::string as_options(std::string_view text) {
  std::string out;
  bool quoted = false, begins_word = true;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t taken = 1;
    std::string option;
    if (begins_word && !quoted) option = option_at(text, at, taken);
    if (option.empty()) {
      const char c = text[at++];
      out += c;
      if (c == '"' || c == '\n') quoted = c == '"' && !quoted;
      begins_word = c == ' ' || c == '(' || c == '\n';
      continue;
    }
    out += option;
    at += taken;
    begins_word = false;
  }
  return out;
}

bool is_of_option(const std::exception& error) {
  const auto* all = dynamic_cast<const config::Error*>(&error);
  // "--width: found …", "rig.csv: --part: found …"; a problem with a line is of that file.
  const auto of_option = [](const config::Problem& problem) {
    std::string text = as_options(config::to_text(problem));
    const std::string file = problem.where.file + ": ";
    if (problem.where.line == 0 && text.starts_with(file + "--")) text.erase(0, file.size());
    return text.starts_with("--") && text.find(':') < text.find(' ');
  };
  return all && std::ranges::all_of(all->problems(), of_option);
}

}  // namespace sinew::cli
