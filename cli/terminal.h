// cli/terminal.h - what goes to stderr: errors, warnings, notes and a progress bar; how wide and
// colored stdout may be.
//
// Color and the bar appear on a terminal only; NO_COLOR (no-color.org) and TERM=dumb are
// respected.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>
#include <thread>

#include "sinew/run/folder/notices.h"

namespace sinew::cli {

// Opens /dev/null for each of stdin, stdout and stderr that the shell has closed, so that no file
// gets their numbers. Call it before any file is opened.
void fill_closed_streams();

// Prints an error. Here and in the messages below, settings of the library are named as the options
// that they come from (cli/settings.h).
void error(std::string_view text);
// Prints an error with the user's own words, none of which is the name of a setting.
void error_in_words(std::string_view text);

// Prints warnings and notes, unless it is quiet.
class Messages {
 public:
  explicit Messages(bool quiet) : quiet_(quiet) {}

  void warning(std::string_view text) const;
  void note(std::string_view text) const;
  run::Notices notices() const;  // passes them to the library

 private:
  bool quiet_;
};

// Returns the letters in a line of stdout; 0 where it is no terminal.
std::size_t width_of_output();

// Returns whether stdout takes color.
bool output_has_color();

// One step of a progress bar, in the unit that is shown.
struct Steps {
  double each = 1;
  std::string_view unit;
  int decimals = 0;
};

// Shows the progress of `now` to `end` until it is destroyed. Reads, never writes.
class ProgressBar {
 public:
  ProgressBar(const std::atomic<std::int64_t>& now, std::int64_t end, Steps steps, bool quiet);
  // Shows the seconds of work whose end is unknown.
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  void watch();
  void draw(std::int64_t now) const;

  const std::atomic<std::int64_t>* now_ = nullptr;  // null: seconds are shown
  std::int64_t end_ = 0;
  Steps steps_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace sinew::cli
