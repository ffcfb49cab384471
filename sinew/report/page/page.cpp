#include "sinew/report/page/page.h"

#include <algorithm>
#include <stdexcept>

#include "sinew/config/utf8.h"
#include "sinew/report/page/content.h"

namespace sinew::report {

namespace {

// Escapes JSON, which then cannot end its script element.
std::string script_safe(std::string_view json) {
  std::string out;
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace

bool has_page() { return !page_template().empty(); }

void require_page(std::string_view file) {
  if (has_page()) return;
  throw std::runtime_error(
      std::string(file) +
      ": this sinew was built without its page, which npm bundles; try: install npm, then run npm "
      "ci in web/ and build again");
}

std::string page(const Run& run) {
  require_page("report.html");
  return fill(page_template(), content(run));
}

std::string fill(std::string_view page_template, const Content& content) {
  struct Place {
    std::string_view mark;
    std::string text;
    std::size_t at = 0;
  };
  std::vector<Place> places = {{"@title@", escaped(content.title)},
                               {"@run@", script_safe(content.json)},
                               {"@samples@", content.samples}};
  constexpr std::string_view connect = "@connect@", units = "@units@";
  if (page_template.find(units) != page_template.npos)
    places.push_back({units, script_safe(content.units.empty() ? units_json() : content.units)});
  if (!content.connect.empty() || page_template.find(connect) != page_template.npos)
    places.push_back({connect, content.connect});
  std::size_t size = page_template.size();
  for (Place& p : places) {
    p.at = page_template.find(p.mark);
    if (p.at == page_template.npos)
      throw std::invalid_argument("a page's template without " + std::string(p.mark));
    size += p.text.size();
  }
  std::ranges::sort(places, {}, &Place::at);

  std::string out;
  out.reserve(size);
  std::size_t from = 0;
  for (const Place& p : places) {
    out += page_template.substr(from, p.at - from);
    out += p.text;
    from = p.at + p.mark.size();
  }
  out += page_template.substr(from);
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : config::in_utf8(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string page(const DesignPage& design) {
  require_page("the page");
  const Channels none;
  Blob blob;
  Columns columns(none, blob);
  Json out = {
      {"format", "sinew.design_page/1"}, {"title", design.title}, {"version", design.version}};
  out["atmosphere"] = design.atmosphere;
  out["values"] = design.values;
  out["tables"] = design.tables;
  out["charts"] = charts_json(design.plots, columns);
  out["refused"] = design.refused;
  out["notes"] = design.notes;
  out["warnings"] = design.warnings;
  out["unseen"] = design.unseen;
  return fill(design_template(), {design.title, out.text(), ""});
}

}  // namespace sinew::report
