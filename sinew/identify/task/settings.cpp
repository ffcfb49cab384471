#include "sinew/identify/task/settings.h"

#include <algorithm>
#include <filesystem>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"

namespace sinew::identify {

std::vector<Source> sources_of(const std::vector<std::string>& files, const Source& how) {
  std::vector<Source> out;
  for (const std::string& file : files) {
    if (std::ranges::count(files, file) > 1)
      config::fail({"data", 0, 0}, "", file + " twice", "each file once");
    out.push_back(how);
    out.back().path = file;
  }
  return out;
}

const Source& only_of(const std::vector<Source>& sources) {
  if (sources.size() != 1)
    config::fail({"data", 0, 0}, "", std::to_string(sources.size()) + " files", "one");
  return sources.front();
}

void refuse_fitted(const std::vector<Source>& sources, std::string_view setting,
                   const std::string& file) {
  std::error_code none;  // missing files are reported elsewhere
  for (const Source& source : sources)
    if (!source.text && std::filesystem::equivalent(file, source.path, none))
      config::fail({std::string(setting), 0, 0}, "", config::in_quotes(file),
                   "another file than those that are fitted");
}

std::string source_words(std::string_view method, const std::vector<Source>& sources,
                         std::string_view law) {
  std::string out = "sinew identify " + std::string(method);
  for (const Source& source : sources) out += " " + source.path;
  return out + ": " + std::string(law);
}

std::vector<std::string> words_of(const std::vector<Source>& sources) {
  std::vector<std::string> out;
  for (const Source& source : sources) out.push_back(source.path);
  if (sources.empty()) return out;
  const Source& how = sources.front();
  for (const auto& [name, theirs] : how.names) out.push_back("column " + name + "=" + theirs);
  for (const auto& [name, unit] : how.units) out.push_back("unit " + name + "=" + unit);
  for (const auto& [name, values] : how.where)
    out.push_back("only rows with " + name + "=" + values);
  for (const std::string& value : how.values) out.push_back("value " + value);
  for (const auto& [name, offset] : how.offsets) out.push_back("added to " + name + ": " + offset);
  std::string header;
  for (const std::string& column : how.columns) header += (header.empty() ? "" : ",") + column;
  if (!header.empty()) out.push_back("header " + header);
  if (how.drop_incomplete) out.emplace_back("incomplete rows left out");
  for (const auto& [what, is] : {std::pair{"encoding ", &how.encoding},
                                 {"decimal mark ", &how.decimal},
                                 {"thousands parted by ", &how.thousands},
                                 {"dates: ", &how.dates},
                                 {"rate ", &how.rate}})
    if (!is->empty()) out.push_back(what + (*is == " " ? "blanks" : *is));
  if (how.part != 0) out.push_back("recording " + std::to_string(how.part) + " of the file");
  if (how.spread_times) out.emplace_back("rows that share a time spread evenly");
  return out;
}

double atmosphere_setting(const std::string& text) {
  return config::quantity_setting("atmosphere", text + " abs", "Pa abs", units::atmosphere,
                                  config::air_pressure);
}

namespace {

// Returns the tables that are held out, which may be sources.
std::vector<Source> named_tables(const HeldOut& hold_out, const std::vector<Source>& sources,
                                 std::span<const std::string_view> words) {
  std::vector<Source> out = hold_out.tables;
  for (const std::string& text : hold_out.texts) {
    if (std::ranges::find(words, text) != words.end()) continue;
    out.push_back(sources.front());
    out.back().path = text;
    out.back().text.reset();
  }
  return out;
}

}  // namespace

std::vector<Source> held_out_tables(const HeldOut& hold_out, const std::vector<Source>& sources,
                                    std::span<const std::string_view> words) {
  for (const std::string& text : hold_out.texts)
    if (std::ranges::find(words, text) == words.end()) refuse_fitted(sources, "hold_out", text);
  return named_tables(hold_out, sources, words);
}

std::vector<MarkedSource> marked_tables(const HeldOut& hold_out,
                                        const std::vector<Source>& sources) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  std::vector<MarkedSource> out;
  for (const Source& source : sources) out.push_back({source});
  for (const Source& other : named_tables(hold_out, sources, {})) {
    const auto same = [&](const MarkedSource& m) { return m.source.path == other.path; };
    if (std::ranges::none_of(out, same)) out.push_back({other});
    for (MarkedSource& m : out) m.held_out |= same(m);
  }
  return out;
}

}  // namespace sinew::identify
