// live/feed.h - what a run records, for those who watch it: the loop pushes, a thread of the
// watchers' collects.
//
// The loop never waits: where the watchers are behind by a whole ring, what comes is left out, and
// with it the rest of its row. The log lacks nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "sinew/log/ring.h"
#include "sinew/signals/table.h"

namespace sinew::live {

class Feed {
 public:
  // `topics` in the recorder's order: /valve/… are edges, the others the fields of a row. `ring`:
  // samples between the two threads.
  explicit Feed(std::vector<signals::Topic> topics, std::size_t ring = 1 << 16);

  // --- the loop's side ---

  // One sample of the topic with this place in the list. No heap, no lock.
  void push(std::size_t topic, std::int64_t time_ns, std::span<const double> values) noexcept;

  // --- the watchers' side ---

  // Returns what is recorded, in the order of its numbers.
  std::vector<signals::Topic> topics() const;

  // Takes in what has come: whole rows, and edges.
  void collect();

  // How far a watcher has got.
  struct Position {
    std::size_t rows = 0;
    std::vector<std::size_t> edges;  // of each of those topics
  };
  std::size_t rows() const { return rows_; }
  // What was taken in since; `position` is then where it ends.
  signals::Table since(Position& position) const;

  // How many samples came too fast to be taken in.
  std::uint64_t left_out() const noexcept { return left_out_.load(std::memory_order_relaxed); }

 private:
  void take(const log::Sample& sample);
  void keep_row();

  const signals::PageFile pages_ = signals::PageFile::make();
  signals::Table table_;
  std::vector<std::size_t> row_topics_, edge_topics_;
  std::vector<bool> is_edge_;
  signals::Ring<log::Sample> ring_;
  std::atomic<std::uint64_t> left_out_{0};

  // The row that is coming in.
  std::vector<log::Sample> row_;  // by topic
  std::int64_t row_time_ns_ = -1;
  std::size_t filled_ = 0, rows_ = 0;
};

}  // namespace sinew::live
