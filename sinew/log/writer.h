// log/writer.h - writer of a run's log: the control loop pushes samples, and a thread of the log
// writes them.
//
// During the run the file is a plain list of messages that is at most a few milliseconds behind,
// so that a killed run leaves a readable log. finish() completes that file and replaces it
// atomically with an indexed one. No other log of that name can be written meanwhile.
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

#include "sinew/log/file.h"
#include "sinew/log/steady.h"
#include "sinew/signals/ring.h"
#include "sinew/signals/table.h"

namespace sinew::log {

struct Options {
  std::string version{};                // the program's version; the file has "sinew <version>"
  std::size_t ring = 1 << 14;           // samples buffered between loop and thread (48 bytes each)
  std::chrono::milliseconds period{5};  // wall time between two writes; at most 10
};

class Writer {
 public:
  // Creates or replaces the file and writes the description of each topic. `metadata` describes the
  // run in pairs of key and text. Throws Error if the file cannot be created, if a topic does not
  // have one to four fields, or if a name occurs twice.
  Writer(const std::filesystem::path& path, std::vector<signals::Topic> topics,
         std::vector<std::pair<std::string, std::string>> metadata = {}, Options options = {});

  // Without finish(), leaves the pushed samples in a file that is read as cut off.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Adds a sample of the topic with this index in the constructor's list. `time_ns` counts from the
  // start of the run and is not negative. Must be called from one thread, the loop's; does not
  // allocate, lock or do I/O. Waits for the thread if the ring is full. Returns false and drops the
  // sample for an unknown topic, a wrong number of values, a call after finish(), or if the file
  // can no longer be written; finish() reports the reason.
  bool push(std::uint16_t topic, std::int64_t time_ns, std::span<const double> values) noexcept;

  // Returns how often push() had to wait.
  std::uint64_t waits() const noexcept;

  // Writes the rest, closes the file and indexes it. `metadata`, if not empty, replaces the
  // constructor's, as a run may be changed while it runs. Throws Error if anything could not be
  // written; the file still holds everything before. A second call does nothing.
  void finish(const std::vector<std::pair<std::string, std::string>>& metadata = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Data exchanged between the loop and the log's thread.

inline constexpr std::size_t kMaxFields = 4;  // maximum number of fields of a topic

// Sample of a topic, passed from the loop to the thread.
struct Sample {
  std::int64_t time_ns = 0;
  std::uint16_t topic = 0;
  std::array<double, kMaxFields> values{};
};

using Ring = signals::Ring<Sample>;

// Conversion of a finished list of messages to an indexed file, which viewers can seek in.

class Output;

using Metadata = std::vector<std::pair<std::string, std::string>>;

// Writes an indexed copy of `row` to a second file, syncs it and renames it to `file`, which is
// complete at any time. Throws Error, and leaves the file unchanged, on failure and if another file
// has replaced `row`. `run`, if not empty, replaces the file's description of the run. Only the
// first message of `steady` topics is kept.
void make_indexed(const Output& row, const std::filesystem::path& file, const Metadata& run = {},
                  const SteadyTopics& steady = {});

}  // namespace sinew::log
