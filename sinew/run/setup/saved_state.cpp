#include "sinew/run/setup/saved_state.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "sinew/units/hash.h"

namespace sinew::run {
namespace {

struct SavedHeader {
  char format[16] = {};
  std::uint64_t model = 0, checksum = 0;
};
static_assert(sizeof(SavedHeader) == saved_header_size);

SavedHeader header_of(const SavedKind& kind, std::uint64_t model,
                      std::span<const std::byte> state) {
  SavedHeader out{.model = model, .checksum = units::hash(state)};
  std::strncpy(out.format, kind.format, sizeof out.format - 1);
  return out;
}

[[noreturn]] void refuse_saved(const std::string& found) {
  throw std::invalid_argument("save: found " + found);
}

}  // namespace

std::vector<std::byte> sealed(const SavedKind& kind, std::uint64_t model,
                              std::span<const std::byte> state) {
  const SavedHeader header = header_of(kind, model, state);
  std::vector<std::byte> out(sizeof header + state.size());
  std::memcpy(out.data(), &header, sizeof header);
  std::ranges::copy(state, out.begin() + sizeof header);
  return out;
}

std::span<const std::byte> unsealed(const SavedKind& kind, std::uint64_t model, std::size_t size,
                                    std::span<const std::byte> saved) {
  SavedHeader header;
  if (saved.size() < sizeof header) refuse_saved("too few bytes for one");
  std::memcpy(&header, saved.data(), sizeof header);
  const std::span<const std::byte> state = saved.subspan(sizeof header);
  const SavedHeader expected = header_of(kind, model, state);
  if (std::memcmp(header.format, expected.format, sizeof header.format) != 0)
    refuse_saved(std::string("something else; expected what ") + kind.source + " gave");
  if (header.model != model)
    refuse_saved(std::string("that of another ") + kind.model +
                 ", or of another version of Sinew; expected one of the same values");
  if (state.size() != size || header.checksum != expected.checksum)
    refuse_saved("it cut off or spoilt");
  return state;
}

}  // namespace sinew::run
