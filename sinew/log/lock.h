// log/lock.h - who may write a file or a folder: one process at a time.
#pragma once

#include <string>

namespace sinew::log {

// Locks what is open there (flock) until the descriptor is closed, at the latest with its process.
// Returns "" where the lock was taken, else who holds it: "process 4711". A file system that knows
// no locks refuses nobody.
std::string lock(int descriptor);

// Waits for whoever holds it.
void wait_for_lock(int descriptor);

}  // namespace sinew::log
