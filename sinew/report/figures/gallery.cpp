#include "sinew/report/figures/gallery.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "sinew/report/page/page.h"
#include "sinew/report/text/text_table.h"

namespace sinew::report {

namespace {

// Formats a number with three digits, or more if the band is narrow.
std::string number(double value, const Band& band) {
  const double width = band.highest - band.lowest;
  if (value == 0 || (std::isfinite(width) && std::fabs(value) < 1e-5 * width)) return "0";
  const int size = static_cast<int>(std::floor(std::log10(std::fabs(value))));
  int digits = 3;
  if (std::isfinite(width) && width > 0)
    digits = size - static_cast<int>(std::floor(std::log10(width))) + 2;
  if (size < 7) digits = std::max(digits, size + 1);  // 1000, no 1e+03
  std::string text = fmt::format("{:.{}g}", value, std::clamp(digits, 3, 7));
  return text.find('e') == text.npos ? text : fmt::format("{:.2g}", value);
}

std::string with_unit(std::string text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

std::string band_text(const Band& b, const std::string& unit) {
  const auto end = [](double x) { return fmt::format("{:.6g}", x); };
  if (std::isinf(b.lowest) && std::isinf(b.highest)) return "";
  if (std::isinf(b.lowest)) return with_unit("at most " + end(b.highest), unit);
  if (std::isinf(b.highest)) return with_unit("at least " + end(b.lowest), unit);
  return with_unit(fmt::format("{} to {}", end(b.lowest), end(b.highest)), unit);
}

}  // namespace

Claim judge(StatementClass statement_class, const Measured& m) {
  if (m.accept.wording == analysis::Wording::another && m.why.empty())
    throw std::logic_error("a band of our own without its reason: " + m.says);
  Claim c{.where = m.where, .says = m.says, .reported = m.reported, .quantity = m.quantity};
  c.computed = std::isfinite(m.computed) ? with_unit(number(m.computed, m.accept), m.unit) : "none";
  c.accept = band_text(m.accept, m.unit);
  c.why = m.why;
  c.statement_class = statement_class;
  c.wording = m.accept.wording;
  const bool inside = m.accept.holds(m.computed);
  c.verdict = inside ? Agreement::agrees : Agreement::differs;
  if (m.because.empty()) return c;
  c.verdict = inside ? Agreement::agrees_unexpectedly : Agreement::differs_as_known;
  c.why += fmt::format("{}Known to differ: {}", c.why.empty() ? "" : ". ", m.because);
  return c;
}

Claim not_applicable(std::string where, std::string says, std::string reported, std::string why) {
  return {.where = std::move(where),
          .says = std::move(says),
          .reported = std::move(reported),
          .quantity = {},
          .computed = {},
          .accept = {},
          .why = std::move(why)};
}

Claim claim(const analysis::Verdict& v) {
  Claim out{.where = v.source,
            .says = {},
            .reported = v.reported,
            .quantity = v.key,
            .computed = v.computed,
            .accept = v.accept,
            .why = v.band_reason,
            .verdict = v.agreement,
            .statement_class = v.statement_class,
            .wording = v.wording};
  // The source of a verdict ends with the reason of a known difference.
  constexpr std::string_view mark = ". Why: ";
  if (const std::size_t at = out.where.find(mark); at != out.where.npos) {
    out.why +=
        (out.why.empty() ? "" : ". ") + ("Known to differ: " + out.where.substr(at + mark.size()));
    out.where.resize(at);
  }
  return out;
}

void count(Tally& tally, const std::vector<Claim>& claims) {
  for (const Claim& c : claims) tally.add(c.statement_class, c.verdict);
}

int Tally::of(Agreement verdict) const {
  int sum = 0;
  for (const StatementClass c : all_classes) sum += of(c, verdict);
  return sum;
}

int Tally::of(StatementClass statement_class) const {
  int sum = 0;
  for (const Agreement v : all_verdicts) sum += of(statement_class, v);
  return sum;
}

int Tally::total() const {
  int sum = 0;
  for (const Agreement v : all_verdicts) sum += of(v);
  return sum;
}

namespace {

// --- style of the page of figures; colors as in web/src/style.css ---

constexpr std::string_view gallery_style = R"css(
:root { color-scheme: light; --paper: #fff; --back: #f5f6f8; --ink: #1c2430; --quiet: #5d6878;
  --edge: #dfe3e9; --accent: #0b63b5; --good: #0a7a58; --bad: #b3401a; --known: #7a5c00; }
@media (prefers-color-scheme: dark) { :root { color-scheme: dark; --paper: #161b22; --back: #0e1217;
  --ink: #e4e9f0; --quiet: #93a0b1; --edge: #2b333e; --accent: #5fb0f2; --good: #46c79c;
  --bad: #f08a5d; --known: #d6bd62; } }
* { box-sizing: border-box; }
html { scroll-padding-top: 84px; }
body { margin: 0; background: var(--back); color: var(--ink); font: 15px/1.5 system-ui, -apple-system,
  'Segoe UI', Roboto, 'Helvetica Neue', 'DejaVu Sans', Arial, sans-serif;
  font-variant-numeric: tabular-nums; }
a { color: var(--accent); text-decoration: none; }
a:hover { text-decoration: underline; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
header, main { max-width: 1240px; margin: 0 auto; padding: 0 28px; }
header { padding-top: 34px; }
h1 { margin: 0 0 6px; font-size: 28px; line-height: 1.2; font-weight: 650; letter-spacing: -.01em; }
h2 { margin: 0; font-size: 18px; line-height: 1.3; font-weight: 650; }
h2 .number { margin-right: .6em; color: var(--quiet); font-weight: 500; }
h3 { margin: 20px 0 4px; font-size: 12px; font-weight: 600; color: var(--quiet); }
p { margin: 0; }
.lead { max-width: 74ch; color: var(--quiet); }
.tally { margin: 20px 0 12px; border-collapse: collapse; font-size: 14px; }
.tally caption { padding-bottom: 6px; text-align: left; color: var(--quiet); font-size: 13px; }
.tally th, .tally td { padding: 3px 0 3px 26px; text-align: right; }
.tally tbody th { padding-left: 0; text-align: left; font-weight: 500; }
.tally thead th { font-size: 13px; font-weight: 600; }
.tally tbody tr { border-top: 1px solid var(--edge); }
.tally tbody tr:last-child, .tally td:last-child { font-weight: 650; }
.bar { position: sticky; top: 0; z-index: 1; background: var(--back); border-bottom: 1px solid var(--edge); }
.bar > div { display: flex; flex-wrap: wrap; gap: 6px 14px; align-items: center; max-width: 1240px;
  margin: 0 auto; padding: 9px 28px; font-size: 13px; }
.bar nav { display: flex; flex-wrap: wrap; gap: 2px 11px; }
.bar label { color: var(--quiet); }
select { font: inherit; color: inherit; padding: 3px 8px; border: 1px solid var(--edge);
  border-radius: 7px; background: var(--paper); }
article { display: grid; grid-template-columns: minmax(0, 5fr) minmax(0, 7fr); gap: 4px 34px;
  margin: 22px 0; padding: 22px 24px 24px; border: 1px solid var(--edge); border-radius: 12px;
  background: var(--paper); }
article[hidden] { display: none; }
.head { grid-column: 1 / -1; display: flex; flex-wrap: wrap; gap: 4px 18px; align-items: baseline;
  justify-content: space-between; margin-bottom: 12px; }
.files { display: flex; flex-wrap: wrap; gap: 2px 12px; font-size: 13px; }
figure { margin: 0; position: sticky; top: 78px; align-self: start; }
figure img { display: block; width: 100%; height: auto; padding: 10px; border-radius: 8px; background: #fff; }
figcaption { margin-top: 10px; color: var(--quiet); font-size: 14px; }
dl { margin: 0; }
.claim { padding: 11px 0; border-top: 1px solid var(--edge); }
.claim:first-of-type { padding-top: 0; border-top: 0; }
.says { display: flex; gap: 14px; justify-content: space-between; align-items: baseline; }
.where { color: var(--quiet); font-size: 13px; }
.judged { flex: none; font-size: 13px; white-space: nowrap; }
.verdict { margin-left: 10px; font-weight: 650; }
.class { color: var(--quiet); }
.agrees { color: var(--good); } .differs { color: var(--bad); }
.known { color: var(--known); } .open { color: var(--quiet); font-weight: 500; }
.numbers { display: flex; flex-wrap: wrap; gap: 0 22px; margin-top: 3px; font-size: 14px; }
.numbers span { color: var(--quiet); } .numbers b { color: var(--ink); font-weight: 600; }
.why { color: var(--quiet); font-size: 13px; }
.curves { margin: 0; padding: 0; list-style: none; font-size: 13px; }
.curves li { padding: 2px 0; overflow-wrap: anywhere; }
.curves b { font-weight: 600; }
.curves .quiet { color: var(--quiet); }
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 400px), 1fr)); gap: 18px; padding-top: 18px; }
.sheet article { display: block; margin: 0; }
.sheet figure { position: static; }
@media screen and (max-width: 860px) { article { grid-template-columns: minmax(0, 1fr); padding: 16px; }
  header, main { padding: 0 14px; } header { padding-top: 22px; } .bar > div { padding: 8px 14px; }
  .bar, figure { position: static; } html { scroll-padding-top: 8px; } figure { margin-bottom: 14px; }
  .says { flex-wrap: wrap; gap: 2px 12px; } .tally { display: block; overflow-x: auto; font-size: 12px; }
  .tally th, .tally td { padding-left: 10px; } }
@media print { :root { color-scheme: light; --paper: #fff; --back: #fff; --ink: #000; --quiet: #444;
  --edge: #bbb; --accent: #000; --good: #0a7a58; --bad: #b3401a; --known: #7a5c00; }
  body, .numbers, .verdict { font-size: 9pt; } figcaption, .where, .why, .curves { font-size: 8pt; }
  header, main { padding: 0; } figure { position: static; } .bar, .files { display: none; }
  article { break-inside: avoid; border-width: 1px 0 0; border-radius: 0; padding: 10pt 0; margin: 0; gap: 2pt 18pt; }
  .claim { padding: 5pt 0; } figure img { padding: 0; } }
)css";

// Shows the chosen figures.
constexpr std::string_view gallery_script = R"js(
const choice = document.getElementById('choice');
if (choice) {
  choice.parentElement.hidden = false;
  choice.addEventListener('change', () => {
    for (const a of document.querySelectorAll('article'))
      a.hidden = choice.value !== '' && !a.dataset.is.split(',').includes(choice.value);
  });
}
document.documentElement.dataset.ready = '';
)js";

bool holds_kind(const Figure& figure, Curve::Kind kind) {
  for (const Plot& plot : figure.plots)
    for (const Curve& curve : plot.curves)
      if (curve.kind == kind) return true;
  return false;
}

// Returns the name of a class in the page.
std::string_view name_of(StatementClass c) {
  constexpr std::string_view names[] = {"none",   "predicted",       "fitted",
                                        "put_in", "by_construction", "code_against_code"};
  return names[static_cast<std::size_t>(c)];
}

std::string_view class_of(Agreement verdict) {
  if (verdict == Agreement::agrees) return "agrees";
  if (verdict == Agreement::not_applicable) return "open";
  return verdict == Agreement::differs_as_known ? "known" : "differs";
}

// Returns the properties by which the page filters figures.
std::string properties(const Exhibit& e) {
  Tally t;
  count(t, e.claims);
  std::vector<std::string_view> out;
  if (t.of(Agreement::agrees) > 0) out.push_back("agrees");
  if (t.of(Agreement::differs) + t.of(Agreement::differs_as_known) +
          t.of(Agreement::agrees_unexpectedly) >
      0)
    out.push_back("differs");
  if (t.of(Agreement::not_applicable) > 0) out.push_back("open");
  for (const StatementClass c : all_classes)
    if (c != StatementClass::none && t.of(c) > 0) out.push_back(name_of(c));
  if (holds_kind(e.figure, Curve::Kind::computed)) out.push_back("computed");
  if (holds_kind(e.figure, Curve::Kind::synthetic)) out.push_back("synthetic");
  if (!e.figure.missing.empty()) out.push_back("unavailable");
  return fmt::format("{}", fmt::join(out, ","));
}

class Page {
 public:
  explicit Page(const Gallery& gallery) : gallery_(gallery), claims_(tally(gallery).total() > 0) {}
  std::string text();

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> format, Parts&&... parts) {
    out_ += fmt::format(format, std::forward<Parts>(parts)...) + '\n';
  }
  void head();
  void tally_table();
  void bar();
  void exhibit(const Exhibit& e);
  void files(const Figure& figure, const FigureData& data);
  void picture(const Exhibit& e);
  void claims(const std::vector<Claim>& claims);
  void claim(const Claim& c);
  void curves(const Figure& figure);

