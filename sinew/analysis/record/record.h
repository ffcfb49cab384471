// analysis/record/record.h - a log as rows: every topic at the same times, and which phase each row
// is in.
//
// Rows stand at the samples of /plan/phase, or of the first joint's angle where a log has no plan.
// Of a machine with several legs, those of the first leg's plan, or of the leg that is asked for.
// A topic with other times is held from one of its samples to the next. A row holds until the next
// one; the last one as long as the one before it.
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

using signals::Column;  // a value per row; empty: the log has no such topic

// One phase of one step: rows first .. last - 1.
struct Stretch {
  int phase = 0, step = 0;
  std::size_t first = 0, last = 0;
};

class Record {
 public:
  // `more` may hold derived series; all three outlive the record. `leg`: the name of the leg that
  // the machine is a part of (only_leg), whose topics are then called as within it.
  Record(const signals::Table& table, const Machine& machine, const signals::Table* more = nullptr,
         std::string leg = "");

  // How many rows there are, and when one begins.
  std::size_t rows() const { return seconds_.size(); }
  const signals::Times& time_ns() const { return time_ns_; }
  double time(std::size_t row) const { return static_cast<double>(time_ns_[row]) / 1e9; }  // [s]
  double end_of(std::size_t row) const { return static_cast<double>(end_ns(row)) / 1e9; }  // [s]
  // From the start of row `first` to the end of row `last`  [s].
  double lasting(std::size_t first, std::size_t last) const {
    return static_cast<double>(end_ns(last) - time_ns_[first]) / 1e9;
  }
  double lasting(const Stretch& s) const { return lasting(s.first, s.last - 1); }
  double period() const { return period_; }  // median [s]

  // Topics by the names of the machine, or as within its leg; nullptr: in none of the tables.
  const signals::Series* find(std::string_view topic) const;
  Column column(std::string_view topic, std::string_view field = "value") const;
  const signals::Table& table() const { return *table_; }

  // A column for a value per row, to be filled row by row: it goes where the log's own are.
  Column new_column() const { return Column(time_ns_.file()); }

  // How long each row holds; 0 where it does not belong  [s].
  const Column& run() const { return seconds_; }
  const Column& sequence() const { return sequence_; }
  const Column& stance() const { return stance_; }
  const Column& swing() const { return swing_; }
  // Rows of that phase (-1: any), with progress in [from, to) of its time.
  Column part(int phase, double from, double to) const;

  // The phases of all steps, as they came.
  const signals::PagedVector<Stretch>& stretches() const { return stretches_; }
  std::optional<Stretch> last_of(int phase) const;  // none: the phase never was
  // Is there a sequence of phases at all? Its first and last row are asked for only then.
  bool has_sequence() const { return !stretches_.empty(); }
  std::size_t first_row() const { return stretches_.front().first; }
  std::size_t last_row() const { return stretches_.back().last - 1; }
  // The row at which the sequence is over; its last one where nothing was logged afterwards.
  std::size_t end_row() const { return last_row() + 1 < rows() ? last_row() + 1 : last_row(); }
  double sequence_start() const { return time(first_row()); }  // [s]
  double sequence_end() const { return end_of(last_row()); }   // [s]
  double sequence_lasts() const { return lasting(first_row(), last_row()); }

  // Steps that went through every phase. Of a log that was cut the last one is not.
  std::vector<int> complete_steps() const;

 private:
  std::int64_t end_ns(std::size_t row) const {
    return row + 1 < time_ns_.size() ? time_ns_[row + 1] : time_ns_[row] + last_ns_;
  }
  const signals::Series* find_in(const signals::Table& table, std::string_view topic) const;
  const signals::Series* logged(std::string_view topic) const;  // in the log itself
  void find_times();
  void find_stretches();
  // How long each row holds for which a stretch is wanted; 0 for the others.
  template <class Wanted>
  Column only(Wanted wanted) const;  // wanted(stretch)(row)

  const signals::Table* table_;
  const signals::Table* more_;
  const Machine* machine_;
  std::string leg_;  // whose plan and foot are meant; empty: the machine's only one
  signals::Times time_ns_;
  std::int64_t last_ns_ = 0;  // how long the last row holds
  Column seconds_, sequence_, stance_, swing_;
  double period_ = 0;
  signals::PagedVector<Stretch> stretches_;
};

// Values at `at`, each held until the next one; not a number before the first.
Column held(const signals::Times& times, const Column& values, const signals::Times& at);

}  // namespace sinew::analysis
