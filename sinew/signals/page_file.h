// signals/page_file.h - a temporary file of equal pages: where the numbers of a long run stand
// while memory holds only the newest.
//
// The file has no name and is gone with the last vector that has pages in it, however the process
// ends. It lies in the folder that TMPDIR names, else in /var/tmp, which is meant for large files.
// Copies share one file. One thread at a time may write or release; reading is free to all.
// Not part of the embedded core.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace sinew::signals {

class PageFile {
 public:
  static constexpr std::size_t page_bytes = 1 << 15;
  static constexpr std::uint32_t no_page = 0xffffffff;

  PageFile() = default;    // none: its vectors stay in memory
  static PageFile make();  // the file itself is made by the first write

  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const PageFile&) const = default;  // the same file

  // Makes the file now, and room for the numbers of so many free pages, so that write() takes
  // nothing from the heap. False where no file can be made: problem() says why.
  bool open(std::size_t pages) noexcept;

  // Puts so many bytes, at most page_bytes, on a free page and returns it; no_page where they
  // cannot be written.
  std::uint32_t write(const void* bytes, std::size_t count) noexcept;

  // `count` bytes of a page that was written. False where the disk fails.
  bool rewrite(std::uint32_t page, std::size_t offset, const void* bytes,
               std::size_t count) noexcept;
  bool read(std::uint32_t page, void* bytes, std::size_t count) const noexcept;

  void release(std::uint32_t page) noexcept;  // it may be written again

  std::size_t pages() const noexcept;  // that the file has, in use or not

  // Says what failed, where, and what to do: "/var/tmp: cannot keep …: No space left on device;
  // make room there, …". Empty where nothing did.
  std::string problem() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

// Throws std::runtime_error with its problem().
[[noreturn]] void fail(const PageFile& file);

}  // namespace sinew::signals
