#include "sinew/live/runs_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sinew/run/folder/page.h"

namespace sinew::live {

namespace fs = std::filesystem;

std::vector<fs::path> runs_below(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> found;
  std::error_code none;
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(folder, none))
    if (e.path().filename() == run::log_name && e.is_regular_file())
      found.emplace_back(e.last_write_time(), e.path().parent_path());
  std::ranges::sort(found, [](const auto& a, const auto& b) { return a > b; });
  std::vector<fs::path> out;
  for (auto& [time, run] : found) out.push_back(std::move(run));
  return out;
}

namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&' || c == '"')
      out += fmt::format("&#{};", static_cast<int>(c));
    else
      out += c;
  }
  return out;
}

std::string list_of(const std::vector<fs::path>& runs) {
  std::string items;
  for (std::size_t i = 0; i < runs.size(); ++i)
    items += fmt::format("<li><a href=\"run/{}\">{}</a></li>\n", i, escaped(runs[i].string()));
  return fmt::format(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Runs</title>"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'\">"
      "<style>:root{{color-scheme:light dark}}body{{font:15px/1.6 system-ui,sans-serif;max-width:"
      "44rem;margin:3rem auto;padding:0 1rem}}</style></head><body><h1>Runs</h1>"
      "<p>The newest first.</p><ol>\n{}</ol></body></html>\n",
      items);
}

Reply not_found() { return {404, "Nothing is here; the runs are at runs.\n", "text/plain"}; }

Reply page_of_run(const fs::path& run, const std::string& machine) {
  try {
    return {200, run::page_of(run::recorded_run(run), machine)};
  } catch (const std::exception& wrong) {
    return {500, std::string(wrong.what()) + "\n", "text/plain; charset=utf-8"};
  }
}

}  // namespace

Reply answer(std::string_view path, const std::vector<fs::path>& runs, const std::string& machine) {
  if (path == "/") return page_of_run(runs.front(), machine);
  if (path == "/runs") return {200, list_of(runs)};
  constexpr std::string_view before = "/run/";
  if (!path.starts_with(before)) return not_found();
  std::size_t i = runs.size();
  const auto [end, error] =
      std::from_chars(path.data() + before.size(), path.data() + path.size(), i);
  if (error != std::errc{} || end != path.data() + path.size() || i >= runs.size())
    return not_found();
  return page_of_run(runs[i], machine);
}

}  // namespace sinew::live
