// analysis/record/record.h - a log as rows: every topic at the same times, and the phase of each
// row.
//
// Rows have the times of /plan/phase, or of the first joint's angle if a log has no plan; of a test
// stand those of its length, or else of its force or pressure. For a machine with several legs they
// are those of the given leg's plan, by default of the first leg's.
// A topic with other times is held from one of its samples to the next. A row lasts until the next
// one; the last one lasts as long as the one before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/measures/statistics.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

using signals::Column;  // a value per row; empty if the log lacks the topic
using signals::TopicNames;

// One phase of one step: rows first .. last - 1.
struct PhaseSpan {
  int phase = 0, step = 0;
  std::size_t first = 0, last = 0;
};

class Record {
 public:
  // `more` may hold derived series; all three must outlive the record. `leg` is the name of the leg
  // if the machine is one leg of several (only_leg); its topics are then found by their names
  // without the leg's prefix. The names of all topics that are read, and of those that were
  // searched in vain, are added to `read`.
  Record(const signals::Table& table, const Machine& machine, const signals::Table* more = nullptr,
         std::string leg = "", TopicNames* read = nullptr);

  // Number of rows, and their times.
  std::size_t rows() const { return seconds_.size(); }
  const signals::Times& time_ns() const { return time_ns_; }
  double time(std::size_t row) const { return static_cast<double>(time_ns_[row]) / 1e9; }  // [s]
  double end_of(std::size_t row) const { return static_cast<double>(end_ns(row)) / 1e9; }  // [s]
  // Returns the time from the start of row `first` to the end of row `last`  [s].
  double lasting(std::size_t first, std::size_t last) const {
    return static_cast<double>(end_ns(last) - time_ns_[first]) / 1e9;
  }
  double lasting(const PhaseSpan& s) const { return lasting(s.first, s.last - 1); }
  double period() const { return period_; }  // median [s]

  // Return a topic by its name in the log, or in the leg; nullptr or an empty column if neither
  // table has it.
  const signals::Series* find(std::string_view topic) const;
  Column column(std::string_view topic, std::string_view field = "value") const;
  // Returns the true topic of a simulation, "/true/stand/length", or else the measured one,
  // "/stand/length", from the log itself; nullptr if both are missing or it has no samples.
  const signals::Series* true_or_measured(const std::string& topic) const;
  const signals::Table& table() const { return *table_; }

  // Returns an empty column to be filled row by row, stored in the same file as the log's columns.
  Column new_column() const { return Column(time_ns_.file()); }

  // Return the duration of each row [s]: of all rows, or of those in the sequence, in stance or in
  // swing, and 0 for the others.
  const Column& run() const { return seconds_; }
  const Column& sequence() const { return sequence_; }
  const Column& stance() const { return stance_; }
  const Column& swing() const { return swing_; }
  // Returns the same for rows of a phase (-1: any) whose progress is in [from, to).
  Column part(int phase, double from, double to) const;

  // Returns the phases of all steps in the order of time.
  const signals::PagedVector<PhaseSpan>& phase_spans() const { return phase_spans_; }
  std::optional<PhaseSpan> last_of(int phase) const;  // empty if the phase did not occur
  // Returns whether the log has a sequence of phases. The functions below require one.
  bool has_sequence() const { return !phase_spans_.empty(); }
  std::size_t first_row() const { return phase_spans_.front().first; }
  std::size_t last_row() const { return phase_spans_.back().last - 1; }
  // Returns the row after the sequence, or its last one if nothing was logged afterwards.
  std::size_t end_row() const { return last_row() + 1 < rows() ? last_row() + 1 : last_row(); }
  double sequence_start() const { return time(first_row()); }  // [s]
  double sequence_end() const { return end_of(last_row()); }   // [s]
  double sequence_lasts() const { return lasting(first_row(), last_row()); }

  // Returns the steps that went through every phase. The last step of a cut-off log is left out.
  std::vector<int> complete_steps() const;

 private:
  std::int64_t end_ns(std::size_t row) const {
    return row + 1 < time_ns_.size() ? time_ns_[row + 1] : time_ns_[row] + last_ns_;
  }
  const signals::Series* find_in(const signals::Table& table, std::string_view topic) const;
  const signals::Series* logged(std::string_view topic) const;  // in the log itself
  void note(const signals::Series* found, std::string_view topic) const;
  const signals::Series* base() const;  // the topic whose times the rows have
  void find_times();
  void find_phase_spans();
  // Returns the durations of the rows for which wanted(span)(row) holds, and 0 for the others.
  template <class Wanted>
  Column only(Wanted wanted) const;

  const signals::Table* table_;
  const signals::Table* more_;
  const Machine* machine_;
  std::string leg_;  // leg whose topics are read; empty for a machine with one leg
  TopicNames* read_;
  signals::Times time_ns_;
  std::int64_t last_ns_ = 0;  // duration of the last row
  Column seconds_, sequence_, stance_, swing_;
  double period_ = 0;
  signals::PagedVector<PhaseSpan> phase_spans_;
};

// Returns the values at the times `at`, each held until the next one; NaN before the first.
Column held(const signals::Times& times, const Column& values, const signals::Times& at);

}  // namespace sinew::analysis
