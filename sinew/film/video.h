// film/video.h - frames to a video, by ffmpeg as a program of its own.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

#include "sinew/film/film.h"
#include "sinew/film/process.h"

namespace sinew::film {

// Throws std::runtime_error, with what to do, where there is no ffmpeg.
void require_ffmpeg();

// A video that is being made of frames.
class Video {
 public:
  // `words`: a new file for ffmpeg's output. Until finish() the video is next to `file`.
  Video(const std::filesystem::path& file, Kind kind, int frames_per_second,
        const std::filesystem::path& words);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  // Adds a frame, a PNG. Throws std::runtime_error with ffmpeg's words where it has ended.
  void add(std::string_view png);
  // Makes it whole and puts it in its place.
  void finish();

 private:
  [[noreturn]] void fail();

  const std::filesystem::path file_, unfinished_, words_;
  End to_;
  pid_t pid_ = -1;
};

}  // namespace sinew::film
