// film/process.h - child process, with pipes to it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sinew::film {

// Returns the first of these programs that is on the PATH; empty where none is.
std::filesystem::path find_program(const std::vector<std::string>& names);

// A pipe's end, closed with this.
class End {
 public:
  // Takes the end of that number; -1: none.
  explicit End(int file = -1) : file_(file) {}
  ~End() { close(); }
  // Takes what the other one had.
  End(End&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  End& operator=(End&& other) noexcept;

  // Returns its number; closes it before its time.
  int file() const { return file_; }
  void close();

 private:
  int file_;
};

// A way for bytes to a program, or from one.
struct Pipe {
  End read, write;
  // Ends that programs which are started later do not inherit. Throws std::system_error.
  static Pipe make();
};

// Gives an end of a pipe to a program as its file of that number.
struct Given {
  int file = -1, as = -1;
};

// Starts a program in a group of its own, so that Ctrl-C ends only this one, which then ends it.
// Its words go into the file `words`. Throws std::system_error.
pid_t start(const std::vector<std::string>& arguments, const std::vector<Given>& files,
            const std::filesystem::path& words);

// Waits until it has ended; -1 where it did not end by itself with a code.
int wait_for(pid_t pid);

// Returns whether it ended within that time [s].
bool ends_within(pid_t pid, double seconds);

// Ends it and what it has started.
void kill_group(pid_t pid);

// Writes the whole text. Returns false if the pipe is closed.
bool write_all(int file, std::string_view bytes);

// Returns the last lines of a program's words.
std::string last_words(const std::filesystem::path& words);

}  // namespace sinew::film
