// firmware/semihosting.h - access of an emulated program to the host computer: the processor stops
// at BKPT 0xAB, and the emulator executes the operation in r0 with the parameter in r1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::firmware {

inline std::int32_t semihost(std::uint32_t operation, const void* parameter) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = parameter;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return static_cast<std::int32_t>(r0);
}

inline void print(const char* text) { semihost(0x04, text); }  // SYS_WRITE0

[[noreturn]] inline void quit(std::uint32_t code) {
  constexpr std::uint32_t application_exit = 0x20026;
  const std::uint32_t block[] = {application_exit, code};
  semihost(0x20, block);  // SYS_EXIT_EXTENDED
  for (;;) {}
}

inline void print_number(const char* before, std::uint32_t n) {
  std::array<char, 12> text{};
  char* p = &text[11];
  do *--p = static_cast<char>('0' + n % 10);
  while ((n /= 10) > 0);
  print(before);
  print(p);
}

// Prints the reason and ends the program with an error.
[[noreturn]] inline void fail(const char* why) {
  print(why);
  quit(1);
}

// A file of the host computer. A named pipe stops the whole machine, including its clock, while it
// waits.
class File {
 public:
  enum class For : std::uint32_t { reading = 1, writing = 5 };  // "rb", "wb"

  File(const char* name, For use) {
    std::uint32_t length = 0;
    while (name[length] != 0) ++length;
    const std::uint32_t block[] = {reinterpret_cast<std::uint32_t>(name),
                                   static_cast<std::uint32_t>(use), length};
    handle_ = semihost(0x01, block);  // SYS_OPEN
    if (handle_ < 0) fail("a pipe of the host cannot be opened\n");
  }

  // Both transfer all bytes. The program ends if the other end is closed.
  void write(std::span<const std::uint8_t> bytes) const {
    for (std::uint32_t left; !bytes.empty(); bytes = bytes.last(left)) {
      left = call(0x05, bytes.data(), bytes.size());  // SYS_WRITE
      if (left >= bytes.size()) fail("the host does not listen any more\n");
    }
  }
  void read(std::span<std::uint8_t> bytes) const {
    for (std::uint32_t left; !bytes.empty(); bytes = bytes.last(left)) {
      left = call(0x06, bytes.data(), bytes.size());  // SYS_READ
      if (left >= bytes.size()) fail("the host sends nothing any more\n");
    }
  }

 private:
  std::uint32_t call(std::uint32_t operation, const void* data, std::size_t size) const {
    const std::uint32_t block[] = {static_cast<std::uint32_t>(handle_),
                                   reinterpret_cast<std::uint32_t>(data), size};
    return static_cast<std::uint32_t>(semihost(operation, block));
  }

  std::int32_t handle_ = -1;
};

// Fills `out` with the first words of -semihosting-config arg=..., which are separated by blanks;
// returns their number. Called once.
inline std::size_t command_words(std::span<const char*> out) {
  static std::array<char, 512> text;
  const std::uint32_t block[] = {reinterpret_cast<std::uint32_t>(text.data()), text.size()};
  if (semihost(0x15, block) != 0) text[0] = 0;  // SYS_GET_CMDLINE
  std::size_t n = 0;
  out[n++] = text.data();
  for (std::size_t i = 0; text[i] != 0 && n < out.size(); ++i)
    if (text[i] == ' ') {
      text[i] = 0;
      out[n++] = &text[i + 1];
    }
  return n;
}

}  // namespace sinew::firmware
