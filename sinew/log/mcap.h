// log/mcap.h - bytes of an MCAP file: magic, opcodes, records and their little-endian fields.
//
// An MCAP file is a magic, a sequence of records and the magic again. A record is an opcode, a
// length of eight bytes and its content. This header covers the records that Sinew writes or reads,
// but not the meaning of their data; the format is described at mcap.dev/spec.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::log {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

// Opcodes of records.
enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::size_t kRecordHead = 9;  // opcode and length
inline constexpr std::size_t kFooterContent = 20;

using Pairs = std::vector<std::pair<std::string, std::string>>;

// Buffer to which fields are appended.
class Bytes {
 public:
  // Each appends one field: a little-endian number, bytes unchanged, or a text after its length.
  void u8(std::uint8_t v) { data_.push_back(static_cast<char>(v)); }
  void u16(std::uint16_t v) { put(v, 2); }
  void u32(std::uint32_t v) { put(v, 4); }
  void u64(std::uint64_t v) { put(v, 8); }
  void raw(std::string_view v) { data_.append(v); }
  void text(std::string_view v);

  // Open a record or a list (array, map), and close it by filling in its length. `behind` is the
  // number of bytes that will be written after these as part of the record.
  std::size_t open(Op op);
  void close(std::size_t opened, std::size_t behind = 0);
  std::size_t open_list();
  void close_list(std::size_t opened);

  // Return the bytes appended so far.
  std::string& data() { return data_; }
  std::string_view view() const { return data_; }
  std::size_t size() const { return data_.size(); }
  // Removes all bytes.
  void clear() { data_.clear(); }

 private:
  void put(std::uint64_t v, int bytes) {
    char little[8];
    for (int i = 0; i < bytes; ++i) little[i] = static_cast<char>(v >> (8 * i));
    data_.append(little, static_cast<std::size_t>(bytes));
  }
  std::string data_;
};

// Reads fields from bytes that may be damaged; reading past the end sets ok() to false.
class Fields {
 public:
  // Each reads the next field: a number, a text after its length, or a number of bytes. Past the
  // end they return 0 or an empty text, and ok() becomes false.
  explicit Fields(std::string_view bytes) : rest_(bytes) {}
  std::uint16_t u16() { return static_cast<std::uint16_t>(take(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(take(4)); }
  std::uint64_t u64() { return take(8); }
  std::string_view text() { return bytes(u32()); }
  std::string_view bytes(std::uint64_t length);
  std::string_view rest() const { return rest_; }
  bool ok() const { return ok_; }

 private:
  std::uint64_t take(std::size_t bytes);
  std::string_view rest_;
  bool ok_ = true;
};

// Record of a file.
struct Record {
  Op op;
  std::string_view content;
  std::string_view whole;  // with opcode and length
};

// Reads the records in the bytes of a file, one after the other.
class Records {
 public:
  // next() returns the next record, or nothing at the end and at a record that claims more bytes
  // than are left or has no opcode; torn() is true in the latter cases.
  explicit Records(std::string_view bytes) : rest_(bytes) {}
  std::optional<Record> next();
  bool torn() const { return torn_; }
  // Returns the bytes not yet read: after torn(), the part of a record.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  bool torn_ = false;
};

// Content of the records. The views of a parsed record point into the file.
struct Schema {
  std::uint16_t id = 0;
  std::string_view name, encoding, data;
};
struct Channel {
  std::uint16_t id = 0, schema = 0;
  std::string_view topic, encoding;
  Pairs metadata = {};
};
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;  // ns
  std::string_view data;
};
struct Chunk {
  std::uint64_t start_time = 0, end_time = 0, uncompressed_size = 0;
  std::uint32_t crc = 0;
  std::string_view compression, records;
};

// Parse a record; return nothing if the content is shorter than it claims.
std::optional<Schema> parse_schema(std::string_view content);
std::optional<Channel> parse_channel(std::string_view content);
std::optional<Message> parse_message(std::string_view content);
std::optional<Chunk> parse_chunk(std::string_view content);
// Parses the beginning of a chunk, from its opcode on, whose end is missing from the file; its
// records are the bytes that are left. Returns nothing if the chunk's head is incomplete or its
// lengths disagree: such a chunk is damaged rather than cut off.
std::optional<Chunk> parse_cut_chunk(std::string_view beginning);
std::optional<std::pair<std::string, Pairs>> parse_metadata(std::string_view content);

// Each appends one record of that kind.
void put_header(Bytes& out, std::string_view library);
void put_schema(Bytes& out, const Schema& schema);
void put_channel(Bytes& out, const Channel& channel);
void put_metadata(Bytes& out, std::string_view name, const Pairs& pairs);
void put_data_end(Bytes& out, std::uint32_t crc);

// Appends the footer and the closing magic. The checksum covers the whole summary: `out` begins at
// the start of the summary, or after a part already written, whose checksum is `before`.
void put_footer(Bytes& out, std::uint64_t summary_start, std::uint64_t summary_offset_start,
                std::uint32_t before = 0);

// Opens a message: append the data, then call out.close(opened).
std::size_t open_message(Bytes& out, std::uint16_t channel, std::uint32_t sequence,
                         std::uint64_t log_time);

}  // namespace sinew::log
