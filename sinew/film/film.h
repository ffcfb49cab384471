// film/film.h - the replay of a run, or of several over each other, as a film: the drawing of their
// page, frame by frame.
//
//   Filming filming("runs/walk-test-1/1", "", options, stop);
//   filming.make("walk.gif", done);
//
// A browser without a window draws the frames in the run's own page, so a film shows what the page
// shows. A GIF is made in that page; MP4 and WebM are made by ffmpeg. The same run gives the same
// bytes with the same browser, fonts and ffmpeg.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "sinew/film/chromium.h"
#include "sinew/report/compare/comparison.h"
#include "sinew/run/folder/notices.h"

namespace sinew::film {

// Content of a film, and its form.
struct FilmOptions {
  // The part that is shown, in the run's time [s].
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  double speed = 1;               // seconds of the run in one of the film
  int width = 880, height = 470;  // [pixels]
  int frames_per_second = 25;
  bool dark = false;
  bool still = false;  // the camera stands, and shows the whole way
};

// The kind of file that keeps a film.
enum class Kind { gif, mp4, webm };

// Returns the kind by the file's ending. Throws config::Error for another ending.
Kind kind_of(const std::filesystem::path& file);

// Throws config::Error, which begins with the name of what is wrong, for options of which there can
// be no film of that kind.
void check(const FilmOptions& options, Kind kind);

// A film that is being made of a run.
class Filming {
 public:
  // Opens the run's page. `machine`: what was run, in place of the folder's resolved.toml; may be
  // empty. Once `stop` is true the work ends with Chromium::Stopped. Throws config::Error where
  // there is no such run, it has no drawing, or none in the requested time, and
  // std::runtime_error, with what to do, where there is no browser.
  Filming(const std::filesystem::path& run, const std::string& machine, const FilmOptions& options,
          const std::atomic<bool>& stop, const run::Notices& notices = {});

  // Opens the page of several runs (run/folder/compared.h): the first one's machine as it
  // is, the others as ghosts over it in their colors, as `align_options` aligns them with it. Times
  // are the first one's; the film shows all that any of them has. Throws as above, also where one
  // of them cannot be drawn, and what the comparison throws.
  Filming(const std::vector<std::string>& runs, const report::AlignOptions& align_options,
          const FilmOptions& options, const std::atomic<bool>& stop,
          const run::Notices& notices = {});

  // Returns the number of frames of the film.
  int frames() const { return static_cast<int>(times_.size()); }

  // Writes the film; `done` counts its frames. An older file is replaced when the new one is whole.
  // Throws std::runtime_error, with what to do, where ffmpeg is missing or fails.
  void make(const std::filesystem::path& file, std::atomic<std::int64_t>& done);

 private:
  void open(const std::string& page);
  void prepare();
  void make_gif(const std::filesystem::path& file, std::atomic<std::int64_t>& done);
  void make_video(const std::filesystem::path& file, Kind kind, std::atomic<std::int64_t>& done);

  const FilmOptions options_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<Chromium> browser_;
  std::vector<double> times_;  // time of each frame [s]
};

}  // namespace sinew::film
