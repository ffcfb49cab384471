// live/port.h - port of a server on 127.0.0.1.
//
// A browser stores the settings of a page by address and port, so a page keeps them only if its
// port stays: folder_port() gives each folder its own.
#pragma once

#include <cstdint>
#include <filesystem>

namespace sinew::live {

// Port at which a server listens.
struct Port {
  std::uint16_t number = 0;  // 0: a free one
  bool or_free = false;      // use a free one if the number is taken; otherwise that is an error
};

// Returns the port of a folder, the same each time, or a free one while another program uses it. It
// is below the range of ephemeral ports.
Port folder_port(const std::filesystem::path& folder);

}  // namespace sinew::live
