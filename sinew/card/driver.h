// card/driver.h - graphics cards of NVIDIA through the library of their driver.
//
//   card::Program program(0, ptx, "walk");                   // on card 0
//   card::Buffer values(program, bytes), results(program, bytes);
//   values.write(std::as_bytes(std::span(numbers)));
//   void* parameters[] = {values.parameter(), results.parameter(), &count};
//   program.launch(blocks, threads, parameters);
//   program.wait();
//   results.read(std::as_writable_bytes(std::span(numbers)));
//
// libcuda.so.1 is opened when it is first needed, with declarations of our own: neither a build nor
// a start of the program depends on it. Every function may be called from any thread. Unless
// another exception is named, a failure throws std::runtime_error with the driver's call, its error
// and a remedy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::card {

// Properties of a card that can run our programs.
struct Properties {
  int number = 0;            // the driver's number, from 0
  std::string name;          // "NVIDIA H200"
  int multiprocessors = 0;   // parts that run blocks of threads at the same time
  std::int64_t memory = 0;   // [byte]
  int major = 0, minor = 0;  // compute capability
  std::string driver;        // newest version of CUDA that the driver supports, "12.4"
};

// Returns the usable cards. Sets `problem` to the reason if the list is empty, else to "". Throws
// nothing.
std::vector<Properties> list(std::string& problem);

struct Context;

// A program on a card: a kernel that the driver has compiled, with a context of its own. A failed
// launch ends the context: all later calls fail too, until another program is made.
class Program {
 public:
  // Compiles the text in PTX for a card and finds the kernel. The compiler's messages are part of
  // the exception.
  Program(int card, std::string_view ptx, const char* kernel);
  ~Program();
  Program(Program&&) noexcept;
  Program& operator=(Program&&) noexcept;

  // Returns the memory of the card that no program uses [byte].
  std::size_t free_memory() const;

  // Starts blocks x threads copies of the kernel. Each parameter points to the value of an
  // argument, which is copied before the call returns.
  void launch(unsigned blocks, unsigned threads, std::span<void*> parameters);

  // Waits until everything that was started has ended. Throws if it failed.
  void wait();

 private:
  friend class Buffer;

  std::shared_ptr<const Context> context_;
  void* kernel_ = nullptr;
};

// Memory on the card of a program. It may live longer than the program.
class Buffer {
 public:
  // Allocates memory; its values are not set.
  Buffer(const Program& program, std::size_t bytes);
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  std::size_t size() const { return size_; }  // [byte]

  // Copy to the card and from it, from the buffer's start. read() first waits for what was started
  // before. Throw std::invalid_argument if the data is longer than the buffer.
  void write(std::span<const std::byte> data);
  void read(std::span<std::byte> data) const;

  // Returns the buffer as a parameter of Program::launch.
  void* parameter() { return &address_; }

 private:
  std::shared_ptr<const Context> context_;
  unsigned long long address_ = 0;
  std::size_t size_ = 0;
};

}  // namespace sinew::card
