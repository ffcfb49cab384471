// host/doctor.h - check whether this computer is ready to drive a machine. Each finding has a
// result, its importance, and advice.
//
// Everything except the timer's latency and the graphics cards is read from files below a root: /,
// or a tree made by a test.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/card/driver.h"
#include "sinew/host/realtime.h"
#include "sinew/json/json.h"

namespace sinew::host {

// Severity of a finding.
enum class Verdict {
  good,
  advice,   // works, but could be improved
  missing,  // the features that need it do not work
};

// Result of one check, for the operator of a machine.
struct Finding {
  std::string subject;  // "serial devices"
  std::string place;    // serial, emulated, comedi; empty: needed for real time in general
  Verdict verdict = Verdict::good;
  std::string found, why, todo;  // todo: a command; empty: nothing to do
};

// Input of the checks.
struct DoctorOptions {
  std::filesystem::path root = "/";
  std::vector<std::string> programs = {"/usr/local/bin", "/usr/bin", "/bin"};  // their folders
  std::function<Latency()> latency;                                          // empty: not measured
  std::function<std::vector<card::Properties>(std::string& problem)> cards;  // card::list; empty:
                                                                             // not examined
  bool has_card_program = false;  // this build has a program for graphics cards (card/walk.h)
  // Returns the walks of test 1 that a card makes per second, or nothing. Throws std::runtime_error
  // if the card fails. Empty: not measured.
  std::function<std::optional<double>(const card::Properties&)> card_speed;
};

// Runs all checks and changes nothing. The findings are in the order in which they should be read.
std::vector<Finding> examine(const DoctorOptions& options);

// Returns whether everything that this kind of place needs is available. `simulated` needs nothing.
bool is_ready(const std::vector<Finding>& findings, const std::string& place);

// Return the findings as text, with missing ones in red if `color`, and in format sinew.doctor/1.
std::string text_of(const std::vector<Finding>& findings, bool color);
Json json_of(const std::vector<Finding>& findings, const std::string& place);

// Readers of system files below a root: text, devices, groups and limits of this process.

// Returns the text of a file without blanks and line ends at its end; empty if it does not exist.
std::string text_of(const std::filesystem::path& file);

// Returns the files of a folder whose names begin with one of `starts`, sorted.
std::vector<std::filesystem::path> named(const std::filesystem::path& folder,
                                         const std::vector<std::string>& starts);

// User of this process, from /proc/self/status.
struct User {
  long id = -1, group = -1;
  std::vector<long> groups;
};
User user_of(const std::filesystem::path& root);

// Returns whether the user may read and write the file, by owner, group and mode. User 0 always
// may.
bool has_access(const std::filesystem::path& file, const User& user);

// Returns the name of a file's group from etc/group, or its number if it has no name.
std::string group_of(const std::filesystem::path& file, const std::filesystem::path& root);

// Returns a soft limit by its name in /proc/self/limits; -1: unlimited, 0: not listed.
double limit_of(const std::filesystem::path& root, const std::string& name);

}  // namespace sinew::host
