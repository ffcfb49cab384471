#include "sinew/report/gallery.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sinew/report/gallery_style.h"
#include "sinew/report/html.h"

namespace sinew::report {
namespace {

using Json = nlohmann::ordered_json;

bool holds_kind(const Figure& figure, Curve::Kind kind) {
  for (const Plot& plot : figure.plots)
    for (const Curve& curve : plot.curves)
      if (curve.kind == kind) return true;
  return false;
}

// What the page's choice looks for.
std::string properties(const Exhibit& e) {
  Tally t;
  count(t, e.claims);
  std::vector<std::string_view> out;
  if (t.agree > 0) out.push_back("agrees");
  if (t.as_put_in > 0) out.push_back("put_in");
  if (t.differ + t.differ_as_known > 0) out.push_back("differs");
  if (t.not_comparable > 0) out.push_back("open");
  if (holds_kind(e.figure, Curve::Kind::computed)) out.push_back("computed");
  if (holds_kind(e.figure, Curve::Kind::synthetic)) out.push_back("synthetic");
  if (!e.figure.missing.empty()) out.push_back("unavailable");
  return fmt::format("{}", fmt::join(out, ","));
}

class Page {
 public:
  explicit Page(const Gallery& gallery) : gallery_(gallery), claims_(total(tally(gallery)) > 0) {}
  std::string text();

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> format, Parts&&... parts) {
    out_ += fmt::format(format, std::forward<Parts>(parts)...) + '\n';
  }
  void head();
  void bar();
  void exhibit(const Exhibit& e);
  void files(const Figure& figure, const FigureData& data);
  void picture(const Exhibit& e);
  void claims(const std::vector<Claim>& claims);
  void claim(const Claim& c);
  void curves(const Figure& figure);

