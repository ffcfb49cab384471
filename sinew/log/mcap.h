// log/mcap.h - the bytes of an MCAP file: magic, opcodes, records and their little-endian fields.
//
// An MCAP file is a magic, a row of records and the magic again. A record is an opcode, a length of
// eight bytes and its content. This header knows what stands in the records that Sinew writes or
// reads, and nothing of topics and numbers; the format is described at mcap.dev/spec.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::log {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

// The kinds of records, by the number in the file.
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

// Puts fields one behind the other.
class Bytes {
 public:
  // Each appends a number, little end first; bytes as they are; a text behind its length.
  void u8(std::uint8_t v) { data_.push_back(static_cast<char>(v)); }
  void u16(std::uint16_t v) { put(v, 2); }
  void u32(std::uint32_t v) { put(v, 4); }
  void u64(std::uint64_t v) { put(v, 8); }
  void raw(std::string_view v) { data_.append(v); }
  void text(std::string_view v);

  // Opens a record, and closes it by filling in its length, with so many bytes that will be written
  // behind these; likewise a list (arrays and maps).
  std::size_t open(Op op);
  void close(std::size_t opened, std::size_t behind = 0);
  std::size_t open_list();
  void close_list(std::size_t opened);

  // Returns what was appended; and forgets it.
  std::string& data() { return data_; }
  std::string_view view() const { return data_; }
  std::size_t size() const { return data_.size(); }
  // Forgets all of it.
  void clear() { data_.clear(); }

 private:
  void put(std::uint64_t v, int bytes) {
    char little[8];
    for (int i = 0; i < bytes; ++i) little[i] = static_cast<char>(v >> (8 * i));
    data_.append(little, static_cast<std::size_t>(bytes));
  }
  std::string data_;
};

// Takes fields from bytes that may be damaged: past the end it gives zeros and is no longer ok().
class Fields {
 public:
  // Each takes the next field off the bytes: a number, a text behind its length, so many bytes.
  // Beyond the end they are 0 and empty, and ok() is false.
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

// Walks through records. next() ends at the last byte, or, being torn(), at a record that claims
// more bytes than there are or has no opcode.
struct Record {
  Op op;
  std::string_view content;
  std::string_view whole;  // with opcode and length
};

// Takes records off the bytes of a file, one after the other.
class Records {
 public:
  // Returns the next one, until there is no whole one; torn() then says whether a part of one was
  // left.
  explicit Records(std::string_view bytes) : rest_(bytes) {}
  std::optional<Record> next();
  bool torn() const { return torn_; }
  // What has not been taken yet: with torn(), the part of a record.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  bool torn_ = false;
};

// The records themselves. The views of a parsed one point into the file.
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

// Nothing where the content is too short for what it claims to hold.
std::optional<Schema> parse_schema(std::string_view content);
std::optional<Channel> parse_channel(std::string_view content);
std::optional<Message> parse_message(std::string_view content);
std::optional<Chunk> parse_chunk(std::string_view content);
// The beginning of a chunk of which the file has no end, from its opcode on; its records are as
// many bytes as there are. Nothing where it has no whole head, or where the lengths in it disagree:
// such a chunk is damaged, and not cut off.
std::optional<Chunk> parse_cut_chunk(std::string_view beginning);
std::optional<std::pair<std::string, Pairs>> parse_metadata(std::string_view content);

// Each appends one record of that kind.
void put_header(Bytes& out, std::string_view library);
void put_schema(Bytes& out, const Schema& schema);
void put_channel(Bytes& out, const Channel& channel);
void put_metadata(Bytes& out, std::string_view name, const Pairs& pairs);
void put_data_end(Bytes& out, std::uint32_t crc);

// Footer and closing magic. The summary's checksum needs all of it: `out` begins where the summary
// does, or behind what was written of it, which has the checksum `before`.
void put_footer(Bytes& out, std::uint64_t summary_start, std::uint64_t summary_offset_start,
                std::uint32_t before = 0);

// Opens a message: fill in the data, then out.close(opened).
std::size_t open_message(Bytes& out, std::uint16_t channel, std::uint32_t sequence,
                         std::uint64_t log_time);

}  // namespace sinew::log
