// analysis/verdict/summary.h - a run in numbers: summary.json.
//
// Keys are dotted, "joints.hip.min_angle_rad", values SI with the unit in the key; what each means
// stands in docs/reference/analysis.md. A key that does not apply, or whose topics the log lacks,
// is absent. Means, extremes and shares are over the phases of the sequence; settling and finish
// are left out.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::analysis {

// A figure by its key, in the SI unit that the key ends with.
struct Entry {
  std::string key;
  double value = 0;
};

// A part that was broken on purpose, by the list [[fault]].
struct MachineFault {
  std::string of, what;       // "hip_flexor.inlet", "stuck open"
  double begin = 0, end = 0;  // no end: infinite [s]
};

// Returns those that began by `last`  [s].
std::vector<MachineFault> begun_by(std::vector<MachineFault> faults, double last);

class Summary {
 public:
  std::string title;
  std::string reproduces;
  bool cut_off = false;               // its log was: these are the figures of a part of the run
  std::vector<std::string> warnings;  // what went on that no figure shows, of the log alone
  std::vector<MachineFault> faults;   // those that began before the log's end

  // Keys come in a fixed order. What is not finite is not added.
  void add(std::string key, double value);
  const double* find(std::string_view key) const;  // nullptr: absent
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

// Numbers that depend on the computer that ran, and warnings of what only the run itself saw and
// its log does not hold.
struct Host {
  std::vector<std::pair<std::string, double>> numbers;
  std::string board;  // who ran it, where that was no simulation
  std::vector<std::string> warnings;
};

// summary.json: format, title, cut_off where it is true, the keys as nested objects in the
// summary's order, `faults` and `warnings` where there are any, `host` last. Numbers have the
// fewest digits that read back to the same bits. No dates, nothing of the machine that ran but
// `host`, which comparisons leave out.
std::string to_json(const Summary&, const Host& host = {});

}  // namespace sinew::analysis
