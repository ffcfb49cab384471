#include "sinew/analysis/verdict/reported.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/units/key_endings.h"
#include "sinew/units/quantity.h"

namespace sinew::analysis {

namespace {

// Sets a value by its dotted key: "a.b.c" becomes { a: { b: { c: value } } }.
void put(Json& root, std::string_view key, double value) {
  Json* at = &root;
  for (std::size_t dot; (dot = key.find('.')) != key.npos; key.remove_prefix(dot + 1))
    at = &(*at)[std::string(key.substr(0, dot))];
  (*at)[std::string(key)] = value;
}

// Prints JSON with the fewest digits for each number; nlohmann's printing may have one more.
std::string text_of(const Json& json, const std::string& indent) {
  if (json.is_real()) return units::format_number(json.number());
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
  if (std::isfinite(value))
    entries_.push_back({std::move(key), value == 0 ? 0.0 : value});  // no -0
  else
    without_value_.push_back(std::move(key));
}

const double* Summary::find(std::string_view key) const {
  for (const Entry& e : entries_)
    if (e.key == key) return &e.value;
  return nullptr;
}

bool Summary::exists(std::string_view key) const {
  return find(key) != nullptr || std::ranges::find(without_value_, key) != without_value_.end();
}

std::string nearest_key(std::string_view key, const Summary& summary) {
  if (summary.exists(key)) return "";
  std::vector<std::string_view> keys;
  for (const Entry& entry : summary.entries()) keys.push_back(entry.key);
  return std::string(config::closest(key, keys));
}

void refuse_misspelt(const std::string& key, const Summary& summary, const std::string& setting) {
  if (const std::string near = nearest_key(key, summary); !near.empty())
    config::fail({setting, 0, 0}, "", config::in_quotes(key), "a key of summary.json",
                 config::in_quotes(near));
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
  if (!summary.state_hash.empty()) root["state_hash"] = summary.state_hash;
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

namespace {

struct BandOrMistake {
  Band band;
  std::optional<units::Mistake> mistake;
};

// Returns the band of an `accept` that is not empty.
BandOrMistake read_accept(const Reported& r, double atmosphere) {
  if (r.accept.size() != 2)
    return {{},
            units::Mistake{fmt::format("{} values", r.accept.size()),
                           "two: the lowest and the highest that agrees", ""}};
  const std::string unit = unit_of_key(r.key);
  std::array<double, 2> si{};
  for (std::size_t i = 0; i < 2; ++i) {
    const units::Parsed parsed = units::parse_quantity(r.accept[i], unit, atmosphere);
    if (parsed.mistake) return {{}, parsed.mistake};
    si[i] = parsed.si;
  }
  if (si[0] > si[1])
    return {{},
            units::Mistake{fmt::format("\"{}\" before \"{}\"", r.accept[0], r.accept[1]),
                           "the lowest first", ""}};
  return {another(si[0], si[1]), std::nullopt};
}

// Returns the band that the wording's rule gives for a number, or for a share of the quantity `of`.
Band band_of(Wording wording, const QuotedNumber& value, double of, double error) {
  switch (wording) {
    case Wording::measured:
      return measured(value.highest, value.last_digit, error);
    case Wording::percentage:
      return percentage(value.highest, error);
    case Wording::about:
      return about(value.highest, error);
    case Wording::computed:
      return computed(value.highest, value.last_digit);
    case Wording::negligible:
      return negligible(of);
    case Wording::noticeable:
      return noticeable(of);
    case Wording::small:
      return small(of);
    case Wording::substantial:
      return substantial(of);
    case Wording::much_less:
      return much_less(of);
    case Wording::much_more:
      return much_more(of);
    case Wording::range:
    case Wording::another:
      break;
  }
  return range(value.lowest - error, value.highest + error);
}

bool is_share(Wording wording) {
  using enum Wording;
  return wording == negligible || wording == noticeable || wording == small ||
         wording == substantial || wording == much_less || wording == much_more;
}

// Returns the band of a wording in SI; the rule is applied in the unit of the source's text.
BandOrMistake read_wording(const Reported& r, double atmosphere) {
  const auto mistake = [](std::string found, std::string expected) {
    return BandOrMistake{{}, units::Mistake{std::move(found), std::move(expected), ""}};
  };
  const bool share = is_share(r.wording);
  const QuotedNumber value = quoted_number(share ? r.of : r.value);
  if (!value.found)
    return mistake(fmt::format("\"{}\"", share ? r.of : r.value),
                   share ? "of = a quantity: what it is a share of" : "a number in `value`");
  double error = 0;
  if (!r.reading_error.empty()) {
    const QuotedNumber read = quoted_number(r.reading_error);
    if (!read.found || read.unit != value.unit || read.highest < 0)
      return mistake(fmt::format("reading_error \"{}\"", r.reading_error),
                     fmt::format("a quantity in the unit of the value, \"{}\"", value.unit));
    error = read.highest;
  }
  if (r.wording == Wording::percentage && value.unit != "%")
    return mistake(fmt::format("\"{}\"", r.value), "a value in %");
  if (r.wording == Wording::range && value.lowest == value.highest)
    return mistake(
        fmt::format("\"{}\"", r.value),
        "two numbers with \"to\" between them, or one with below, above, at most, at least");
  Band band = band_of(r.wording, value, value.highest, error);
  for (double* end : {&band.lowest, &band.highest}) {
    if (std::isinf(*end)) continue;
    const std::string text = value.unit.empty()
                                 ? units::format_number(*end)
                                 : fmt::format("{} {}", units::format_number(*end), value.unit);
    const units::Parsed parsed = units::parse_quantity(text, unit_of_key(r.key), atmosphere);
    if (parsed.mistake)
      return mistake(fmt::format("\"{}\"", share ? r.of : r.value), parsed.mistake->expected);
    *end = parsed.si;
  }
  return {band, std::nullopt};
}

BandOrMistake read_band(const Reported& r, double atmosphere) {
  return r.accept.empty() ? read_wording(r, atmosphere) : read_accept(r, atmosphere);
}

bool is_unit(std::string_view text, const std::string& unit, double atmosphere) {
  return !units::parse_quantity(fmt::format("1 {}", text), unit, atmosphere).mistake;
}

// Returns the text after the last number: "in" of "55 to 60 in", "psi gauge" of "100 psi gauge".
std::string_view after_last_number(std::string_view text) {
  std::size_t number = text.npos;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_word = i == 0 || text[i - 1] == ' ';
    if (starts_word && std::string_view("+-.0123456789").find(text[i]) != text.npos) number = i;
  }
  if (number == text.npos) return {};
  const std::size_t end = text.find_first_not_of("+-.0123456789", number);
  const std::size_t unit = text.find_first_not_of(' ', end);
  return unit == text.npos ? std::string_view{} : text.substr(unit);
}

// Returns whether a value in `node` was set with --set.
bool has_set(const config::Node& node) {
  if (node.where.file == "--set" || (node.key == "source" && node.text == "--set")) return true;
  return std::ranges::any_of(node.children, has_set);
}

// Returns whether a key was set with --set that changes what the run measures.
bool is_changed(const config::Node& root) {
  return std::ranges::any_of(root.children, [](const config::Node& child) {
    constexpr std::string_view same[] = {"seed", "log", "page", "title"};
    return std::ranges::find(same, child.key) == std::end(same) && has_set(child);
  });
}

// Returns a band as text: "53 in to 60 in", "at most 6 in".
std::string accept_text(const Reported& r, const Band& band, const std::string& unit,
                        double atmosphere) {
  const auto number = [&](double si) {
    return units::convert(si, unit_of_key(r.key), unit, atmosphere);
  };
  // Enough digits to distinguish the ends.
  const double width = number(band.highest) - number(band.lowest);
  const double size = std::max(std::abs(number(band.lowest)), std::abs(number(band.highest)));
  int digits = 4;
  if (std::isfinite(width) && width > 0)
    digits = std::clamp(2 + static_cast<int>(std::ceil(std::log10(size / width))), 4, 9);
  const auto end = [&](double si) {
    return fmt::format("{:.{}g}{}{}", number(si), digits, unit == "1" ? "" : " ",
                       unit == "1" ? "" : unit);
  };
  if (std::isinf(band.lowest)) return "at most " + end(band.highest);
  if (std::isinf(band.highest)) return "at least " + end(band.lowest);
  return fmt::format("{} to {}", end(band.lowest), end(band.highest));
}

Verdict judge(const Summary& summary, const Reported& r, double atmosphere,
              const units::ShownUnits* shown) {
  Verdict v{.key = r.key, .reported = r.value, .computed = {}, .accept = {}, .source = r.source};
  v.statement_class = r.statement_class;
  const double* value_of_run = summary.find(r.key);
  const std::string unit = shown ? shown_unit(r.key, *shown, value_of_run ? *value_of_run : 0)
                                 : quoted_unit(r, atmosphere);
  std::optional<Band> band;
  if (config::is_judged(r)) {
    const BandOrMistake read = read_band(r, atmosphere);
    if (read.mistake) {
      const units::Mistake& m = *read.mistake;
      const char* key = r.accept.empty() ? ": wording" : ": accept";
      config::fail({"reported", 0, 0}, r.key + key, m.found, m.expected, m.try_this);
    }
    band = read.band;
    v.accept = !shown && !r.accept.empty() ? fmt::format("{} to {}", r.accept[0], r.accept[1])
                                           : accept_text(r, *band, unit, atmosphere);
    v.wording = band->wording;
    v.band_reason = r.band_reason;
  }

  if (!value_of_run) return v;
  // A narrow band requires more digits.
  const auto quoted_unit_in = [&](double si) {
    return units::convert(si, unit_of_key(r.key), unit, atmosphere);
  };
  const double width = band ? quoted_unit_in(band->highest) - quoted_unit_in(band->lowest) : 0;
  v.computed = show(*value_of_run, r.key, unit, atmosphere, std::isfinite(width) ? width : 0);
  if (!band || r.changed) return v;
  const bool inside = band->holds(*value_of_run);
  v.agreement = inside ? Verdict::Agreement::agrees : Verdict::Agreement::differs;
  if (r.because.empty()) return v;
  v.agreement =
      inside ? Verdict::Agreement::agrees_unexpectedly : Verdict::Agreement::differs_as_known;
  v.source += ". Why: " + r.because;
  return v;
}

}  // namespace

std::string quoted_unit(const Reported& r, double atmosphere) {
  const std::string unit = unit_of_key(r.key);
  std::string_view text = after_last_number(r.value);
  if (!text.empty() && is_unit(text, unit, atmosphere)) return std::string(text);
  for (const std::string& other : {r.of, r.accept.empty() ? std::string() : r.accept.back()}) {
    text = after_last_number(other);
    if (!text.empty() && is_unit(text, unit, atmosphere)) return std::string(text);
  }
  return unit;
}

std::string unit_of_key(std::string_view key) {
  for (const auto& [ending, unit] : units::key_endings)
    if (key.ends_with(ending)) return std::string(unit);
  return "1";
}

std::string_view without_unit(std::string_view key) {
  for (const auto& [ending, unit] : units::key_endings)
    if (key.ends_with(ending)) return key.substr(0, key.size() - ending.size());
  return key;
}

std::optional<units::Mistake> mistake_in_band(const Reported& r, double atmosphere) {
  if (!config::is_judged(r)) return std::nullopt;
  return read_band(r, atmosphere).mistake;
}

void mark_changed(std::vector<Reported>& reported, const config::Node& root) {
  const bool changed = is_changed(root);
  for (Reported& r : reported) r.changed = changed;
}

std::string_view to_text(Verdict::Agreement agreement) {
  switch (agreement) {
    case Verdict::Agreement::agrees:
      return "agrees";
    case Verdict::Agreement::differs:
      return "differs";
    case Verdict::Agreement::differs_as_known:
      return "differs as known";
    case Verdict::Agreement::agrees_unexpectedly:
      return "agrees after all";
    case Verdict::Agreement::not_applicable:
      break;
  }
  return "not applicable";
}

std::vector<Verdict> compare(const Summary& summary, const std::vector<Reported>& reported,
                             double atmosphere, const units::ShownUnits* shown) {
  std::vector<Verdict> out;
  for (const Reported& r : reported) out.push_back(judge(summary, r, atmosphere, shown));
  return out;
}

std::string shown_unit(std::string_view key, const units::ShownUnits& shown, double value) {
  const std::string unit = unit_of_key(key);
  const bool share = key.find("share") != key.npos || key.find("passiveness") != key.npos ||
                     key.find("duty") != key.npos;
  if (unit == "1") return share ? "%" : unit;
  // Pressures of a summary are absolute; every set of units has a unit for these.
  const std::string_view held = unit == "Pa abs" ? "Pa" : std::string_view(unit);
  const units::ShownUnit usual = shown.of(held);
  return usual.scale * std::abs(value) < 1000 ? usual.name : shown.of(held, std::abs(value)).name;
}

std::string show(double si, std::string_view key, std::string_view unit, double atmosphere,
                 double resolution) {
  const double number = units::convert(si, unit_of_key(key), unit, atmosphere);
  const double size = std::abs(number);
  const int wanted = resolution > 0 ? static_cast<int>(std::ceil(-std::log10(resolution))) : 0;
  std::string text;
  if (size < 1e-9) {
    text = "0";  // rounding of the conversion
  } else if (size < 0.95) {
    const int digits = wanted + 1 + static_cast<int>(std::floor(std::log10(size)));
    text = fmt::format("{:.{}g}", number, std::clamp(digits, 2, 9));
  } else {
    text = fmt::format("{:.{}f}", number, std::clamp(wanted, size < 1000 ? 1 : 0, 9));
  }
  return unit == "1" ? text : fmt::format("{} {}", text, unit);
}

}  // namespace sinew::analysis
