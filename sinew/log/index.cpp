#include "sinew/log/index.h"

#include <algorithm>
#include <map>
#include <system_error>

#include "sinew/log/error.h"
#include "sinew/log/file.h"
#include "sinew/log/mcap.h"
#include "sinew/log/names.h"
#include "sinew/log/replacement.h"

namespace sinew::log {
namespace {

// The chunks of a long log are longer, so that little has to be kept of each of them until the end.
constexpr std::size_t kChunkBytes = 1 << 20, kLongChunkBytes = 1 << 23, kLong = 1 << 24;

struct Span {  // of time; as the format wants it, zero to zero without messages
  std::uint64_t first = 0, last = 0;
  std::uint64_t count = 0;
  void add(std::uint64_t t) {
    first = count ? std::min(first, t) : t;
    last = count ? std::max(last, t) : t;
    ++count;
  }
};

// Copies the records of one file into another, the messages in chunks, and adds the summary.
class Indexer {
 public:
  Indexer(Output& output, const Pairs& metadata, const SteadyTopics& steady)
      : output_(output), run_(metadata), steady_(steady) {}

  bool copy(const Mapping& source);

 private:
  void copy(const Record& record);
  void copy_channel(const Record& record);
  void copy_metadata(const Record& record);
  void add_message(const Record& record);
  void end_chunk();
  void put_message_indexes(Bytes& out, std::uint64_t at);
  void put_statistics(Bytes& out) const;
  void put_summary();

  Output& output_;
  std::size_t chunk_bytes_ = kChunkBytes;
  const Pairs& run_;  // what was run, in place of what the file says; empty: that
  const SteadyTopics& steady_;

  // The chunk being filled: its records, and per channel (time, offset) of each message.
  Bytes chunk_;
  Span chunk_time_;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places_;
  // Where the message index of a channel went, for the chunk's index.
  std::vector<std::pair<std::uint16_t, std::uint64_t>> index_places_;

