// host/module.h - optional parts of the program in files of their own, opened on demand, so that
// the libraries that they use are needed only then.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::host {

// Returns the path of a module's file, next to the program as built or installed; empty if it is
// not found.
std::filesystem::path find_module(const char* file);

// Opens a module next to the program as built or installed, or else where the system finds it.
// Returns nullptr if it is not found. It is never closed.
void* open_module(const char* file);

// Returns a function of the module by its name; nullptr if it has none.
void* function_of(void* module, const char* name);

// Continues as another program. Throws std::runtime_error with `if_missing` if the program does not
// exist, and std::system_error if it cannot be started. `input`: text that it reads; else it has
// this program's stdin.
[[noreturn]] void continue_as(std::vector<std::string> words, const std::string& if_missing,
                              const std::string& input = "");

// Runs another program to its end and returns its exit code, 1 if a signal ended it. Throws like
// continue_as().
int exit_code_of(std::vector<std::string> words, const std::string& if_missing);

}  // namespace sinew::host
