// tune/notes.h - why a row's figures are what they are. The same words stand in a table's status,
// and in a study's file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::tune {

struct Ran;

struct Notes {
  std::vector<std::string> lacks;    // keys that the summary of its run does not have
  std::vector<std::string> differs;  // keys whose value differs from what a source reports
  bool stop_reached = false;         // by the trolley: distance and mean speed are up to there
  bool no_air = false;               // no muscle took any, whatever the plan commanded
  bool out_of_reach = false;         // the foot was: the nearest point was aimed at

  bool operator==(const Notes&) const = default;
};

// The keys that are missing, or differ, are some of `keys`. A run without figures has no notes.
Notes notes_of(const Ran& ran, const std::vector<std::string>& keys);

// "without foot.extension_time_s; reaches the end of the track; uses no air; aims out of reach;
// differs in trolley.distance_m": what applies of it, empty where nothing does.
std::string to_text(const Notes& notes);

// Returns `status`, or the notes in place of an "ok", or both.
std::string status_with(const Notes& notes, std::string_view status);

}  // namespace sinew::tune
