#include "sinew/live/token.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <stdexcept>

namespace sinew::live {

std::string random_token() {
  std::array<unsigned char, 16> bits{};
  // So few bytes come whole, or not at all.
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size()))
    throw std::runtime_error("the operating system has no random numbers for a token");
  std::string token;
  for (const unsigned char b : bits) token += fmt::format("{:02x}", b);
  return token;
}

bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

}  // namespace sinew::live
