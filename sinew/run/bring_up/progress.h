// run/bring_up/progress.h - the steps of a bring-up that are done, in a file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sinew::run {

// Holds what a channel reads while nothing moves.
struct Learned {
  double at_rest = 0, noise = 0;  // mean and standard deviation [count]
  int readings = 0;
};

// Of a joint, pulled to its ends by its muscles [count].
struct Stroke {
  double lowest = 0, highest = 0;
};

struct Progress {
  std::string robot, board;
  std::string machine;                                   // stands for all of the robot's values
  std::map<std::string, std::vector<std::string>> done;  // by the step's name: what it said
  std::map<std::string, Learned> learned;                // by the sensor's name
  std::map<std::string, Stroke> strokes;                 // by the joint's name
};

// Returns what is in the file, or nothing done where there is none. Throws config::Error for a file
// that is none of ours, or of another robot.
Progress read_progress(const std::filesystem::path& file, const std::string& robot);

// Replaces the file as a whole. Throws config::Error.
void write_progress(const Progress& progress, const std::filesystem::path& file);

// Returns the robot's file with the sensors' rest counts that were measured, over the one at
// `base`, for a file in `folder`.
std::string learned_robot(const Progress& progress, const std::filesystem::path& base,
                          const std::filesystem::path& folder);

}  // namespace sinew::run