  // What the summary will say.
  Bytes schemas_, channels_, chunk_indexes_, metadata_indexes_;
  std::uint16_t schema_count_ = 0;
  std::uint32_t channel_count_ = 0, metadata_count_ = 0, chunk_count_ = 0;
  std::map<std::uint16_t, std::uint64_t> message_counts_;
  Span time_;
};

bool Indexer::copy(const Mapping& source) {
  if (source.bytes().size() >= kLong) chunk_bytes_ = kLongChunkBytes;
  output_.write(kMagic);
  Records records(source.bytes().substr(kMagic.size()));
  while (const auto record = records.next()) {
    if (record->op == Op::data_end) break;
    copy(*record);
    source.forget_before(record->whole.data());
  }
  end_chunk();
  Bytes end;
  put_data_end(end, output_.crc());
  output_.write(end.view());
  put_summary();
  return !records.torn() && output_.error() == 0;
}

void Indexer::copy(const Record& record) {
  switch (record.op) {
    case Op::message:
      return add_message(record);
    case Op::schema:
      schemas_.raw(record.whole);
      ++schema_count_;
      break;
    case Op::channel:
      return copy_channel(record);
    case Op::metadata:
      return copy_metadata(record);
    default:
      break;
  }
  output_.write(record.whole);  // only messages stand in chunks
}

// A steady one says so, and at whose times it stands.
void Indexer::copy_channel(const Record& record) {
  Bytes out;
  auto channel = parse_channel(record.content);
  const auto steady = channel ? steady_.find(channel->id) : steady_.end();
  if (steady == steady_.end()) {
    out.raw(record.whole);
  } else {
    channel->metadata.emplace_back(kSteady, steady->second);
    put_channel(out, *channel);
  }
  channels_.raw(out.view());
  ++channel_count_;
  output_.write(out.view());
}

void Indexer::copy_metadata(const Record& record) {
  const std::string name(Fields(record.content).text());
  Bytes out;
  if (name == kRunMetadata && !run_.empty())
    put_metadata(out, name, run_);
  else
    out.raw(record.whole);
  const std::size_t index = metadata_indexes_.open(Op::metadata_index);
  metadata_indexes_.u64(output_.position());
  metadata_indexes_.u64(out.size());
  metadata_indexes_.text(name);
  metadata_indexes_.close(index);
  ++metadata_count_;
  output_.write(out.view());
}

void Indexer::add_message(const Record& record) {
  const auto message = parse_message(record.content);
  if (!message) return;
  if (message->sequence > 0 && steady_.contains(message->channel)) return;
  chunk_time_.add(message->log_time);
  time_.add(message->log_time);
  ++message_counts_[message->channel];
  places_[message->channel].emplace_back(message->log_time, chunk_.size());
  chunk_.raw(record.whole);
  if (chunk_.size() >= chunk_bytes_) end_chunk();
}

void Indexer::end_chunk() {
  if (chunk_.size() == 0) return;
  const std::uint64_t start = output_.position();
  Bytes out;
  const std::size_t record = out.open(Op::chunk);
  out.u64(chunk_time_.first);
  out.u64(chunk_time_.last);
  out.u64(chunk_.size());
  out.u32(crc32(chunk_.view()));
  out.text("");  // not compressed
  out.u64(chunk_.size());
  // The chunk stands behind its head, and is not copied for that.
  out.close(record, chunk_.size());
  const std::uint64_t chunk_length = out.size() + chunk_.size();
  output_.write(out.view());
  output_.write(chunk_.view());
  out.clear();
  put_message_indexes(out, chunk_length);
  output_.write(out.view());

  const std::size_t index = chunk_indexes_.open(Op::chunk_index);
  chunk_indexes_.u64(chunk_time_.first);
  chunk_indexes_.u64(chunk_time_.last);
  chunk_indexes_.u64(start);
  chunk_indexes_.u64(chunk_length);
  const std::size_t list = chunk_indexes_.open_list();
  for (const auto& [channel, place] : index_places_) {
    chunk_indexes_.u16(channel);
    chunk_indexes_.u64(start + place);
  }
  chunk_indexes_.close_list(list);
  chunk_indexes_.u64(out.size());
  chunk_indexes_.text("");
  chunk_indexes_.u64(chunk_.size());
  chunk_indexes_.u64(chunk_.size());
  chunk_indexes_.close(index);
  ++chunk_count_;
  chunk_.clear();
  chunk_time_ = {};
}

// One per channel, behind the chunk, `at` bytes from its beginning; sorted by time, whatever order
// the messages came in.
void Indexer::put_message_indexes(Bytes& out, std::uint64_t at) {
  index_places_.clear();
  for (auto& [channel, places] : places_) {
    std::sort(places.begin(), places.end());
    index_places_.emplace_back(channel, at + out.size());
    const std::size_t record = out.open(Op::message_index);
    out.u16(channel);
    const std::size_t list = out.open_list();
    for (const auto& [time, offset] : places) {
      out.u64(time);
      out.u64(offset);
    }
    out.close_list(list);
    out.close(record);
  }
  places_.clear();
}

void Indexer::put_statistics(Bytes& out) const {
  const std::size_t record = out.open(Op::statistics);
  out.u64(time_.count);
  out.u16(schema_count_);
  out.u32(channel_count_);
  out.u32(0);  // attachments
  out.u32(metadata_count_);
  out.u32(chunk_count_);
  out.u64(time_.first);
  out.u64(time_.last);
  const std::size_t list = out.open_list();
  for (const auto& [channel, count] : message_counts_) {
    out.u16(channel);
    out.u64(count);
  }
  out.close_list(list);
  out.close(record);
}

// Groups of records, one per opcode; then where each group stands; then the footer.
void Indexer::put_summary() {
  const std::uint64_t start = output_.position();
  Bytes statistics;
  put_statistics(statistics);
  Bytes out;  // where the groups are, and the footer
  std::uint32_t crc = 0;
  const auto group = [&](Op op, const Bytes& records) {
    if (records.size() == 0) return;
    const std::size_t record = out.open(Op::summary_offset);
    out.u8(static_cast<std::uint8_t>(op));
    out.u64(output_.position());
    out.u64(records.size());
    out.close(record);
    crc = crc32(records.view(), crc);
    output_.write(records.view());
  };
  group(Op::schema, schemas_);
  group(Op::channel, channels_);
  group(Op::statistics, statistics);
  group(Op::chunk_index, chunk_indexes_);
  group(Op::metadata_index, metadata_indexes_);
  put_footer(out, start, output_.position(), crc);
  output_.write(out.view());
}

}  // namespace

void make_indexed(const Output& row, const std::filesystem::path& file, const Metadata& run,
                  const SteadyTopics& steady) {
  const std::filesystem::path beside = file.string() + ".tmp";
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw Error(file, "cannot index the log: " + why,
                "the log is whole and can be read, only its index is missing");
  };
  const Mapping source(row.descriptor(), file);
  Output output(beside);
  if (!Indexer(output, run, steady).copy(source) || !output.sync())
    fail(output.error() ? system_words(output.error()) : "the file is damaged");

  // By their names both could be somebody else's by now.
  std::error_code error;
  if (!row.stands_at(file) || !output.stands_at(beside)) {
    if (output.stands_at(beside)) std::filesystem::remove(beside, error);
    throw Error(file, "another log has taken its place while it was written",
                "one run at a time in a folder");
  }
  std::filesystem::rename(beside, file, error);
  if (error) fail(error.message());
  if (const int unsynced = sync_folder(file.parent_path())) fail(system_words(unsynced));
}

}  // namespace sinew::log
