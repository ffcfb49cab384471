// cli/terminal.h - what goes to stderr: errors, warnings, notes and a progress bar.
//
// Colour and the bar appear on a terminal only; NO_COLOR (no-color.org) and TERM=dumb are
// respected.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>

namespace sinew::cli {

void error(std::string_view text);

// Everything but errors, unless it is to be quiet.
class Messages {
 public:
  explicit Messages(bool quiet) : quiet_(quiet) {}

  void warning(std::string_view text) const;
  void note(std::string_view text) const;
  bool quiet() const { return quiet_; }

 private:
  bool quiet_;
};

// Shows how far `now` is on its way to `end` until it is destroyed. Reads, never writes.
class ProgressBar {
 public:
  ProgressBar(const std::atomic<std::int64_t>& now, std::int64_t end, double seconds_per_step,
              bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  void watch();
  void draw(std::int64_t now) const;

  const std::atomic<std::int64_t>& now_;
  std::int64_t end_;
  double seconds_per_step_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace sinew::cli
