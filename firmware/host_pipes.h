// firmware/host_pipes.h - the two pipes between an emulated program and its host. They carry
// records as sinew/control/board/lock_step.h defines them. Output is buffered until send().
#pragma once

#include <array>
#include <new>
#include <utility>

#include "firmware/semihosting.h"
#include "sinew/control/board/lock_step.h"

namespace sinew::firmware {

// Storage for an object that is constructed later: the language's start-up code does not run here.
template <class T>
struct Room {
  alignas(T) std::uint8_t bytes[sizeof(T)];

  template <class... Arguments>
  T& make(Arguments&&... arguments) {
    return *new (bytes) T(std::forward<Arguments>(arguments)...);
  }
};

class Host {
 public:
  // Opens the pipes to and from the host.
  Host(const char* to, const char* from)
      : to_(to, File::For::writing), from_(from, File::For::reading) {}

  template <class T>
  void put(T number) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      byte(static_cast<std::uint8_t>(number));
      if constexpr (sizeof(T) > 1) number = static_cast<T>(number >> 8);
    }
  }
  void put(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t b : bytes) byte(b);
  }
  void send() {
    to_.write({out_.data(), size_});
    size_ = 0;
  }
  std::uint16_t number() {
    std::array<std::uint8_t, 2> b;
    from_.read(b);
    return static_cast<std::uint16_t>(b[0] | b[1] << 8);
  }
  void get(std::span<std::uint8_t> bytes) { from_.read(bytes); }

  // Reply to a request for a reading: a number, and a signals::Status or a board::failure.
  struct Converted {
    std::uint16_t number;
    std::uint8_t status;
  };
  // Requests the reading of a channel; `tick` is that of the run.
  Converted convert(std::uint64_t tick, std::uint8_t channel) {
    put(board::record::reading);
    put(tick);
    put(channel);
    send();
    std::array<std::uint8_t, 3> b;
    get(b);
    return {static_cast<std::uint16_t>(b[0] | b[1] << 8), b[2]};
  }
  // Puts the state of the valves from this tick on.
  template <class Mask>
  void put_valves(std::uint64_t tick, Mask open, bool current, bool supply) {
    put(board::record::valves);
    put(tick);
    put(open);
    put(static_cast<std::uint8_t>((current ? board::has_current : 0) |
                                  (supply ? board::has_supply : 0)));
  }

 private:
  void byte(std::uint8_t b) {
    if (size_ == out_.size()) send();
    out_[size_++] = b;
  }

  File to_, from_;
  std::array<std::uint8_t, 2'048> out_;
  std::size_t size_ = 0;
};

}  // namespace sinew::firmware
