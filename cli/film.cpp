// cli/film.cpp - `sinew film`: the replay of a run as a GIF, an MP4 or a WebM.
#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "sinew/film/film.h"
#include "sinew/film/video.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

struct Options {
  std::string run, machine, out, from, to;
  film::FilmOptions film;
  bool force = false, quiet = false;
};

film::FilmOptions film_of(const Options& options) {
  film::FilmOptions out = options.film;
  if (!options.from.empty()) out.from = argument("--from", options.from, "s", units::atmosphere);
  if (!options.to.empty()) out.to = argument("--to", options.to, "s", units::atmosphere);
  return out;
}

ExitCode make(const Options& options) {
  const Messages messages(options.quiet);
  const film::FilmOptions film = film_of(options);
  // Mistakes that show without a look at the run are told first: a browser takes its time.
  const film::Kind kind = film::kind_of(options.out);
  film::check(film, kind);
  run::refuse_to_overwrite(options.out, options.force, {},
                           std::filesystem::path(options.out).extension().string());
  run::require_folder_of(options.out);
  if (kind != film::Kind::gif) film::require_ffmpeg();

  const Interrupt interrupt;
  film::Filming filming(options.run, options.machine, film, interrupt.asked(), messages.notices());
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

void add_film(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  film::FilmOptions& film = options->film;
  Command sub = app.subcommand("film", "the replay of a run as a GIF, an MP4 or a WebM",
                               "sinew film runs/walk-test-1/1 -o walk.gif --from \"2 s\" --to "
                               "\"5 s\"\n  sinew film runs/walk-test-1/1 -o walk.mp4 --speed 0.25");
  sub.add_option("DIR", options->run, "a run's folder, or a log file").required();
  sub.add_option("-o,--output", options->out, "the file to write: .gif, .mp4 or .webm").required();
  sub.add_option("--from", options->from, "\"2 s\" of the run; else its begin");
  sub.add_option("--to", options->to, "else the run's end");
  sub.add_option("--speed", film.speed, "seconds of the run in a second of the film")
      .show_default();
  sub.add_option("--width", film.width, "pixels").show_default();
  sub.add_option("--height", film.height, "pixels").show_default();
  sub.add_option("--fps", film.frames_per_second, "frames per second").show_default();
  sub.add_flag("--dark", film.dark, "light on dark");
  sub.add_flag("--still", film.still, "the camera stands and shows the whole way");
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return make(*options); }; });
}

}  // namespace sinew::cli
