// control/link/configuration.h - a board's configuration as bytes, and its transfer over the wire.
//
// begin has the number of bytes and their CRC-32, chunks follow without a gap, end requests that it
// takes effect. It is accepted or refused as a whole: after a refusal the host begins again, and
// the board keeps its previous configuration.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sinew/control/link/configuration_fields.h"

namespace sinew::link {

// Size of every configuration.
inline constexpr std::size_t configuration_size = 3454;

using ConfigurationBytes = std::array<std::uint8_t, configuration_size>;

// Reason for a refusal; `words` if the parts contradict each other.
struct Refusal {
  Code code = Code::done;
  const char* words = nullptr;
};

// Writes a configuration. Returns false if a field has an invalid value.
bool write(const Configuration& configuration, ConfigurationBytes& out) noexcept;

// Reads a configuration and checks problem() of its parts. If the result is not done, `out` is
// incomplete. It needs no second Configuration, for which the stack of a microcontroller is too
// small.
Refusal read(std::span<const std::uint8_t> bytes, Configuration& out) noexcept;

// Sender of the host: the frames in order.
class ConfigurationSender {
 public:
  static constexpr std::size_t chunks = (configuration_size + max_chunk - 1) / max_chunk;

  // ok() is false if a field has an invalid value.
  explicit ConfigurationSender(const Configuration& configuration) noexcept;

  // Return whether it can be sent, and the checksum of its bytes.
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

// Receiver of the board.
class ConfigurationReceiver {
 public:
  // Return the reply to a message of a transfer; messages must be in order.
  Code take(const ConfigureBegin& begin) noexcept;
  Code take(const ConfigureChunk& chunk) noexcept;
  // If the reply is not done, `out` is incomplete.
  Refusal take(const ConfigureEnd& end, Configuration& out) noexcept;

  // Ends the transfer for another reason: the line was silent, or joints were armed.
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
