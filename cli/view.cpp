// cli/view.cpp - `sinew view`: the page of a run in the browser, recorded or while it goes.
#include "cli/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cli/browser.h"
#include "cli/server.h"
#include "sinew/config/diagnostics.h"
#include "sinew/report/page.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

// Folders below runs/ with a log, the newest first.
std::vector<fs::path> runs_here() {
  std::vector<std::pair<fs::file_time_type, fs::path>> found;
  std::error_code none;
  for (const fs::directory_entry& e : fs::recursive_directory_iterator("runs", none))
    if (e.path().filename() == run::log_name && e.is_regular_file())
      found.emplace_back(e.last_write_time(), e.path().parent_path());
  std::ranges::sort(found, [](const auto& a, const auto& b) { return a > b; });
  std::vector<fs::path> out;
  for (auto& [time, folder] : found) out.push_back(std::move(folder));
  return out;
}

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

// "/" is the first of them, "/run/3" the one with that number in the list.
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

ExitCode view_recorded(const ViewOptions& o) {
  const Messages messages(o.live.quiet);
  std::vector<fs::path> runs = o.run.empty() ? runs_here() : std::vector<fs::path>{o.run};
  if (runs.empty())
    config::fail({"runs", 0, 0}, "", "no run", "folders with a log.mcap",
                 "sinew run experiments/walk-test-1.toml, or the folder of a run");
  if (!o.run.empty())
    (void)run::page_of(run::recorded_run(o.run), o.machine);  // its errors belong here
  Server server(static_cast<std::uint16_t>(o.port),
                {.get = [&](std::string_view path) { return answer(path, runs, o.machine); }});
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  messages.note(fmt::format(
      "{}; Ctrl-C ends{}", runs.front().string(),
      runs.size() > 1 ? fmt::format("; {} runs at {}runs", runs.size(), server.url()) : ""));
  const Browser browser(o.open ? server.url() : "");
  server.run();
  return ok;
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App& sub = subcommand(app, "view", "a run in the browser, recorded or while it goes",
                             "sinew view --live experiments/tune-in-air.toml");
  auto* dir = sub.add_option("DIR", options->run,
                             "a run's folder, or a log file; else the newest below runs/");
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  auto* live =
      sub.add_option("--live", options->live.run.experiment, "run this experiment and watch it");
  live->excludes(dir);
  sub.add_option("--port", options->port, "on 127.0.0.1; 0: a free one")
      ->check(CLI::Range(0, 65535));
  sub.add_flag("!--no-open", options->open, "only print where it is");
  options->live.pace = 1;
  sub.add_option("--pace", options->live.pace,
                 "simulated seconds per second of wall time; 0: no limit")
      ->check(a_pace, "")
      ->needs(live);
  sub.add_flag("--paused", options->paused, "the run waits for the page's button")->needs(live);
  sub.add_flag("--once", options->once, "end with the run")->needs(live);
  add_run_options(sub, options->live);
  for (const char* of_a_run :
       {"--output", "--force", "--set", "--allow-unreachable", "--no-report", "--json"})
    sub.get_option(of_a_run)->needs(live);
  sub.callback([=, &action] {
    action = [=] {
      return options->live.run.experiment.empty() ? view_recorded(*options) : view_live(*options);
    };
  });
}

}  // namespace sinew::cli