  const Gallery& gallery_;
  bool claims_;  // whether a figure has claims; otherwise figures are shown side by side
  std::string out_;
};

void Page::head() {
  add("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">");
  add("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">");
  add("<title>{}</title>\n<style>{}</style>\n</head>\n<body>", escaped(gallery_.title),
      gallery_style);
  add("<header>\n<h1>{}</h1>", escaped(gallery_.title));
  if (!gallery_.lead.empty()) add("<p class=\"lead\">{}</p>", escaped(gallery_.lead));
  if (claims_) tally_table();
  add("</header>");
}

// Adds the verdicts by class, the strongest evidence first.
void Page::tally_table() {
  const Tally t = tally(gallery_);
  add("<table class=\"tally\">\n<caption>{} statements about {} "
      "figures</caption>\n<thead><tr><td></td>",
      t.total(), gallery_.exhibits.size());
  for (const Agreement v : all_verdicts)
    add("<th scope=\"col\" class=\"{}\">{}</th>", class_of(v), to_text(v));
  add("<th scope=\"col\">all</th></tr></thead>\n<tbody>");
  const auto row = [&](std::string_view name, auto of, int all) {
    add("<tr><th scope=\"row\">{}</th>", name);
    for (const Agreement v : all_verdicts) {
      const int n = of(v);
      add("<td>{}</td>", n > 0 ? std::to_string(n) : std::string());
    }
    add("<td>{}</td></tr>", all);
  };
  for (const StatementClass c : all_classes)
    if (t.of(c) > 0)
      row(
          c == StatementClass::none ? "not compared" : to_text(c),
          [&](Agreement v) { return t.of(c, v); }, t.of(c));
  row(
      "all", [&](Agreement v) { return t.of(v); }, t.total());
  add("</tbody>\n</table>");
}

void Page::bar() {
  add("<div class=\"bar\"><div>\n<nav aria-label=\"figures\">");
  for (const Exhibit& e : gallery_.exhibits)
    add("<a href=\"#{0}\">{0}</a>", escaped(e.figure.name));
  add("</nav>");
  if (claims_)
    add("<label hidden>show <select id=\"choice\"><option value=\"\">all</option>"
        "<option value=\"differs\">what differs</option><option value=\"agrees\">what "
        "agrees</option><option value=\"open\">what cannot be compared</option>"
        "<option value=\"predicted\">what is predicted</option>"
        "<option value=\"fitted\">what was fitted</option>"
        "<option value=\"put_in\">what was put in</option>"
        "<option value=\"by_construction\">what is true by construction</option>"
        "<option value=\"code_against_code\">code against code</option>"
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

// Adds the picture. A browser does not show a PDF as an image: such figures are linked only.
void Page::picture(const Exhibit& e) {
  add("<figure>");
  const auto shown = std::ranges::find_if(
      gallery_.pictures, [](const std::string& ending) { return ending != "pdf"; });
  if (shown != gallery_.pictures.end())
    add("<a href=\"{0}.{1}\"><img src=\"{0}.{1}\" alt=\"{2}\"></a>", escaped(e.figure.name),
        escaped(*shown), escaped(e.figure.title));
  add("<figcaption>{}</figcaption>", escaped(e.figure.caption));
  add("</figure>");
}

// Returns "section 4.3" for "4.3"; "table 4-1" stays as it is.
std::string section_text(const std::string& where) {
  return where.empty() || where[0] < '0' || where[0] > '9' ? where : "section " + where;
}

void Page::claim(const Claim& c) {
  add("<div class=\"claim\">\n<div class=\"says\"><div>{} <span class=\"where\">{}</span></div>"
      "<span class=\"judged\"><span class=\"class\">{}</span> <span class=\"verdict {}\">{}</span>"
      "</span></div>",
      escaped(c.says.empty() ? c.quantity : c.says), escaped(section_text(c.where)),
      c.statement_class == StatementClass::none ? "" : to_text(c.statement_class),
      class_of(c.verdict), to_text(c.verdict));
  std::string numbers;
  const auto number = [&](std::string_view what, const std::string& value) {
    if (!value.empty()) numbers += fmt::format("<span>{} <b>{}</b></span>", what, escaped(value));
  };
  number("stated", c.reported);
  number("ours", c.computed);
  if (!numbers.empty()) add("<div class=\"numbers\">{}</div>", numbers);
  std::string rest = c.says.empty() ? "" : c.quantity;
  if (!c.accept.empty()) {
    rest += (rest.empty() ? "accepted " : "; accepted ") + c.accept;
    rest += fmt::format(" ({})", analysis::rule_of(c.wording));
  }
  if (!c.why.empty()) rest += (rest.empty() ? "" : ": ") + c.why;
  if (!rest.empty()) add("<p class=\"why\">{}</p>", escaped(rest));
  add("</div>");
}

void Page::claims(const std::vector<Claim>& claims) {
  for (const Claim& c : claims) claim(c);
}

// Adds a line for all curves of one kind and one source.
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
  Json out{{"verdict", to_text(c.verdict)}, {"where", c.where}};
  if (c.statement_class != StatementClass::none) out["class"] = to_text(c.statement_class);
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) out[key] = value;
  };
  add("says", c.says);
  add("theirs", c.reported);
  add("quantity", c.quantity);
  add("ours", c.computed);
  add("accepted", c.accept);
  if (!c.accept.empty()) out["wording"] = to_text(c.wording);
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
  if (!e.claims.empty())
    out["claims"] = Json::array(e.claims, [](const Claim& c) { return json_of(c); });
  return out;
}

}  // namespace

std::string index_html(const Gallery& gallery) { return Page(gallery).text(); }

std::string index_json(const Gallery& gallery) {
  Json out{{"format", "sinew.figures/1"}, {"title", gallery.title}, {"page", "index.html"}};
  const Tally t = tally(gallery);
  if (t.total() > 0) {
    for (const Agreement v : all_verdicts) out["verdicts"][to_text(v)] = t.of(v);
    for (const StatementClass c : all_classes)
      for (const Agreement v : all_verdicts)
        if (c != StatementClass::none) out["classes"][to_text(c)][to_text(v)] = t.of(c, v);
  }
  const auto json = [&](const Exhibit& e) { return json_of(e, gallery); };
  out["figures"] = Json::array(gallery.exhibits, json);
  return out.text(2) + "\n";
}

std::string text_of_figures(const Json& figures) {
  TextTable table({"figure", "", "curves"}, {TextTable::Align::left, TextTable::Align::left});
  for (const Json& f : figures)
    table.add({f["figure"].string(), f["title"].string(), std::to_string(f["curves"].size())});
  return table.text();
}

Tally tally(const Gallery& gallery) {
  Tally out;
  for (const Exhibit& e : gallery.exhibits) count(out, e.claims);
  return out;
}

}  // namespace sinew::report
