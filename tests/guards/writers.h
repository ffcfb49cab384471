// tests/guards/writers.h - every command that writes a file or a folder, over an older one: its
// content before and after the command, and ways to disturb the command.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace sinew::test {

struct Writer {
  std::string name;
  Words old, fresh;    // leave an older and a newer result at the same place
  Words refused;       // such that the old result must remain
  std::string target;  // a file, or the folder of a run or of figures

  bool is_run() const { return fresh[0] == "run" || fresh[0] == "import"; }
  bool is_folder() const { return is_run() || fresh[0] == "figures"; }
};

// prepare() makes the files that the commands read. Commands that need the page are left out of a
// program that is built without one.
std::vector<Writer> writers(const Workspace& w);
void prepare(const Workspace& w);

// Names and contents, of a single file under "". Of a run without unfinished files, and of its
// summary without wall time. Empty if there is nothing.
using State = std::map<std::string, std::string>;
State state(const std::filesystem::path& target);

// "": they are the same; else the names that differ.
std::string difference(const State& found, const State& expected);

// The older and the newer result, and the older one again in its place.
struct Results {
  State old, fresh;
};
Results both(const Workspace& w, const Writer& writer);
std::string neither(const State& found, const Results& results);  // "": one of the two
void put_back(const Workspace& w, const Writer& writer);          // after both()

// A process of the program with its output in a pipe, so that limits on files do not reach it.
struct Started {
  pid_t pid = -1;
  int output = -1;  // stdout and stderr
};
struct Ended {
  int code = -1;  // -1: by a signal
  std::string output;
};
Started start(const Workspace& w, const Words& words, const std::function<void()>& before = {});
Ended ended(const Started& process);
Ended run(const Workspace& w, const Words& words, const std::function<void()>& before = {});

// Returns the number of tries of a guard: SINEW_GUARD_COUNT where it is set, else `usual`.
int tries(int usual);

}  // namespace sinew::test
