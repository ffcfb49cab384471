#include "sinew/analysis/verdict/summary.h"

#include <cmath>

#include "sinew/config/quantity.h"
#include "sinew/json/json.h"

namespace sinew::analysis {
namespace {

// "a.b.c" becomes { a: { b: { c: value } } }.
void put(Json& root, std::string_view key, double value) {
  Json* at = &root;
  for (std::size_t dot; (dot = key.find('.')) != key.npos; key.remove_prefix(dot + 1))
    at = &(*at)[std::string(key.substr(0, dot))];
  (*at)[std::string(key)] = value;
}

// Our own printing, for numbers with the fewest digits; nlohmann's may have one more.
std::string text_of(const Json& json, const std::string& indent) {
  if (json.is_real()) return config::format_number(json.number());
  if (!json.is_array() && !json.is_object()) return json.text();
  const bool list = json.is_array();
  if (json.empty()) return list ? "[]" : "{}";

  std::string out = list ? "[" : "{";
  const char* before = "\n";
  const auto add = [&](const std::string& name, const Json& value) {
    out += before + indent + "  " + name + text_of(value, indent + "  ");
    before = ",\n";
  };
  if (list)
    for (const Json& item : json) add("", item);
  else
    for (const auto& [key, value] : json.items()) add(Json(key).text() + ": ", value);
  return out + "\n" + indent + (list ? "]" : "}");
}

}  // namespace

std::vector<MachineFault> begun_by(std::vector<MachineFault> faults, double last) {
  std::erase_if(faults, [&](const MachineFault& f) { return f.begin > last; });
  return faults;
}

void Summary::add(std::string key, double value) {
  if (!std::isfinite(value)) return;
  entries_.push_back({std::move(key), value == 0 ? 0.0 : value});  // no -0
}

const double* Summary::find(std::string_view key) const {
  for (const Entry& e : entries_)
    if (e.key == key) return &e.value;
  return nullptr;
}

namespace {

Json to_json(const std::vector<MachineFault>& faults) {
  Json out = Json::array();
  for (const MachineFault& f : faults) {
    out.push_back({{"of", f.of}, {"what", f.what}, {"begin_s", f.begin}});
    if (std::isfinite(f.end)) out.back()["end_s"] = f.end;
  }
  return out;
}

}  // namespace

std::string to_json(const Summary& summary, const Host& host) {
  Json root;
  root["format"] = "sinew.summary/1";
  root["title"] = summary.title;
  if (!summary.reproduces.empty()) root["reproduces"] = summary.reproduces;
  if (summary.cut_off) root["cut_off"] = true;
  for (const Entry& e : summary.entries()) put(root, e.key, e.value);
  if (!summary.faults.empty()) root["faults"] = to_json(summary.faults);
  if (!summary.warnings.empty()) root["warnings"] = summary.warnings;
  for (const auto& [key, value] : host.numbers)
    if (std::isfinite(value)) put(root, "host." + key, value);
  if (!host.board.empty()) root["host"]["board"] = host.board;
  if (!host.warnings.empty()) root["host"]["warnings"] = host.warnings;
  return text_of(root, "") + "\n";
}

}  // namespace sinew::analysis
