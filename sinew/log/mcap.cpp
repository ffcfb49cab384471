#include "sinew/log/mcap.h"

#include "sinew/log/file.h"

namespace sinew::log {

void Bytes::text(std::string_view v) {
  u32(static_cast<std::uint32_t>(v.size()));
  raw(v);
}

std::size_t Bytes::open(Op op) {
  u8(static_cast<std::uint8_t>(op));
  u64(0);
  return data_.size();
}

void Bytes::close(std::size_t opened, std::size_t behind) {
  const std::uint64_t length = data_.size() - opened + behind;
  for (std::size_t i = 0; i < 8; ++i) data_[opened - 8 + i] = static_cast<char>(length >> (8 * i));
}

std::size_t Bytes::open_list() {
  u32(0);
  return data_.size();
}

void Bytes::close_list(std::size_t opened) {
  const std::uint64_t length = data_.size() - opened;
  for (std::size_t i = 0; i < 4; ++i) data_[opened - 4 + i] = static_cast<char>(length >> (8 * i));
}

std::string_view Fields::bytes(std::uint64_t length) {
  if (length > rest_.size()) {
    ok_ = false;
    rest_ = {};
    return {};
  }
  const std::string_view taken = rest_.substr(0, length);
  rest_.remove_prefix(length);
  return taken;
}

std::uint64_t Fields::take(std::size_t count) {
  const std::string_view little = bytes(count);
  std::uint64_t v = 0;
  for (std::size_t i = little.size(); i-- > 0;) v = v << 8 | static_cast<unsigned char>(little[i]);
  return v;
}

std::optional<Record> Records::next() {
  if (rest_.empty() || torn_) return std::nullopt;
  const auto op = static_cast<std::uint8_t>(rest_.front());
  Fields head(rest_.substr(1));
  const std::uint64_t length = head.u64();
  if (op == 0 || !head.ok() || length > rest_.size() - kRecordHead) {
    torn_ = true;
    return std::nullopt;
  }
  const std::string_view whole = rest_.substr(0, kRecordHead + length);
  rest_.remove_prefix(whole.size());
  return Record{static_cast<Op>(op), whole.substr(kRecordHead), whole};
}

namespace {

template <typename T>
std::optional<T> if_ok(const Fields& fields, T value) {
  if (!fields.ok()) return std::nullopt;
  return value;
}

void put_pairs(Bytes& out, const Pairs& pairs) {
  const std::size_t list = out.open_list();
  for (const auto& [key, value] : pairs) {
    out.text(key);
    out.text(value);
  }
  out.close_list(list);
}

// Reads a list of pairs; returns whether it was complete.
bool take_pairs(std::string_view list, Pairs& out) {
  Fields f(list);
  while (f.ok() && !f.rest().empty()) {
    std::string key(f.text());
    out.emplace_back(std::move(key), f.text());
  }
  return f.ok();
}

// Reads all fields except the records.
Chunk take_chunk_head(Fields& f) {
  Chunk c;
  c.start_time = f.u64();
  c.end_time = f.u64();
  c.uncompressed_size = f.u64();
  c.crc = f.u32();
  c.compression = f.text();
  return c;
}

}  // namespace

std::optional<Schema> parse_schema(std::string_view content) {
  Fields f(content);
  Schema s;
  s.id = f.u16();
  s.name = f.text();
  s.encoding = f.text();
  s.data = f.text();
  return if_ok(f, s);
}

std::optional<Channel> parse_channel(std::string_view content) {
  Fields f(content);
  Channel c;
  c.id = f.u16();
  c.schema = f.u16();
  c.topic = f.text();
  c.encoding = f.text();
  // Other programs may write any content there.
  if (!take_pairs(f.text(), c.metadata)) c.metadata.clear();
  return if_ok(f, c);
}

std::optional<Message> parse_message(std::string_view content) {
  Fields f(content);
  Message m;
  m.channel = f.u16();
  m.sequence = f.u32();
  m.log_time = f.u64();
  f.u64();  // publish_time
  m.data = f.rest();
  return if_ok(f, m);
}

std::optional<Chunk> parse_chunk(std::string_view content) {
  Fields f(content);
  Chunk c = take_chunk_head(f);
  c.records = f.bytes(f.u64());
  return if_ok(f, c);
}

std::optional<Chunk> parse_cut_chunk(std::string_view beginning) {
  if (!beginning.starts_with(static_cast<char>(Op::chunk))) return std::nullopt;
  Fields f(beginning.substr(1));
  const std::uint64_t length = f.u64();
  const std::size_t before = f.rest().size();
  Chunk c = take_chunk_head(f);
  const std::uint64_t records = f.u64();
  const std::size_t head = before - f.rest().size();
  if (!f.ok() || length < head || records != length - head) return std::nullopt;
  c.records = f.rest();
  return c;
}

std::optional<std::pair<std::string, Pairs>> parse_metadata(std::string_view content) {
  Fields f(content);
  std::pair<std::string, Pairs> named;
  named.first = f.text();
  if (!take_pairs(f.text(), named.second)) return std::nullopt;
  return if_ok(f, std::move(named));
}

void put_header(Bytes& out, std::string_view library) {
  const std::size_t record = out.open(Op::header);
  out.text("");  // no profile
  out.text(library);
  out.close(record);
}

void put_schema(Bytes& out, const Schema& schema) {
  const std::size_t record = out.open(Op::schema);
  out.u16(schema.id);
  out.text(schema.name);
  out.text(schema.encoding);
  out.text(schema.data);
  out.close(record);
}

void put_channel(Bytes& out, const Channel& channel) {
  const std::size_t record = out.open(Op::channel);
  out.u16(channel.id);
  out.u16(channel.schema);
  out.text(channel.topic);
  out.text(channel.encoding);
  put_pairs(out, channel.metadata);
  out.close(record);
}

void put_metadata(Bytes& out, std::string_view name, const Pairs& pairs) {
  const std::size_t record = out.open(Op::metadata);
  out.text(name);
  put_pairs(out, pairs);
  out.close(record);
}

void put_data_end(Bytes& out, std::uint32_t crc) {
  const std::size_t record = out.open(Op::data_end);
  out.u32(crc);
  out.close(record);
}

void put_footer(Bytes& out, std::uint64_t summary_start, std::uint64_t summary_offset_start,
                std::uint32_t before) {
  const std::size_t record = out.open(Op::footer);
  out.u64(summary_start);
  out.u64(summary_offset_start);
  // The checksum covers the footer's length, so the length is filled in first.
  out.u32(0);
  out.close(record);
  out.data().resize(out.size() - 4);
  out.u32(crc32(out.view(), before));
  out.raw(kMagic);
}

std::size_t open_message(Bytes& out, std::uint16_t channel, std::uint32_t sequence,
                         std::uint64_t log_time) {
  const std::size_t record = out.open(Op::message);
  out.u16(channel);
  out.u32(sequence);
  out.u64(log_time);
  out.u64(log_time);  // publish_time
  return record;
}

}  // namespace sinew::log
