// analysis/verdict/reported.h - figures that the source reports, compared with those of a run.
//
//   [[reported]]
//   key    = "trolley.distance_m"      of the summary
//   value  = "55 to 60 in"             as reported
//   class  = "predicted"               strength of the evidence (config/reported.h)
//   wording = "range"                  kind of statement: the band follows from it (band.h)
//   accept = ["53 in", "60 in"]        or another band, lowest and highest that agrees,
//   band_reason = "…"                  and its reason
//   source = "6.3"
//   because = "…"                      reason of a known difference
//
// The quantity's unit follows from the last part of the key, so "53 lb" for a distance is an error.
// The run's figure is shown in the source's unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/analysis/verdict/band.h"
#include "sinew/config/node.h"
#include "sinew/config/reported.h"
#include "sinew/units/constants.h"
#include "sinew/units/quantity.h"
#include "sinew/units/shown.h"

namespace sinew::analysis {

class Summary;

using config::Reported;

// Returns the SI unit of a key's ending, in the form of units/quantity.h: _m, _m_per_s, _rad,
// _rad_per_s, _N, _Nm, _Nm_per_rad, _N_s_per_m, _kg, _kg_per_m, _J, _J_per_m, _s_per_m, _per_m,
// _count, _Pa (absolute), _diff_Pa, _Hz, _s. Returns "1" for every other ending.
std::string unit_of_key(std::string_view key);
std::string_view without_unit(std::string_view key);  // "trolley.distance" of "trolley.distance_m"

// Returns the unit of the source's text; if it has none, that of `of` or `accept`, else SI.
std::string quoted_unit(const Reported&, double atmosphere = units::atmosphere);

// Returns the mistake in `accept`, or in the values that a wording needs; empty if there is no
// mistake.
std::optional<units::Mistake> mistake_in_band(const Reported&,
                                              double atmosphere = units::atmosphere);

// A figure of the source, the one of the run, and whether they agree.
struct Verdict {
  // differs_as_known: a reason is given; agrees_unexpectedly: a reason is given that no longer
  // applies.
  enum class Agreement { agrees, differs, not_applicable, differs_as_known, agrees_unexpectedly };

  std::string key;
  std::string reported;  // as reported
  std::string computed;  // "57.7 in", "93.1 %"; empty where the summary has no such key
  std::string accept;    // "53 in to 60 in"; empty without a band
  std::string source;    // with the reason of a known difference
  config::StatementClass statement_class = config::StatementClass::none;
  Wording wording = Wording::another;  // rule of `accept`
  std::string band_reason;             // reason for another band
  Agreement agreement =
      Agreement::not_applicable;  // the key or the band is missing, or the run was changed
};

std::string_view to_text(Verdict::Agreement agreement);  // "agrees", "differs as known", …

// Returns one verdict for each figure, in the order of the file. The run's figure and the band are
// in the source's unit, or in those of `shown` if it is given. Throws config::Error for a band that
// cannot be read.
std::vector<Verdict> compare(const Summary&, const std::vector<Reported>&,
                             double atmosphere = units::atmosphere,
                             const units::ShownUnits* shown = nullptr);

// Marks the reported figures as those of another run if a key of the experiment was set with --set.
// A seed, a log, a page and a title do not count.
void mark_changed(std::vector<Reported>&, const config::Node& root);

// Returns the unit of `shown` for a figure of that key, for show(): "mm", "bar gauge".
std::string shown_unit(std::string_view key, const units::ShownUnits& shown, double value);

// Formats a figure in another unit of the key's kind: one decimal from 1 on, two digits below; more
// if needed to show a difference of `resolution` in that unit.
std::string show(double si, std::string_view key, std::string_view unit,
                 double atmosphere = units::atmosphere, double resolution = 0);

// Figures of a run: summary.json.
//
// Keys are dotted, "joints.hip.min_angle_rad", values SI with the unit in the key; their
// definitions are in docs/reference/analysis.md. A key that does not apply, or whose topics the log
// lacks, is absent. Means, extremes and shares are over the phases of the sequence, without
// settling and finish.

// A figure by its key, in the SI unit that the key ends with.
struct Entry {
  std::string key;
  double value = 0;
};

// A part that was broken on purpose, by the list [[fault]].
struct MachineFault {
  std::string of, what;       // "hip_flexor.inlet", "stuck open"
  double begin = 0, end = 0;  // infinite if the fault does not end [s]
};

// Returns those that began by `last`  [s].
std::vector<MachineFault> begun_by(std::vector<MachineFault> faults, double last);

// The figures of a run in their order, with its title and its warnings.
class Summary {
 public:
  std::string title;
  std::string reproduces;
  std::string state_hash;  // all samples (state_hash.h); empty: not a whole simulated run
  bool cut_off = false;    // the log was cut off: figures of a part of the run
  std::vector<std::string> warnings;  // events that no figure shows, from the log alone
  std::vector<MachineFault> faults;   // those that began before the log's end

  // Appends a figure; one that is not finite is left out: it does not apply to this run.
  void add(std::string key, double value);
  const double* find(std::string_view key) const;  // nullptr: absent
  // Returns whether the figure exists for such runs, even if it does not apply to this one.
  bool exists(std::string_view key) const;
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::string> without_value_;  // keys of figures that do not apply
};

// Returns the most similar key of the summary; empty if the key exists or none is similar.
std::string nearest_key(std::string_view key, const Summary&);

// Throws config::Error if the key does not exist but is similar to one of the summary, and
// therefore probably misspelt; the error begins with `setting`.
void refuse_misspelt(const std::string& key, const Summary&, const std::string& setting);

// Numbers that depend on the computer of the run, and warnings of events that are not in the log.
struct Host {
  std::vector<std::pair<std::string, double>> numbers;
  std::string board;  // device at the port; empty for a simulation
  std::vector<std::string> warnings;
};

// Returns summary.json: format, title, state_hash unless it is empty, cut_off if it is true, the
// keys as nested objects in the summary's order, `faults` and `warnings` if there are any, `host`
// last. Numbers have the fewest digits that read back to the same bits. It has no dates, and only
// `host`, which comparisons leave out, depends on the computer.
std::string to_json(const Summary&, const Host& host = {});

}  // namespace sinew::analysis
