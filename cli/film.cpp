// cli/film.cpp - `sinew film`: the replay of a run, or of several over each other, as a GIF, an MP4
// or a WebM.
#include <fmt/format.h>

#include "cli/alignment.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/film/film.h"
#include "sinew/film/video.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

struct FilmCommandOptions {
  std::vector<std::string> runs;
  Alignment alignment;
  std::string machine, out, from, to;
  film::FilmOptions film;
  bool force = false, quiet = false;
};

film::FilmOptions film_of(const FilmCommandOptions& options) {
  film::FilmOptions out = options.film;
  if (!options.from.empty())
    out.from = config::quantity_setting("from", options.from, "s", units::atmosphere);
  if (!options.to.empty())
    out.to = config::quantity_setting("to", options.to, "s", units::atmosphere);
  return out;
}

// Refuses options that are for one run alone where there are several, and the other way round.
void check_runs(const FilmCommandOptions& options) {
  const auto wrong = [](const std::string& name, std::string found, std::string expected) {
    config::fail({name, 0, 0}, "", std::move(found), std::move(expected));
  };
  const std::string given = options.alignment.given();
  if (options.runs.size() == 1 && !given.empty())
    wrong(given, "one run", "two runs or more, which are aligned with each other");
  if (options.runs.size() > 1 && !options.machine.empty())
    wrong("machine", config::in_quotes(options.machine),
          "none: of several runs each says itself what was run");
}

film::Filming filming_of(const FilmCommandOptions& options, const film::FilmOptions& film,
                         const std::atomic<bool>& stop, const run::Notices& notices) {
  if (options.runs.size() == 1) return {options.runs.front(), options.machine, film, stop, notices};
  return {options.runs, options.alignment.wish(), film, stop, notices};
}

ExitCode make(const FilmCommandOptions& options) {
  const Messages messages(options.quiet);
  const film::FilmOptions film = film_of(options);
  // Mistakes that show without a look at the run are told first: a browser takes its time.
  const film::Kind kind = film::kind_of(options.out);
  film::check(film, kind);
  check_runs(options);
  run::refuse_to_overwrite(options.out, options.force, {},
                           std::filesystem::path(options.out).extension().string());
  run::require_folder_of(options.out);
  if (kind != film::Kind::gif) film::require_ffmpeg();

  const Interrupt interrupt;
  film::Filming filming = filming_of(options, film, interrupt.asked(), messages.notices());
  std::atomic<std::int64_t> done{0};
  {
    const ProgressBar bar(done, filming.frames(), {.each = 1, .unit = "frames"}, options.quiet);
    filming.make(options.out, done);
  }
  messages.note(fmt::format("{}, {} frames, {:.1f} s, {:.2f} MB", options.out, filming.frames(),
                            static_cast<double>(filming.frames()) / film.frames_per_second,
                            1e-6 * static_cast<double>(std::filesystem::file_size(options.out))));
  return ok;
}

}  // namespace

void add_film(CLI::App& app, Action& action) {
  auto options = std::make_shared<FilmCommandOptions>();
  film::FilmOptions& film = options->film;
  CLI::App& sub =
      subcommand(app, "film", "the replay of a run, or of several, as a GIF, an MP4 or a WebM",
                 "sinew film runs/walk-test-1/1 -o walk.gif --from \"2 s\" --to "
                 "\"5 s\"\n  sinew film runs/walk-test-1/1 -o walk.mp4 --speed 0.25\n  sinew film "
                 "runs/elbow/1 measured -o both.mp4 --align correlation --clock fit");
  sub.add_option("RUN", options->runs,
                 "folders of runs, or log files; the others are ghosts over the first")
      ->required()
      ->expected(1, most_runs);
  sub.add_option("-o,--output", options->out, "the file to write: .gif, .mp4 or .webm")->required();
  sub.add_option("--from", options->from, "\"2 s\" of the run; else its begin");
  sub.add_option("--to", options->to, "else the run's end");
  sub.add_option("--speed", film.speed, "seconds of the run in a second of the film")
      ->capture_default_str();
  sub.add_option("--width", film.width, "pixels")->capture_default_str();
  sub.add_option("--height", film.height, "pixels")->capture_default_str();
  sub.add_option("--fps", film.frames_per_second, "frames per second")->capture_default_str();
  sub.add_flag("--dark", film.dark, "light on dark");
  sub.add_flag("--still", film.still, "the camera stands and shows the whole way");
  add_alignment(sub, options->alignment);
  sub.add_option("--machine", options->machine,
                 "of one run: what was run, in place of the folder's resolved.toml");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return make(*options); }; });
}

}  // namespace sinew::cli
