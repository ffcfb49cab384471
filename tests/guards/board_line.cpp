#include "tests/guards/board_line.h"

#include <algorithm>
#include <utility>

namespace sinew::run {

double in(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

std::vector<std::uint8_t> Spoiler::operator()(std::vector<std::uint8_t> bytes, bool active) {
  if (kind_ == Spoil::nothing) return bytes;
  if (!active) {
    bytes.insert(bytes.begin(), held_.begin(), held_.end());
    held_.clear();
    return bytes;
  }
  if (kind_ == Spoil::silence) return {};
  if (bytes.empty() || in(random_, 0, 1) >= share_) return bytes;
  return spoil(std::move(bytes));
}

std::vector<std::uint8_t> Spoiler::spoil(std::vector<std::uint8_t> b) {
  const std::size_t at = below(b.size()), n = 1 + below(b.size() - at);
  const auto from = b.begin() + static_cast<std::ptrdiff_t>(at);
  const auto to = from + static_cast<std::ptrdiff_t>(n);
  switch (kind_) {
    case Spoil::drop:
      b.erase(from, to);
      break;
    case Spoil::flip:
      for (std::size_t i = 1 + below(16); i > 0; --i)
        b[below(b.size())] ^= static_cast<std::uint8_t>(1u << below(8));
      break;
    case Spoil::delay:
      std::swap(b, held_);
      break;
    case Spoil::duplicate: {
      const std::vector<std::uint8_t> part(from, to);
      b.insert(b.end(), part.begin(), part.end());
      break;
    }
    case Spoil::truncate:
      b.resize(at);
      break;
    case Spoil::reorder:
      std::rotate(b.begin(), from, b.end());
      break;
    case Spoil::babble:
      for (std::size_t i = below(400); i > 0; --i)
        b.insert(b.begin() + static_cast<std::ptrdiff_t>(below(b.size())),
                 static_cast<std::uint8_t>(random_()));
      break;
    default:
      break;
  }
  return b;
}

}  // namespace sinew::run
