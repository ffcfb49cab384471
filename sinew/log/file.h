// log/file.h - a file read as a view, or appended to; and the words that a log's writer and
// reader share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sinew::log {

// A whole file as bytes, mapped and not copied, so that an hour's log needs no memory of its own.
class Mapping {
 public:
  explicit Mapping(const std::filesystem::path& path);  // throws Error: missing, unreadable, empty

  // Maps a file that is open already; `path` is for messages.
  Mapping(int descriptor, const std::filesystem::path& path);
  ~Mapping();
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  // Returns the whole file, for as long as this lives.
  std::string_view bytes() const { return {data_, size_}; }

  // CRC-32 of its first bytes.
  std::uint32_t crc(std::size_t bytes) const;

  // Says that it was read up to there, so that a long log takes up no memory behind the reader.
  // What is read again comes from the file again.
  void forget_before(const char* here) const noexcept;

 private:
  static constexpr std::size_t stride = 1 << 22;  // forgotten at a time [B]

  void map(int descriptor, const std::filesystem::path& path);
  void forget(std::size_t from, std::size_t count) const noexcept;

  const char* data_ = nullptr;
  std::size_t size_ = 0;
  mutable std::size_t forgotten_ = 0;  // up to there, a multiple of the stride
};

// A new file that is only appended to. The first failure is final: it is kept, and nothing more is
// written, so that what stands in the file remains a prefix of what was meant. While it is open
// nobody else can make an Output of that name.
class Output {
 public:
  explicit Output(const std::filesystem::path& path);  // replaces a file; throws Error
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  // Appends. False: it did not get there.
  bool write(std::string_view bytes) noexcept;
  bool sync() noexcept;  // to the disk
  // False: the system could not keep what was written before.
  bool close() noexcept;

  // Does this very file still stand under that name?
  bool stands_at(const std::filesystem::path& path) const noexcept;

  int descriptor() const { return fd_; }  // -1: closed

  int error() const { return error_; }                  // errno of the first failure, or 0
  std::uint64_t position() const { return position_; }  // bytes written
  std::uint32_t crc() const { return crc_; }            // CRC-32 of all of them

 private:
  int fd_ = -1;
  int error_ = 0;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;
};

// Returns the checksum of MCAP, of the bytes behind those that had the checksum `before`.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

// "No space left on device": the system's words for an errno.
std::string system_words(int error);

// The words that Sinew's logs use and that its writer and its reader must share.

inline constexpr std::string_view kSchemaEncoding = "jsonschema";
inline constexpr std::string_view kMessageEncoding = "json";
inline constexpr std::string_view kRunMetadata = "sinew.run";  // the record that says what was run

// Metadata of a channel: "unit.<field>" says in which unit a field is.
inline constexpr std::string_view kUnit = "unit.";
// A topic whose value never changes is written once, and says here: the topic at whose times it
// stands.
inline constexpr std::string_view kSteady = "sinew.steady";

}  // namespace sinew::log
