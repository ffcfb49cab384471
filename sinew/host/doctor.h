// host/doctor.h - is this computer ready to drive a machine? Each finding says what was found, why
// it matters, and what to do.
//
// All but the timer's latency is read from files below a root: /, or a tree that a test has made
// up.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/host/realtime.h"

namespace sinew::host {

// How serious a finding is.
enum class Verdict {
  good,
  advice,   // it goes, and would go better otherwise
  missing,  // what needs it does not go
};

// One thing that was looked at, and what it means for whoever drives a machine.
struct Finding {
  std::string subject;  // "serial devices"
  std::string place;  // what needs it: serial, emulated, comedi; empty: whatever runs in real time
  Verdict verdict = Verdict::good;
  std::string found, why, todo;  // todo: a command; empty where there is nothing to do
};

// Where the doctor looks.
struct DoctorAsked {
  std::filesystem::path root = "/";
  std::vector<std::string> programs = {"/usr/local/bin", "/usr/bin", "/bin"};  // where they are
  std::function<Latency()> latency;  // none: it is not measured
};

// Looks, and changes nothing. In the order in which one would read them.
std::vector<Finding> examine(const DoctorAsked& asked);

// Does anything lack that this kind of place needs? `simulated` needs nothing.
bool is_ready(const std::vector<Finding>& findings, const std::string& place);

// What the doctor reads of a system below a root: text, devices, the groups
// and limits of this process.

// The text of a file without what ends it; empty where there is none.
std::string text_of(const std::filesystem::path& file);

// Files of a folder whose names start so, sorted.
std::vector<std::filesystem::path> named(const std::filesystem::path& folder,
                                         const std::vector<std::string>& starts);

// Who this process is, by /proc/self/status.
struct User {
  long id = -1, group = -1;
  std::vector<long> groups;
};
User user_of(const std::filesystem::path& root);

// May the user read and write it, by owner, group and mode? The first user may everything.
bool may_use(const std::filesystem::path& file, const User& user);

// The name of the group that a file has, by etc/group; its number where there is no name.
std::string group_of(const std::filesystem::path& file, const std::filesystem::path& root);

// A soft limit by its name in /proc/self/limits; -1: unlimited, 0 where it is not told.
double limit_of(const std::filesystem::path& root, const std::string& name);

}  // namespace sinew::host
