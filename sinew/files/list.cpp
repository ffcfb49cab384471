#include "sinew/files/list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/config/shipped.h"
#include "sinew/config/text_file.h"
#include "sinew/json/json.h"
#include "sinew/units/letters.h"

namespace sinew::files {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kinds{"robots",  "experiments", "rigs",
                                                "studies", "valves",      "examples"};

// Limits of the search, as the folder may be a home directory: depth, entries, size of a file [B].
constexpr int deepest = 6;
constexpr int most_entries = 20'000;
constexpr std::uintmax_t largest = 1'000'000;

constexpr std::size_t longest_title = 100;

// Returns the kind in `format = "sinew.robot/1"`, which precedes the first table.
std::string_view kind_of_format(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = units::trimmed(text.substr(0, text.find('\n')));
    if (line.starts_with('[')) break;
    const std::size_t at = line.find("\"sinew.");
    if (line.starts_with("format") && at != line.npos) {
      const std::string_view rest = line.substr(at + 7);
      const std::string_view kind = rest.substr(0, rest.find('/'));
      if (kind == "robot") return "robots";
      if (kind == "experiment") return "experiments";
      if (kind == "rig") return "rigs";
      if (kind == "valves") return "valves";
      if (kind == "plan" || kind == "tuning") return "studies";
      break;
    }
    const std::size_t end = text.find('\n');
    text = end == text.npos ? std::string_view() : text.substr(end + 1);
  }
  return "";
}

// Returns the comment at the start of a file as one line.
std::string leading_comment(std::string_view text) {
  std::string out;
  while (text.starts_with('#')) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(1, end == text.npos ? end : end - 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    line = units::trimmed(line);
    if (line.empty()) break;
    out += (out.empty() ? "" : " ") + std::string(line);
    text = end == text.npos ? std::string_view() : text.substr(end + 1);
  }
  return out;
}

// Returns the first sentence without the file's name: "the walking leg" of "# robots/leg/robot.toml
// – the walking leg. More …".
std::string first_sentence(std::string_view text) {
  std::string out = leading_comment(text);
  constexpr std::string_view dash = " – ";
  if (const std::size_t at = out.find(dash); at != out.npos) out.erase(0, at + dash.size());
  if (const std::size_t at = out.find(". "); at != out.npos) out.erase(at);
  if (out.size() > longest_title) {
    const std::size_t blank = out.find_last_of(' ', longest_title);
    out.erase(blank == out.npos ? longest_title : blank);
    out += " …";
  }
  if (out.ends_with('.') || out.ends_with(':')) out.pop_back();
  return out;
}

// Returns whether the experiment, or the one that it changes, is on a test stand.
bool is_of_stand(const config::Node& root, const fs::path& file) {
  if (config::is_on_stand(root)) return true;
  const config::Node* base = root.find("base");
  std::error_code none;
  const fs::path changed = base ? file.parent_path() / base->text : fs::path();
  return fs::is_regular_file(changed, none) &&
         config::is_on_stand(config::parse_file(changed.string()));
}

void read_title(const fs::path& file, std::string_view text, Listed& out) {
  try {
    const config::Node root = config::parse_file(file.string());
    if (out.kind == "experiments" && is_of_stand(root, file)) out.kind = "rigs";
    out.title = first_sentence(text);
    for (const char* key : {"name", "title"}) {
      const config::Node* node = root.find(key);
      if (!node || node->kind != config::Node::Kind::text) continue;
      if (out.title.empty() || key == std::string_view("title")) out.title = node->text;
    }
  } catch (const std::exception&) {
    out.problem = "cannot be read: sinew check prints why";
  }
}

// Returns the listed file; nothing for a file of another kind.
std::optional<Listed> listed(const fs::path& file) {
  std::error_code none;
  if (file.extension() != ".toml" || !fs::is_regular_file(file, none)) return {};
  if (fs::file_size(file, none) > largest) return {};
  try {
    const std::string text = config::read_text_file(file.string(), "a TOML file");
    Listed out{.kind = std::string(kind_of_format(text)), .path = file.string()};
    if (out.kind.empty()) return {};
    read_title(file, text, out);
    return out;
  } catch (const config::Error&) {
    return {};
  }
}

// Returns whether a folder is skipped: runs and builds hold copies of files.
bool is_passed_over(const fs::path& folder) {
  std::error_code none;
  const std::string name = folder.filename().string();
  return name.starts_with('.') || name == "node_modules" ||
         fs::exists(folder / "resolved.toml", none) || fs::exists(folder / "CMakeCache.txt", none);
}

// Collects the listed files below the folder. Returns whether the limit was reached.
bool gather(const fs::path& top, std::vector<Listed>& out) {
  std::error_code bad;
  int count = 0;
  fs::recursive_directory_iterator at(top, fs::directory_options::skip_permission_denied, bad), end;
  for (; !bad && at != end; at.increment(bad)) {
    if (++count > most_entries) return true;
    std::error_code none;
    if (at->is_directory(none)) {
      if (is_passed_over(at->path())) at.disable_recursion_pending();
      if (at.depth() >= deepest) at.disable_recursion_pending();
    } else if (std::optional<Listed> one = listed(at->path())) {
      out.push_back(std::move(*one));
    }
  }
  return false;
}

