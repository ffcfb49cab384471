// cli/view.cpp - `sinew view`: the page of a run in the browser, recorded or while it goes.

#include <fmt/format.h>

#include "cli/run.h"
#include "sinew/config/diagnostics.h"
#include "sinew/live/browser.h"
#include "sinew/live/live_run.h"
#include "sinew/live/runs_pages.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::string run, machine;  // recorded
  RunOptions live;           // .run.experiment empty: a recorded one
  int port = 0;              // 0: a free one
  bool open = true, once = false, paused = false;
};

ExitCode view_recorded(const ViewOptions& o) {
  const Messages messages(o.live.quiet);
  std::vector<fs::path> runs =
      o.run.empty() ? live::runs_below("runs") : std::vector<fs::path>{o.run};
  if (runs.empty())
    config::fail({"runs", 0, 0}, "", "no run", "folders with a log.mcap",
                 "sinew run experiments/walk-test-1.toml, or the folder of a run");
  if (!o.run.empty())
    (void)run::page_of(run::recorded_run(o.run), o.machine);  // its errors belong here
  live::Server server(static_cast<std::uint16_t>(o.port), {.get = [&](std::string_view path) {
                        return live::answer(path, runs, o.machine);
                      }});
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  messages.note(fmt::format(
      "{}; Ctrl-C ends{}", runs.front().string(),
      runs.size() > 1 ? fmt::format("; {} runs at {}runs", runs.size(), server.url()) : ""));
  const live::Browser browser(o.open ? server.url() : "");
  server.run();
  return ok;
}

// A run while it goes. Ends with it, or stays with its page until Ctrl-C.
ExitCode view_live(const ViewOptions& o) {
  const Messages messages(o.live.quiet);
  live::LiveRun run(o.live.run,
                    {.port = static_cast<std::uint16_t>(o.port),
                     .pace = o.live.pace,
                     .paused = o.paused,
                     .once = o.once,
                     .kept =
                         [&](const auto& kept) {
                           tell(kept, o.live.json, messages);
                           std::fflush(stdout);
                         }},
                    messages.notices());
  if (o.live.json)
    messages.note(run.url());
  else
    fmt::print("{}\n", run.url());
  std::fflush(stdout);
  const live::Browser browser(o.open ? run.url() : "");
  run.go();
  return ok;
}

}  // namespace

void add_view(Command app, Action& action) {
  auto options = std::make_shared<ViewOptions>();
  Command sub = app.subcommand("view", "a run in the browser, recorded or while it goes",
                               "sinew view --live experiments/tune-in-air.toml");
  Option dir = sub.add_option("DIR", options->run,
                              "a run's folder, or a log file; else the newest below runs/");
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  Option live =
      sub.add_option("--live", options->live.run.experiment, "run this experiment and watch it");
  live.excludes(dir);
  sub.add_option("--port", options->port, "on 127.0.0.1; 0: a free one").is_between(0, 65535);
  sub.add_flag("!--no-open", options->open, "only print where it is");
  options->live.pace = 1;
  sub.add_option("--pace", options->live.pace,
                 "simulated seconds per second of wall time; 0: no limit")
      .check(a_pace)
      .needs(live);
  sub.add_flag("--paused", options->paused, "the run waits for the page's button").needs(live);
  sub.add_flag("--once", options->once, "end with the run").needs(live);
  add_run_options(sub, options->live);
  for (const char* of_a_run :
       {"--output", "--force", "--set", "--allow-unreachable", "--no-report", "--json"})
    sub.option(of_a_run).needs(live);
  sub.callback([=, &action] {
    action = [=] {
      return options->live.run.experiment.empty() ? view_recorded(*options) : view_live(*options);
    };
  });
}

}  // namespace sinew::cli
