// signals/page_file.h - a temporary file of equal pages: storage for the samples of a long
// run, of which memory holds only the newest.
//
// The file has no name and is removed with the last vector that has pages in it, however the
// process ends. Its folder is that in TMPDIR, else /var/tmp, which is meant for large files. Copies
// share one file. One thread at a time may write or release; any number may read. Not part of the
// embedded core.
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

  PageFile() = default;    // no file: its vectors stay in memory
  static PageFile make();  // the file itself is made by the first write

  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const PageFile&) const = default;  // whether both are the same file

  // Creates the file now, and reserves a list of `pages` free pages, so that write() does not
  // allocate. Returns false if no file can be created; problem() then has the reason.
  bool open(std::size_t pages) noexcept;

  // Writes `count` bytes, at most page_bytes, to a free page and returns its number; no_page if
  // they cannot be written.
  std::uint32_t write(const void* bytes, std::size_t count) noexcept;

  // rewrite() and read() transfer `count` bytes of a written page. They return false if the disk
  // fails.
  bool rewrite(std::uint32_t page, std::size_t offset, const void* bytes,
               std::size_t count) noexcept;
  bool read(std::uint32_t page, void* bytes, std::size_t count) const noexcept;

  void release(std::uint32_t page) noexcept;  // the page may be written again

  std::size_t pages() const noexcept;  // in the file, used or not

  // Returns a message about the failure, its place and a remedy: "/var/tmp: cannot keep …: No space
  // left on device; make room there, …"; empty if nothing failed.
  std::string problem() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

// Throws std::runtime_error with the file's problem().
[[noreturn]] void fail(const PageFile& file);

}  // namespace sinew::signals
