#include "sinew/live/port.h"

#include <string>
#include <system_error>

namespace sinew::live {
namespace {

constexpr std::uint32_t first = 20000, count = 10000;

// FNV-1a hash, which is the same on every computer and with every library.
std::uint32_t hash(const std::string& text) {
  std::uint32_t out = 2166136261u;
  for (const char c : text) out = (out ^ static_cast<unsigned char>(c)) * 16777619u;
  return out;
}

}  // namespace

Port folder_port(const std::filesystem::path& folder) {
  std::error_code gone;
  std::filesystem::path whole = std::filesystem::weakly_canonical(folder, gone);
  if (!whole.has_filename()) whole = whole.parent_path();  // "/home/me/" is "/home/me"
  const std::string name = (gone ? folder : whole).string();
  return {.number = static_cast<std::uint16_t>(first + hash(name) % count), .or_free = true};
}

}  // namespace sinew::live
