// cli/view.cpp - `sinew view`: the page of a run or of a study in the browser, recorded or while it
// goes.

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "cli/emergency.h"
#include "cli/run.h"
#include "sinew/live/browser.h"
#include "sinew/live/live_run.h"
#include "sinew/live/served.h"

namespace sinew::cli {

namespace {

struct ViewOptions {
  std::vector<std::string> what;  // recorded: a run, a study or two
  std::string machine;
  RunOptions live;          // .run.experiment empty: a recorded one
  std::optional<int> port;  // 0: a free one
  bool open = true, once = false, paused = false;
};

// The one that is asked for, or else the one of the folder in which somebody works: a browser finds
// there what a reader arranged the last time.
live::Port port_of(const ViewOptions& o) {
  if (o.port) return {.number = static_cast<std::uint16_t>(*o.port)};
  return live::folder_port(std::filesystem::current_path());
}

ExitCode view_recorded(const ViewOptions& o) {
  const Messages messages(o.live.quiet);
  const live::Served served = live::served(o.what, o.machine, messages.notices());
  live::Server server(port_of(o), {.get = served.get});
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  messages.note(served.in_words(server.url()));
  const live::Browser browser(o.open ? server.url() : "");
  server.run();
  return ok;
}

// A run while it goes. Ends with it, or stays with its page until Ctrl-C.
ExitCode view_live(const ViewOptions& o) {
  const Messages messages(o.live.quiet);
  live::LiveRun run(o.live.run,
                    {.port = port_of(o),
                     .pace = o.live.pace,
                     .paused = o.paused,
                     .once = o.once,
                     .kept =
                         [&](const auto& kept) {
                           tell(kept, o.live, messages);
                           std::fflush(stdout);
                         }},
                    messages.notices());
  if (o.live.json)
    messages.note(run.url());
  else
    fmt::print("{}\n", run.url());
  std::fflush(stdout);
  const live::Browser browser(o.open ? run.url() : "");
  std::optional<SpaceBar> space_bar;
  if (run.machine()) space_bar.emplace([&] { run.stop(); });
  if (space_bar && space_bar->listens()) messages.note("the space bar stops the machine");
  run.go();
  return ok;
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App& sub =
      subcommand(app, "view", "a run or a study in the browser, recorded or while it goes",
                 "sinew view --live experiments/tune-in-air.toml");
  CLI::Option* dir =
      sub.add_option("DIR", options->what,
                     "a run's folder, a folder of runs, a log file, one or two studies; else "
                     "the newest of runs/");
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  CLI::Option* live =
      sub.add_option("--live", options->live.run.experiment, "run this experiment and watch it");
  live->excludes(dir);
  sub.add_option("--port", options->port,
                 "on 127.0.0.1; 0: a free one; else the one that this folder has each time")
      ->transform(between(0, 65535));
  sub.add_flag("!--no-open", options->open, "only print where it is");
  options->live.pace = 1;
  sub.add_option("--pace", options->live.pace,
                 "simulated seconds per second of wall time; 0: no limit")
      ->transform(passes(a_pace))
      ->needs(live);
  sub.add_flag("--paused", options->paused, "the run waits for the page's button")->needs(live);
  sub.add_flag("--once", options->once, "end with the run")->needs(live);
  add_run_options(sub, "--place", options->live);
  for (const char* of_a_run : {"--place", "--clear-fault", "--output", "--force", "--set",
                               "--allow-unreachable", "--no-report", "--units", "--json"})
    sub.get_option(of_a_run)->needs(live);
  sub.callback([=, &action] {
    action = [=] {
      return options->live.run.experiment.empty() ? view_recorded(*options) : view_live(*options);
    };
  });
}

}  // namespace sinew::cli
