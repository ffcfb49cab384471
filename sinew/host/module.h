// host/module.h - parts of the program that are files of their own, opened by those who need them:
// whoever does not neither needs nor loads the libraries behind them.
#pragma once

#include <filesystem>

namespace sinew::host {

// Returns where a module's file is, beside the program as it is built or installed; empty where
// there is none.
std::filesystem::path find_module(const char* file);

// Opens a module beside the program, as it is built and as it is installed, else wherever the
// system finds it. Returns nullptr where there is none. It stays open.
void* open_module(const char* file);

// Returns a function of it by its name; nullptr where it has none.
void* function_of(void* module, const char* name);

}  // namespace sinew::host