// Collects examples: folders whose README.md begins with a title.
void gather_examples(const fs::path& top, std::vector<Listed>& out) {
  std::error_code bad;
  for (fs::directory_iterator at(top, bad), end; !bad && at != end; at.increment(bad)) {
    try {
      const std::string text =
          config::read_text_file((at->path() / "README.md").string(), "an example's text");
      const std::string_view line = std::string_view(text).substr(0, text.find('\n'));
      const std::size_t begin = line.find_first_not_of("# ");
      out.push_back({.kind = "examples",
                     .path = at->path().string(),
                     .title = std::string(begin == line.npos ? "" : line.substr(begin))});
    } catch (const config::Error&) {
      continue;  // not an example
    }
  }
}

// Returns the path as a command takes it in `here`: relative if it is below.
std::string from_here(const fs::path& file, const fs::path& here) {
  const fs::path relative = file.lexically_relative(here);
  return relative.empty() || relative.begin()->string() == ".." ? file.string() : relative.string();
}

void require_kind(const std::string& kind) {
  if (kind.empty() || std::ranges::count(kinds, kind) > 0) return;
  const std::vector<std::string_view> words(kinds.begin(), kinds.end());
  config::fail({"list", 0, 0}, "", config::in_quotes(kind), config::either(words),
               config::closest_in_quotes(kind, words));
}

// Collects the files shipped with Sinew, if they are found.
std::vector<Listed> gather_shipped(std::string& folder) {
  std::vector<Listed> out;
  try {
    folder = config::shipped_folder().string();
  } catch (const config::Error&) {
    return out;
  }
  for (const char* below : {"robots", "experiments", "studies"})
    gather(fs::path(folder) / below, out);
  if (std::optional<Listed> one = listed(fs::path(folder) / "data/valves.toml"))
    out.push_back(std::move(*one));
  gather_examples(fs::path(folder) / "examples", out);
  for (Listed& one : out) one.shipped = true;
  return out;
}

std::size_t rank(const Listed& one) {
  return static_cast<std::size_t>(std::ranges::find(kinds, one.kind) - kinds.begin());
}

}  // namespace

std::span<const std::string_view> listed_kinds() { return kinds; }

Listing list(const std::string& kind, const fs::path& here) {
  require_kind(kind);
  if (!fs::is_directory(here))
    config::fail({here.string(), 0, 0}, "", fs::exists(here) ? "a file" : "nothing", "a folder");
  const fs::path top = fs::canonical(here);
  Listing out;
  out.files = gather_shipped(out.shipped_from);
  std::set<std::string> known;
  for (const Listed& one : out.files) known.insert(one.path);

  std::vector<Listed> found;
  out.cut = gather(top, found);
  const fs::path kept = fs::path(out.shipped_from) / "data/templates";  // templates of `new`
  for (Listed& one : found)
    if (!known.contains(one.path) &&
        (out.shipped_from.empty() || !one.path.starts_with(kept.string() + "/")))
      out.files.push_back(std::move(one));

  std::erase_if(out.files, [&](const Listed& one) { return !kind.empty() && one.kind != kind; });
  std::ranges::sort(out.files, [](const Listed& a, const Listed& b) {
    if (a.kind != b.kind) return rank(a) < rank(b);
    return a.shipped != b.shipped ? a.shipped : a.path < b.path;
  });
  for (Listed& one : out.files) one.path = from_here(one.path, top);
  return out;
}

std::string text_of(const Listing& listing, const std::string& kind) {
  std::string out;
  for (const std::string_view each : kinds) {
    if (!kind.empty() && kind != each) continue;
    for (const bool shipped : {true, false}) {
      std::vector<const Listed*> rows;
      for (const Listed& one : listing.files)
        if (one.kind == each && one.shipped == shipped) rows.push_back(&one);
      if (rows.empty()) continue;
      std::size_t width = 0;
      for (const Listed* one : rows) width = std::max(width, one->path.size());
      out += fmt::format("{}{}, {}:\n", out.empty() ? "" : "\n", each,
                         shipped ? "with Sinew" : "in this folder");
      for (const Listed* one : rows)
        out += fmt::format("  {:<{}}  {}\n", one->path, width,
                           one->problem.empty() ? one->title : one->problem);
    }
  }
  if (!out.empty()) return out;
  return fmt::format("no {}\n", kind.empty() ? "files of Sinew" : kind);
}

std::string json_of(const Listing& listing) {
  Json all{{"format", "sinew.list/1"}};
  if (!listing.shipped_from.empty()) all["shipped_from"] = listing.shipped_from;
  all["cut"] = listing.cut;
  all["files"] = Json::array();
  for (const Listed& one : listing.files) {
    all["files"].push_back(
        {{"kind", one.kind}, {"path", one.path}, {"title", one.title}, {"shipped", one.shipped}});
    if (!one.problem.empty()) all["files"].back()["problem"] = one.problem;
  }
  return all.text(2) + "\n";
}

}  // namespace sinew::files