  const Gallery& gallery_;
  bool claims_;  // are there any? Else figures stand side by side
  std::string out_;
};

void Page::head() {
  add("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">");
  add("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">");
  add("<title>{}</title>\n<style>{}</style>\n</head>\n<body>", escaped(gallery_.title),
      gallery_style);
  add("<header>\n<h1>{}</h1>", escaped(gallery_.title));
  if (!gallery_.lead.empty()) add("<p class=\"lead\">{}</p>", escaped(gallery_.lead));
  const Tally t = tally(gallery_);
  if (claims_) {
    add("<ul class=\"tally\">");
    add("<li><b>{}</b><span>figures</span></li>", gallery_.exhibits.size());
    add("<li><b class=\"agrees\">{}</b><span>statements agree</span></li>", t.agree);
    add("<li><b>{}</b><span>are as put in</span></li>", t.as_put_in);
    add("<li><b class=\"differs\">{}</b><span>differ</span></li>", t.differ);
    add("<li><b class=\"known\">{}</b><span>differ, as known</span></li>", t.differ_as_known);
    add("<li><b>{}</b><span>cannot be compared</span></li>", t.not_comparable);
    add("</ul>");
  }
  add("</header>");
}

void Page::bar() {
  add("<div class=\"bar\"><div>\n<nav aria-label=\"figures\">");
  for (const Exhibit& e : gallery_.exhibits)
    add("<a href=\"#{0}\">{0}</a>", escaped(e.figure.name));
  add("</nav>");
  if (claims_)
    add("<label hidden>show <select id=\"choice\"><option value=\"\">all</option>"
        "<option value=\"differs\">what differs</option><option value=\"agrees\">what "
        "agrees</option><option value=\"put_in\">what is as put in</option>"
        "<option value=\"open\">what cannot be compared</option>"
        "<option value=\"computed\">computed curves</option>"
        "<option value=\"synthetic\">synthetic curves</option>"
        "<option value=\"unavailable\">what is lost</option></select></label>");
  add("</div></div>");
}

void Page::files(const Figure& figure, const FigureData& data) {
  add("<div class=\"files\">");
  for (const std::string& ending : gallery_.pictures)
    add("<a href=\"{}.{}\">{}</a>", escaped(figure.name), escaped(ending), escaped(ending));
  if (gallery_.scripts) add("<a href=\"{0}.gp\">gp</a>", escaped(figure.name));
  for (const Sheet& sheet : data.sheets)
    add("<a href=\"{0}.csv\">{0}.csv</a>", escaped(sheet.name));
  add("</div>");
}

void Page::picture(const Exhibit& e) {
  add("<figure>");
  if (!gallery_.pictures.empty())
    add("<a href=\"{0}.{1}\"><img src=\"{0}.{1}\" alt=\"{2}\"></a>", escaped(e.figure.name),
        escaped(gallery_.pictures.front()), escaped(e.figure.title));
  add("<figcaption>{}</figcaption>", escaped(e.figure.caption));
  add("</figure>");
}

std::string_view class_of(const Claim& c) {
  if (c.verdict == Is::agrees) return c.put_in ? "open" : "agrees";
  if (c.verdict == Is::not_applicable) return "open";
  return c.verdict == Is::differs_as_known ? "known" : "differs";
}

// "4.3" is a section, "table 4-1" says what it is.
std::string in_words(const std::string& where) {
  return where.empty() || where[0] < '0' || where[0] > '9' ? where : "section " + where;
}

void Page::claim(const Claim& c) {
  add("<div class=\"claim\">\n<div class=\"says\"><div>{} <span class=\"where\">{}</span></div>"
      "<span class=\"verdict {}\">{}</span></div>",
      escaped(c.says.empty() ? c.quantity : c.says), escaped(in_words(c.where)), class_of(c),
      word(c));
  std::string numbers;
  const auto number = [&](std::string_view what, const std::string& value) {
    if (!value.empty()) numbers += fmt::format("<span>{} <b>{}</b></span>", what, escaped(value));
  };
  number("stated", c.theirs);
  number("ours", c.ours);
  if (!numbers.empty()) add("<div class=\"numbers\">{}</div>", numbers);
  std::string rest = c.says.empty() ? "" : c.quantity;
  if (!c.accept.empty()) rest += (rest.empty() ? "accepted " : "; accepted ") + c.accept;
  if (!c.why.empty()) rest += (rest.empty() ? "" : ": ") + c.why;
  if (!rest.empty()) add("<p class=\"why\">{}</p>", escaped(rest));
  add("</div>");
}

void Page::claims(const std::vector<Claim>& claims) {
  for (const Claim& c : claims) claim(c);
}

// Curves of one kind and one source in one line.
void Page::curves(const Figure& figure) {
  struct Group {
    Curve::Kind kind;
    std::string source, labels;
  };
  std::vector<Group> groups;
  for (const Plot& plot : figure.plots)
    for (const Curve& c : plot.curves) {
      const std::string& name = c.label.empty() ? plot.y.name : c.label;
      if (groups.empty() || groups.back().kind != c.kind || groups.back().source != c.source)
        groups.push_back({c.kind, c.source, name});
      else if ((", " + groups.back().labels + ",").find(", " + name + ",") == std::string::npos)
        groups.back().labels += ", " + name;
    }
  add("<h3>Curves</h3>\n<ul class=\"curves\">");
  for (const Group& g : groups)
    add("<li><b>{}</b> {}: <span class=\"quiet\">{}</span></li>", to_text(g.kind),
        escaped(g.labels), escaped(g.source));
  for (const Missing& m : figure.missing)
    add("<li><b>not drawn</b> {}: <span class=\"quiet\">{}</span></li>", escaped(m.what),
        escaped(m.why));
  add("</ul>");
}

void Page::exhibit(const Exhibit& e) {
  const Figure& figure = e.figure;
  add("<article id=\"{}\" data-is=\"{}\">\n<div class=\"head\"><h2>", escaped(figure.name),
      properties(e));
  if (!gallery_.prefix.empty())
    add("<span class=\"number\">{}{}</span>", escaped(gallery_.prefix), escaped(figure.name));
  add("{}</h2>", escaped(figure.title));
  files(figure, data(figure));
  add("</div>");
  picture(e);
  add("<div>");
  claims(e.claims);
  curves(figure);
  add("</div>\n</article>");
}

std::string Page::text() {
  head();
  bar();
  add("<main{}>", claims_ ? "" : " class=\"sheet\"");
  for (const Exhibit& e : gallery_.exhibits) exhibit(e);
  add("</main>\n<script>{}</script>\n</body>\n</html>", gallery_script);
  return out_;
}

Json json_of(const Claim& c) {
  Json out{{"verdict", word(c)}, {"where", c.where}};
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) out[key] = value;
  };
  add("says", c.says);
  add("theirs", c.theirs);
  add("quantity", c.quantity);
  add("ours", c.ours);
  add("accepted", c.accept);
  add("why", c.why);
  return out;
}

Json json_of(const Exhibit& e, const Gallery& gallery) {
  const Figure& figure = e.figure;
  Json out{{"figure", figure.name}, {"title", figure.title}, {"caption", figure.caption}};
  for (const std::string& ending : gallery.pictures) out[ending] = figure.name + "." + ending;
  if (gallery.scripts) out["script"] = figure.name + ".gp";
  const FigureData numbers = data(figure);
  out["curves"] = Json::array();
  for (std::size_t p = 0; p < figure.plots.size(); ++p)
    for (std::size_t c = 0; c < figure.plots[p].curves.size(); ++c) {
      const Curve& curve = figure.plots[p].curves[c];
      const Place place = numbers.places[p][c];
      const Sheet& sheet = numbers.sheets[place.sheet];
      out["curves"].push_back(
          {{"curve", curve.label.empty() ? figure.plots[p].y.name : curve.label},
           {"kind", to_text(curve.kind)},
           {"source", curve.source},
           {"file", sheet.name + ".csv"},
           {"x", sheet.headings[0]},
           {"y", sheet.headings[place.column]}});
    }
  for (const Missing& m : figure.missing)
    out["curves"].push_back({{"curve", m.what}, {"kind", "unavailable"}, {"source", m.why}});
  if (!e.claims.empty()) out["claims"] = Json::array();
  for (const Claim& c : e.claims) out["claims"].push_back(json_of(c));
  return out;
}

}  // namespace

std::string index_html(const Gallery& gallery) { return Page(gallery).text(); }

std::string index_json(const Gallery& gallery) {
  Json out{{"format", "sinew.figures/1"}, {"title", gallery.title}, {"page", "index.html"}};
  const Tally t = tally(gallery);
  if (total(t) > 0)
    out["verdicts"] = {{"agrees", t.agree},
                       {"as put in", t.as_put_in},
                       {"differs", t.differ},
                       {"differs, as known", t.differ_as_known},
                       {"not comparable", t.not_comparable}};
  out["figures"] = Json::array();
  for (const Exhibit& e : gallery.exhibits) out["figures"].push_back(json_of(e, gallery));
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Tally tally(const Gallery& gallery) {
  Tally out;
  for (const Exhibit& e : gallery.exhibits) count(out, e.claims);
  return out;
}

}  // namespace sinew::report
