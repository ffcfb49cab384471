// analysis/verdict/reported.h - what the source reports beside what came out.
//
//   [[reported]]
//   key    = "trolley.distance_m"      of the summary
//   value  = "55 to 60 in"             as reported
//   class  = "predicted"               what agreement is worth (config/reported.h)
//   wording = "range"                  how it is said: the band follows from it (band.h)
//   accept = ["53 in", "60 in"]        or another band, lowest and highest that agrees,
//   band_reason = "…"                  and why
//   source = "6.3"
//   because = "…"                      why ours is known to differ, where it does
//
// The quantity's unit follows from the last part of the key, so "53 lb" for a distance is an error.
// Our own figure is shown in the unit in which the source speaks.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/analysis/verdict/band.h"
#include "sinew/config/node.h"
#include "sinew/config/quantity.h"
#include "sinew/config/reported.h"
#include "sinew/units/constants.h"
#include "sinew/units/shown.h"

namespace sinew::analysis {

class Summary;

using config::Reported;

// The SI unit that a key's ending stands for, as config/quantity.h wants it: _m, _m_per_s, _rad,
// _rad_per_s, _N, _Nm, _Nm_per_rad, _N_s_per_m, _kg, _kg_per_m, _per_m, _count, _Pa (absolute),
// _diff_Pa, _Hz, _s. "1" for every other ending.
std::string unit_of_key(std::string_view key);
std::string_view without_unit(std::string_view key);  // "trolley.distance" of "trolley.distance_m"

// Returns the unit in which the source speaks; where its text has none, that of `accept`, else SI.
std::string spoken_unit(const Reported&, double atmosphere = units::atmosphere);

// Returns what is wrong with `accept` or with the words that a wording needs, or nothing.
std::optional<config::Mistake> mistake_in_band(const Reported&,
                                               double atmosphere = units::atmosphere);

// Holds what a source reports of a run beside what the run did, and whether they agree.
struct Verdict {
  // differs_as_known: with the reason; agrees_after_all: the reason is no more.
  enum class Is { agrees, differs, not_applicable, differs_as_known, agrees_after_all };

  std::string key;
  std::string reported;  // as reported
  std::string ours;      // "57.7 in", "93.1 %"; empty where the summary has no such key
  std::string accept;    // "53 in to 60 in"; empty where nothing is judged
  std::string source;    // and the reason of what is known to differ
  config::StatementClass statement_class = config::StatementClass::none;
  Wording wording = Wording::another;  // which rule `accept` follows
  std::string band_reason;             // of another band
  Is is = Is::not_applicable;  // no such key in the summary, nothing to judge by, or a changed run
};

std::string_view to_text(Verdict::Is is);  // "agrees", "differs as known", …

// One verdict each, in the order of the file. Our figure and the band are in the unit in which the
// source speaks, or in `shown`, where there are some. Throws config::Error for an `accept` that
// cannot be read.
std::vector<Verdict> compare(const Summary&, const std::vector<Reported>&,
                             double atmosphere = units::atmosphere,
                             const units::ShownUnits* shown = nullptr);

// Marks what is reported where a key of the experiment, as it was composed or kept, was set with
// --set: the source describes another run. A seed, a log, a page and a title change nothing.
void mark_changed(std::vector<Reported>&, const config::Node& root);

// Returns the unit in which `shown` has a figure of that key, for show(): "mm", "bar gauge".
std::string shown_unit(std::string_view key, const units::ShownUnits& shown, double value);

// For people, in another unit of the key's kind: one decimal from 1 on, two digits below; more
// where a judgement hangs on them: `resolution` in that unit is a difference that must show.
std::string show(double si, std::string_view key, std::string_view unit,
                 double atmosphere = units::atmosphere, double resolution = 0);

// A run in numbers: summary.json.
//
// Keys are dotted, "joints.hip.min_angle_rad", values SI with the unit in the key; what each means
// stands in docs/reference/analysis.md. A key that does not apply, or whose topics the log lacks,
// is absent. Means, extremes and shares are over the phases of the sequence; settling and finish
// are left out.

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

// Holds the figures of a run in their order, with its title and its warnings.
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
