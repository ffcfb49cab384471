// log/writer.h - writes a run's log: the loop pushes samples, a thread of the log's own writes
// them.
//
// While the run lasts, the file is a plain row of messages that is never more than a few
// milliseconds behind, so that a run that is killed leaves a log that can be read up to there.
// finish() ends that file and then puts an indexed one in its place, in one step. Nobody else can
// write a log of that name meanwhile.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sinew/log/error.h"
#include "sinew/log/steady.h"
#include "sinew/signals/ring.h"
#include "sinew/signals/table.h"

namespace sinew::log {

struct Options {
  std::string version{};                // of the program: the file says "sinew <version>"
  std::size_t ring = 1 << 14;           // samples between loop and thread (48 bytes each)
  std::chrono::milliseconds period{5};  // wall time between two writes; 10 at most
};

class Writer {
 public:
  // Creates the file, replacing one of that name, and writes what each topic is. `metadata` says
  // what was run, as pairs of key and text. Throws Error where the file cannot be created, or where
  // a topic does not have one to four fields, or a name appears twice.
  Writer(const std::filesystem::path& path, std::vector<signals::Topic> topics,
         std::vector<std::pair<std::string, std::string>> metadata = {}, Options options = {});

  // Without finish(), leaves what was pushed in a file that reads as cut off.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // One sample of the topic with this place in the constructor's list. `time_ns` counts from the
  // start of the run and is not negative. To be called from one thread, the loop's: takes no memory
  // and no lock and does no I/O. When the thread is behind by a whole ring, it waits for it.
  // False, and nothing kept: no such topic, another number of values, after finish(), or the file
  // can no longer be written (finish() says why).
  bool push(std::uint16_t topic, std::int64_t time_ns, std::span<const double> values) noexcept;

  // How often push() had to wait.
  std::uint64_t waits() const noexcept;

  // Writes the rest, closes the file and indexes it. `metadata`, where it is given, takes the place
  // of the constructor's: a run may have been changed while it went. Throws Error where anything
  // could not be written; the file then still holds everything up to there. A second call does
  // nothing.
  void finish(const std::vector<std::pair<std::string, std::string>>& metadata = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// What passes between the loop and the log's thread.

inline constexpr std::size_t kMaxFields = 4;  // of a topic

// Holds what the loop hands over: one message of a topic.
struct Sample {
  std::int64_t time_ns = 0;
  std::uint16_t topic = 0;
  std::array<double, kMaxFields> values{};
};

using Ring = signals::Ring<Sample>;

// Turns a finished row of messages into an indexed file, in which a viewer can jump.

class Output;

using Metadata = std::vector<std::pair<std::string, std::string>>;

// Writes an indexed copy of `row` beside the file, syncs it and renames it over the file, so that
// at any instant one of the two stands there whole. Throws Error; the file then is as it was: also
// where another file has taken the place of `row`. `run`: what was run, in place of what the file
// says of it; empty: that. Of `steady` topics only the first message is kept.
void make_indexed(const Output& row, const std::filesystem::path& file, const Metadata& run = {},
                  const SteadyTopics& steady = {});

}  // namespace sinew::log
