// log/lock.h - locks of files and folders: one writing process at a time.
#pragma once

#include <string>

namespace sinew::log {

// Locks the open file or folder (flock) until the descriptor is closed, at the latest when its
// process ends. Returns "" if the lock was taken, else its holder: "process 4711". On a file system
// without locks it always succeeds.
std::string lock(int descriptor);

// Waits until the lock is free.
void wait_for_lock(int descriptor);

}  // namespace sinew::log
