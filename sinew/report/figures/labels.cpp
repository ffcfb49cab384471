#include "sinew/report/figures/labels.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/config/node.h"

namespace sinew::report {
namespace {

using config::Node;

constexpr const char* labels_format = "sinew.labels/1";

config::Problem problem(const Node& at, std::string key, std::string found, std::string expected,
                        std::string try_this = "") {
  return {at.where, std::move(key), std::move(found), std::move(expected), std::move(try_this)};
}

using Problems = std::vector<config::Problem>;

std::vector<Label> read_table(const Node& table, Problems& wrong) {
  std::vector<Label> out;
  if (!table.is_table()) {
    wrong.push_back(
        problem(table, table.key, config::shown(table), "a table", "[" + table.key + "]"));
    return out;
  }
  for (const Node& entry : table.children) {
    const std::string key = fmt::format("{}.\"{}\"", table.key, entry.key);
    if (entry.kind != Node::Kind::text)
      wrong.push_back(problem(entry, key, config::shown(entry), "your words in quotes"));
    else if (entry.key.empty())
      wrong.push_back(problem(entry, key, "no words", "words that a figure has, in quotes"));
    else
      out.push_back({entry.key, entry.text, entry.where});
  }
  return out;
}

// Returns whether a byte is a letter, a digit, or part of a letter of more than one byte.
bool within_word(char c) {
  const auto u = static_cast<unsigned char>(c);
  return u >= 0x80 || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Returns the longest label that matches whole words of the text from `at` on.
const Label* longest_at(const std::vector<Label>& labels, std::string_view text, std::size_t at) {
  const Label* found = nullptr;
  for (const Label& label : labels) {
    const std::size_t end = at + label.ours.size();
    if (found && label.ours.size() <= found->ours.size()) continue;
    if (text.substr(at, label.ours.size()) != label.ours) continue;
    if (end < text.size() && within_word(text[end]) && within_word(text[end - 1])) continue;
    found = &label;
  }
  return found;
}

}  // namespace

std::string Labels::of(std::string_view text) const {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins = at == 0 || !within_word(text[at - 1]) || !within_word(text[at]);
    const Label* label = begins ? longest_at(words, text, at) : nullptr;
    out += label ? label->yours : std::string(1, text[at]);
    at += label ? label->ours.size() : 1;
  }
  return out;
}

std::string Labels::unit(std::string_view name) const {
  const auto at = std::ranges::find(units, name, &Label::ours);
  return at == units.end() ? std::string(name) : at->yours;
}

Labels read_labels(const std::string& path) {
  const Node root = config::parse_file(path);
  Labels out;
  Problems wrong;
  const Node* named = root.find("format");
  if (!named || named->text != labels_format)
    config::fail(named ? named->where : config::Location{path, 0, 0}, "format",
                 named ? config::shown(*named) : "nothing", config::in_quotes(labels_format),
                 fmt::format("format = \"{}\"", labels_format));
  for (const Node& node : root.children) {
    if (node.key == "format") continue;
    if (node.key == "words") {
      out.words = read_table(node, wrong);
    } else if (node.key == "units") {
      out.units = read_table(node, wrong);
    } else if (node.key == "decimal_comma") {
      if (node.kind != Node::Kind::flag)
        wrong.push_back(problem(node, node.key, config::shown(node), "true or false"));
      out.decimal_comma = node.flag;
    } else {
      std::string near = config::closest_in_quotes(node.key, {"words", "units", "decimal_comma"});
      wrong.push_back(problem(node, node.key, "an unknown key", "words, units or decimal_comma",
                              std::move(near)));
    }
  }
  if (!wrong.empty()) throw config::Error(std::move(wrong));
  return out;
}

Figure labelled(Figure figure, const Labels& labels) {
  figure.paper.decimal_comma = figure.paper.decimal_comma || labels.decimal_comma;
  for (Plot& plot : figure.plots) {
    plot.title = labels.of(plot.title);
    for (Axis* axis : {&plot.x, &plot.y}) {
      axis->name = labels.of(axis->name);
      axis->unit = labels.unit(axis->unit);
      for (Axis::Tick& tick : axis->ticks) tick.text = labels.of(tick.text);
    }
    for (Curve& curve : plot.curves) curve.label = labels.of(curve.label);
  }
  return figure;
}

void FigureTexts::add(const Figure& figure) {
  const auto word = [&](const std::string& text) {
    if (!text.empty()) words.insert(text);
  };
  for (const Plot& plot : figure.plots) {
    word(plot.title);
    for (const Axis* axis : {&plot.x, &plot.y}) {
      word(axis->name);
      if (!axis->unit.empty() && axis->unit != "-") units.insert(axis->unit);
      for (const Axis::Tick& tick : axis->ticks) word(tick.text);
    }
    for (const Curve& curve : plot.curves) word(curve.label);
  }
}

std::vector<config::Problem> unused_labels(const Labels& labels, const FigureTexts& phrases) {
  Problems out;
  const auto look = [&](const char* table, const std::vector<Label>& list,
                        const std::set<std::string>& said, bool within) {
    for (const Label& label : list) {
      // Words may match a part of a figure's text.
      const bool found = std::ranges::any_of(said, [&](const std::string& text) {
        return within ? Labels{.words = {{label.ours, ""}}}.of(text) != text : text == label.ours;
      });
      if (found) continue;
      const std::vector<std::string_view> all(said.begin(), said.end());
      out.push_back({label.where, fmt::format("{}.\"{}\"", table, label.ours),
                     "the text of no figure here", "words of a figure",
                     config::closest_in_quotes(label.ours, all)});
    }
  };
  look("words", labels.words, phrases.words, true);
  look("units", labels.units, phrases.units, false);
  return out;
}

namespace {

// Returns a quoted and escaped TOML string.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + "\"";
}

// Splits "hip desired" into "hip" and "desired", so that each has to be translated once.
std::set<std::string> parts_of(const std::set<std::string>& words) {
  constexpr std::string_view endings[] = {
      " desired", " true", " measured", " estimated", " oscillation", " from torques", " read"};
  std::set<std::string> out;
  for (const std::string& text : words) {
    std::string_view rest = text;
    for (const std::string_view ending : endings)
      if (rest.ends_with(ending)) {
        rest.remove_suffix(ending.size());
        out.emplace(ending.substr(1));
        break;
      }
    out.emplace(rest);
  }
  return out;
}

}  // namespace

std::string labels_file(const FigureTexts& phrases) {
  std::string out = fmt::format(
      "format = \"{}\"\n"
      "decimal_comma = false  # true: 0,5 at the ticks of an axis\n"
      "\n"
      "# Text of a figure = text that replaces it. Write yours on the right; a line that you\n"
      "# leave out stays as it is.\n"
      "[words]\n",
      labels_format);
  for (const std::string& word : parts_of(phrases.words))
    out += fmt::format("{0} = {0}\n", quoted(word));
  out += "\n[units]\n";
  for (const std::string& unit : phrases.units) out += fmt::format("{0} = {0}\n", quoted(unit));
  return out;
}

}  // namespace sinew::report
