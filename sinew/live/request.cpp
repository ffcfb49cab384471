#include "sinew/live/request.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sinew/json/json.h"
#include "sinew/run/controllers/steering.h"

namespace sinew::live {
namespace {

using Kind = Request::Kind;

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw std::invalid_argument(fmt::format("found {}; expected {}", found, expected));
}

struct Form {
  std::string_view word;
  Kind kind;
  bool key, value;
};
constexpr Form forms[] = {
    {"pause", Kind::pause, false, false},
    {"resume", Kind::resume, false, false},
    {"pace", Kind::pace, false, true},
    {"stop", Kind::stop, false, false},
    {"set", Kind::set, true, true},
    {"release", Kind::release, true, false},
    {"release all", Kind::release_all, false, false},
};

const Form& form_of(const Json& json) {
  const auto word = json.find("do");
  if (word == nullptr || !word->is_string()) refuse("no \"do\"", "what is to be done");
  for (const Form& form : forms)
    if (form.word == word->string()) return form;
  refuse(word->text(), "pause, resume, pace, stop, set, release or release all");
}

double number(const Json& json, double least, double most, bool or_zero = false) {
  if (!json.is_number()) refuse("a value that is not a number", "a number");
  const double value = json.number();
  if ((or_zero && value == 0) || (value >= least && value <= most)) return value;
  refuse(fmt::format("{}", value), fmt::format("{}{} to {}", or_zero ? "0, or " : "", least, most));
}

}  // namespace

Request read_request(std::string_view text, const std::vector<gait::Setting>& settings) {
  if (text.size() > longest_request)
    refuse("a long message", fmt::format("{} bytes", longest_request));
  Json json;
  (void)Json::parse(text, json);
  if (!json.is_object()) refuse("no JSON object", "{\"do\": …}");
  const Form& form = form_of(json);
  const std::size_t members = 1u + form.key + form.value;
  if (json.size() != members || json.contains("key") != form.key ||
      json.contains("value") != form.value)
    refuse("other members", fmt::format("\"do\"{}{} and no more", form.key ? ", \"key\"" : "",
                                        form.value ? ", \"value\"" : ""));

  Request out{.kind = form.kind};
  if (form.key) {
    const int setting =
        json["key"].is_string() ? gait::find_setting(settings, json["key"].string()) : -1;
    if (setting < 0) refuse("an unknown key", "one of the run's gains or desired stiffnesses");
    out.setting = static_cast<std::size_t>(setting);
  }
  using run::Steering;
  if (form.kind == Kind::pace)
    out.value = number(json["value"], Steering::slowest, Steering::fastest, true);
  if (form.kind == Kind::set) out.value = number(json["value"], 0, gait::Setting::most);
  return out;
}

}  // namespace sinew::live
