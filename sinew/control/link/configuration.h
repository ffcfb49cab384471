// control/link/configuration.h - a board's configuration as bytes, and its way over the wire.
//
// begin says how many bytes and their CRC-32, chunks follow one another without a gap, end asks for
// it to be taken. It is taken as a whole or refused as a whole: after any refusal the host begins
// anew, and the board has what it had.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sinew/control/link/configuration_fields.h"

namespace sinew::link {

// A configuration's only size.
inline constexpr std::size_t configuration_size = 3454;

using ConfigurationBytes = std::array<std::uint8_t, configuration_size>;

// Why it is not taken; `words`, where the parts contradict each other.
struct Refusal {
  Code code = Code::done;
  const char* words = nullptr;
};

// False where a field has a value that cannot be.
bool write(const Configuration& configuration, ConfigurationBytes& out) noexcept;

// All is in order, problem() of the parts included, where it answers done; else `out` is not whole.
// It needs no second Configuration, for which a small machine's stack has no room.
Refusal read(std::span<const std::uint8_t> bytes, Configuration& out) noexcept;

// A host's side: the frames to send, one after the other.
class ConfigurationSender {
 public:
  static constexpr std::size_t chunks = (configuration_size + max_chunk - 1) / max_chunk;

  // ok() is false where a field has a value that cannot be.
  explicit ConfigurationSender(const Configuration& configuration) noexcept;

  // Can it be sent at all? And the checksum of its bytes.
  bool ok() const noexcept { return ok_; }
  std::uint32_t crc() const noexcept { return crc_; }
  ConfigureBegin begin() const noexcept;
  // Returns the i-th part of its bytes.
  ConfigureChunk chunk(std::size_t i) const noexcept;
  ConfigureEnd end() const noexcept { return {crc_}; }

 private:
  ConfigurationBytes bytes_{};
  std::uint32_t crc_ = 0;
  bool ok_ = false;
};

// A board's side.
class ConfigurationReceiver {
 public:
  // Answers each message of a transfer, in their order.
  Code take(const ConfigureBegin& begin) noexcept;
  Code take(const ConfigureChunk& chunk) noexcept;
  // Where the answer is not done, `out` is not whole.
  Refusal take(const ConfigureEnd& end, Configuration& out) noexcept;

  // The transfer is over, for another reason: the line was silent, joints were armed.
  void forget() noexcept { begun_ = false; }

 private:
  Code refuse(Code why) noexcept;
  Code check(const ConfigureEnd& end) const noexcept;

  ConfigurationBytes bytes_{};
  std::size_t size_ = 0;
  std::uint32_t crc_ = 0;
  bool begun_ = false;
};

}  // namespace sinew::link
