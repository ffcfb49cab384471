// log/file.h - memory-mapped input file, append-only output file, locks, and names that a log's
// writer and reader share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sinew::log {

// Error of a log's reader or writer, and of other files that are written: file, reason and advice.
class Error : public std::runtime_error {
 public:
  // Sets what() to "file: reason; advice".
  Error(const std::filesystem::path& file, const std::string& reason, const std::string& advice)
      : std::runtime_error(file.string() + ": " + reason + "; " + advice) {}
};

// Maps a whole file without copying it, so that a log of an hour needs no memory of its own.
class Mapping {
 public:
  explicit Mapping(const std::filesystem::path& path);  // throws Error: missing, unreadable, empty

  // Maps a file that is already open; `path` is for messages.
  Mapping(int descriptor, const std::filesystem::path& path);
  ~Mapping();
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  // Returns the whole file; valid for the lifetime of this object.
  std::string_view bytes() const { return {data_, size_}; }

  // Returns the CRC-32 of the file's first bytes.
  std::uint32_t crc(std::size_t bytes) const;

  // Releases the memory of the part before `here`, which was read, so that a long log does not fill
  // memory. It is loaded from the file again if it is read again.
  void release_before(const char* here) const noexcept;

 private:
  static constexpr std::size_t stride = 1 << 22;  // released at a time [B]

  void map(int descriptor, const std::filesystem::path& path);
  void release(std::size_t from, std::size_t count) const noexcept;

  const char* data_ = nullptr;
  std::size_t size_ = 0;
  mutable std::size_t released_ = 0;  // end of the released part, a multiple of the stride
};

// New file that is only appended to. The first failure is final: its error is kept and nothing more
// is written, so that the file's content remains a prefix of the intended one. While it is open, no
// other Output of that name can be created.
class Output {
 public:
  explicit Output(const std::filesystem::path& path);  // replaces a file; throws Error
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  // Appends; returns false if not all bytes were written.
  bool write(std::string_view bytes) noexcept;
  bool sync() noexcept;  // flushes to the disk
  // Closes the file; returns false if earlier writes could not be kept by the system.
  bool close() noexcept;

  // Returns whether this same file is still at that path.
  bool is_file_at(const std::filesystem::path& path) const noexcept;

  int descriptor() const { return fd_; }  // -1: closed

  int error() const { return error_; }                  // errno of the first failure, or 0
  std::uint64_t position() const { return position_; }  // number of bytes written
  std::uint32_t crc() const { return crc_; }            // CRC-32 of all of them

 private:
  int fd_ = -1;
  int error_ = 0;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;
};

// Returns MCAP's checksum of bytes that follow others with the checksum `before`.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

// Returns the system's text for an errno: "No space left on device".
std::string system_error_text(int error);

// Names in Sinew's logs that the writer and the reader share.

inline constexpr std::string_view kSchemaEncoding = "jsonschema";
inline constexpr std::string_view kMessageEncoding = "json";
inline constexpr std::string_view kRunMetadata = "sinew.run";  // record that describes the run

// Metadata key of a channel: "unit.<field>" holds the unit of a field.
inline constexpr std::string_view kUnit = "unit.";
// Metadata key of a topic whose value never changes and is written once: holds the topic whose
// times it has.
inline constexpr std::string_view kSteady = "sinew.steady";

// --- locks of files and folders: one writing process at a time ---

// Locks the open file or folder (flock) until the descriptor is closed, at the latest when its
// process ends. Returns "" if the lock was taken, else its holder: "process 4711". On a file system
// without locks it always succeeds.
std::string lock(int descriptor);

// Waits until the lock is free.
void wait_for_lock(int descriptor);

}  // namespace sinew::log
