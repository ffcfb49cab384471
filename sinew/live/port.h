// live/port.h - where a server listens on 127.0.0.1.
//
// A browser keeps what a reader arranged for each address with its port, so pages that are to be
// found as they were left need the same port again: folder_port() gives a folder one of its own.
#pragma once

#include <cstdint>
#include <filesystem>

namespace sinew::live {

// The port that a server is to listen at.
struct Port {
  std::uint16_t number = 0;  // 0: a free one
  bool or_free = false;      // where the number is taken; else that is an error
};

// Returns the port of those who work in this folder, the same each time, or a free one while
// another program has it. It is below the ports that systems hand out to connections.
Port folder_port(const std::filesystem::path& folder);

}  // namespace sinew::live
