#include "sinew/film/video.h"

#include <fmt/format.h>

#include "sinew/run/folder/files.h"

namespace sinew::film {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

fs::path ffmpeg() { return find_program({"ffmpeg"}); }

// One thread and no dates: the same frames give the same bytes.
Words ffmpeg_arguments(Kind kind, int frames_per_second, const fs::path& file) {
  Words out{ffmpeg().string(),
            "-hide_banner",
            "-loglevel",
            "error",
            "-y",
            "-f",
            "image2pipe",
            "-c:v",
            "png",
            "-framerate",
            std::to_string(frames_per_second),
            "-i",
            "pipe:3",
            "-pix_fmt",
            "yuv420p",
            "-threads",
            "1",
            "-map_metadata",
            "-1",
            "-fflags",
            "+bitexact",
            "-flags:v",
            "+bitexact"};
  const Words mp4{"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart", "-f", "mp4"};
  const Words webm{"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-cpu-used", "4", "-f", "webm"};
  for (const std::string& word : kind == Kind::mp4 ? mp4 : webm) out.push_back(word);
  out.push_back(file.string());
  return out;
}

}  // namespace

void require_ffmpeg() {
  if (ffmpeg().empty())
    throw std::runtime_error(
        "ffmpeg, which makes MP4 and WebM, is not on the PATH; try apt-get install ffmpeg, or a "
        "film.gif, which needs none");
}

Video::Video(const fs::path& file, Kind kind, int frames_per_second, const fs::path& words)
    : file_(file), unfinished_(file.string() + ".unfinished"), words_(words) {
  require_ffmpeg();
  run::require_folder_of(file);
  Pipe pipe = Pipe::make();
  pid_ =
      start(ffmpeg_arguments(kind, frames_per_second, unfinished_), {{pipe.read.file(), 3}}, words);
  to_ = std::move(pipe.write);
}

Video::~Video() {
  if (pid_ < 0) return;
  kill_group(pid_);
  wait_for(pid_);
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
}

void Video::fail() {
  throw std::runtime_error(
      fmt::format("{}: ffmpeg could not make it: {}", file_.string(), last_words(words_)));
}

void Video::add(std::string_view png) {
  if (!write_all(to_.file(), png)) fail();
}

void Video::finish() {
  to_.close();
  if (wait_for(std::exchange(pid_, -1)) != 0) {
    std::error_code ignored;
    fs::remove(unfinished_, ignored);
    fail();
  }
  fs::rename(unfinished_, file_);
}

}  // namespace sinew::film
