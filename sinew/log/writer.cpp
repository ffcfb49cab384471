#include "sinew/log/writer.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "sinew/json/json.h"
#include "sinew/log/mcap.h"
#include "sinew/log/message.h"
#include "sinew/log/replacement.h"

namespace sinew::log {

namespace {

// A long log has longer chunks, so that less has to be stored about them until the end.
constexpr std::size_t kChunkBytes = 1 << 20, kLongChunkBytes = 1 << 23, kLong = 1 << 24;

struct Span {  // range of times; 0 to 0 without messages, as the format requires
  std::uint64_t first = 0, last = 0;
  std::uint64_t count = 0;
  void add(std::uint64_t t) {
    first = count ? std::min(first, t) : t;
    last = count ? std::max(last, t) : t;
    ++count;
  }
};

// Copies records to another file, with messages in chunks, and adds the summary.
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
  const Pairs& run_;  // replaces the description of the run; empty: the file's
  const SteadyTopics& steady_;

  // Chunk being filled: its records, and (time, offset) of each message per channel.
  Bytes chunk_;
  Span chunk_time_;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places_;
  // Position of each channel's message index, for the chunk's index.
  std::vector<std::pair<std::uint16_t, std::uint64_t>> index_places_;

  // Contents of the summary.
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
    source.release_before(record->whole.data());
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
  output_.write(record.whole);  // only messages are in chunks
}

// Copies a channel; a steady one is marked with the topic whose times it has.
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
  // The chunk is written after its head, to avoid a copy.
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

// Appends an index per channel, which follows the chunk, `at` bytes after its beginning; sorted by
// time, as messages may come in any order.
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

// Writes groups of records, one per opcode, then the position of each group, then the footer.
void Indexer::put_summary() {
  const std::uint64_t start = output_.position();
  Bytes statistics;
  put_statistics(statistics);
  Bytes out;  // positions of the groups, and the footer
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
  const std::filesystem::path temporary = file.string() + ".tmp";
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw Error(file, "cannot index the log: " + why,
                "the log is whole and can be read, only its index is missing");
  };
  const Mapping source(row.descriptor(), file);
  Output output(temporary);
  if (!Indexer(output, run, steady).copy(source) || !output.sync())
    fail(output.error() ? system_error_text(output.error()) : "the file is damaged");

  // Both names may belong to another program's files by now.
  std::error_code error;
  if (!row.is_file_at(file) || !output.is_file_at(temporary)) {
    if (output.is_file_at(temporary)) std::filesystem::remove(temporary, error);
    throw Error(file, "another log has taken its place while it was written",
                "one run at a time in a folder");
  }
  std::filesystem::rename(temporary, file, error);
  if (error) fail(error.message());
  if (const int unsynced = sync_folder(file.parent_path())) fail(system_error_text(unsynced));
}

namespace {

using std::filesystem::path;
using Topics = std::vector<signals::Topic>;

void check(const path& file, const Topics& topics) {
  if (topics.size() > 0xFFFE) throw Error(file, "too many topics", "log fewer than 65535");
  std::set<std::string_view> names;
  for (const signals::Topic& topic : topics) {
    if (!names.insert(topic.name).second)
      throw Error(file, fmt::format("topic {} stands twice in the list", topic.name),
                  "give every topic a name of its own");
    const std::size_t count = topic.fields.size();
    if (count < 1 || count > kMaxFields)
      throw Error(file, fmt::format("topic {} has {} fields", topic.name, count),
                  fmt::format("a topic has 1 to {}: split it", kMaxFields));
    std::set<std::string_view> fields;
    for (const signals::Field& field : topic.fields)
      if (!fields.insert(field.name).second)
        throw Error(file, fmt::format("topic {} has two fields {}", topic.name, field.name),
                    "give every field a name of its own");
  }
}

// Returns the bytes before the first message: library, run and topics. Topic i has schema and
// channel i + 1, since 0 is not a valid schema.
std::string front(const path& file, const Topics& topics, const Pairs& metadata,
                  const std::string& version) {
  Bytes out;
  out.raw(kMagic);
  put_header(out, version.empty() ? "sinew" : "sinew " + version);
  put_metadata(out, kRunMetadata, metadata);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const signals::Topic& topic = topics[i];
    const auto id = static_cast<std::uint16_t>(i + 1);
    try {
      const std::string schema = to_schema(topic);
      put_schema(out, {id, topic.name, kSchemaEncoding, schema});
    } catch (const JsonError&) {
      throw Error(file, fmt::format("topic {} has text that is not UTF-8", i + 1),
                  "write its name, description and units in UTF-8");
    }
    put_channel(out, {id, id, topic.name, kMessageEncoding, to_metadata(topic)});
  }
  return std::move(out.data());
}

std::vector<std::string> names_of(const Topics& topics) {
  std::vector<std::string> out;
  for (const signals::Topic& topic : topics) out.push_back(topic.name);
  return out;
}

}  // namespace

struct Writer::Impl {
  Impl(path file_path, const Topics& topics, const Pairs& metadata, const Options& options);
  ~Impl() { stop(); }

  bool push(std::uint16_t topic, std::int64_t time_ns, std::span<const double> values) noexcept;
  void stop() noexcept;
  void finish(const Pairs& metadata);

 private:
  void run() noexcept;
  void write_waiting();
  void encode(const Sample& sample);
  void fail_unless_written() const;

  const path file_;
  const Options options_;
  const std::vector<std::string> topics_;  // topic names
  std::vector<MessageFormat> formats_;     // one per topic
  Ring ring_;
  Output output_;

  // Used only by the loop.
  bool closed_ = false;

  bool begun_ = false;  // whether the bytes before the samples were written

  // Used only by the thread.
  Bytes pending_;
  std::vector<std::uint32_t> sequence_;  // one per topic
  std::vector<Steadiness> steadiness_;   // one per topic

  // Shared. The mutex is only for the thread's sleep; the loop never locks it.
  std::atomic<bool> stopping_{false};
  std::atomic<bool> failed_{false};
  std::mutex sleep_;
  std::condition_variable wake_;
  std::thread thread_;

 public:
  std::atomic<std::uint64_t> waits{0};
};

Writer::Impl::Impl(path file_path, const Topics& topics, const Pairs& metadata,
                   const Options& options)
    : file_(std::move(file_path)),
      options_(options),
      topics_(names_of(topics)),
      formats_(topics.begin(), topics.end()),
      ring_(options.ring),
      output_(file_),
      sequence_(topics.size(), 0),
      steadiness_(topics.size()) {
  if (!output_.write(front(file_, topics, metadata, options.version))) fail_unless_written();
  begun_ = true;
  pending_.data().reserve(1 << 20);
  thread_ = std::thread([this] { run(); });
}

bool Writer::Impl::push(std::uint16_t topic, std::int64_t time_ns,
                        std::span<const double> values) noexcept {
  if (closed_ || topic >= formats_.size() || values.size() != formats_[topic].fields() ||
      failed_.load(std::memory_order_relaxed))
    return false;
  Sample sample{time_ns, topic, {}};
  std::copy(values.begin(), values.end(), sample.values.begin());
  if (ring_.put(sample)) return true;

  waits.fetch_add(1, std::memory_order_relaxed);
  while (!ring_.put(sample)) {
    wake_.notify_one();
    std::this_thread::yield();
  }
  return true;
}

// Thread: sleeps, and writes new samples. It continues to empty the ring if the file can no longer
// be written, so that the loop never waits for a full disk.
void Writer::Impl::run() noexcept {
  for (;;) {
    const bool last = stopping_.load(std::memory_order_acquire);
    try {
      write_waiting();
    } catch (const std::bad_alloc&) {
      failed_.store(true, std::memory_order_relaxed);
    }
    if (last) return;
    if (ring_.waiting() > ring_.capacity() / 2) continue;
    std::unique_lock lock(sleep_);
    if (!stopping_.load(std::memory_order_acquire)) wake_.wait_for(lock, options_.period);
  }
}

void Writer::Impl::write_waiting() {
  pending_.clear();
  ring_.take_all([&](const Sample& sample) {
    if (!failed_.load(std::memory_order_relaxed)) encode(sample);
  });
  if (!failed_.load(std::memory_order_relaxed) && !output_.write(pending_.view()))
    failed_.store(true, std::memory_order_relaxed);
}

void Writer::Impl::encode(const Sample& sample) {
  const MessageFormat& format = formats_[sample.topic];
  const std::size_t record =
      open_message(pending_, static_cast<std::uint16_t>(sample.topic + 1),
                   sequence_[sample.topic]++, static_cast<std::uint64_t>(sample.time_ns));
  const std::size_t begin = pending_.size();
  format.append(pending_.data(), std::span(sample.values).first(format.fields()));
  steadiness_[sample.topic].add(sample.time_ns, pending_.view().substr(begin));
  pending_.close(record);
}

void Writer::Impl::stop() noexcept {
  if (!thread_.joinable()) return;
  closed_ = true;
  {
    const std::lock_guard lock(sleep_);
    stopping_.store(true, std::memory_order_release);
  }
  wake_.notify_one();
  thread_.join();
}

void Writer::Impl::finish(const Pairs& metadata) {
  if (!thread_.joinable()) return;
  stop();
  fail_unless_written();

  // Writes the end of a file without a summary, then replaces the file by one with a summary.
  Bytes end;
  put_data_end(end, output_.crc());
  Bytes footer;
  put_footer(footer, 0, 0);
  end.raw(footer.view());
  output_.write(end.view());
  fail_unless_written();
  make_indexed(output_, file_, metadata, steady_topics(topics_, steadiness_));
  output_.close();
}

void Writer::Impl::fail_unless_written() const {
  if (output_.error() == 0 && !failed_.load()) return;
  const std::string why = output_.error() ? system_error_text(output_.error()) : "out of memory";
  throw Error(file_,
              fmt::format("cannot write the log: {}; it ends after {} bytes, and all later samples "
                          "are lost",
                          why, output_.position()),
              begun_ ? "make room and run again; what is in the file can be read"
                     : "make room and run again");
}

Writer::Writer(const path& file, Topics topics, Pairs metadata, Options options) {
  check(file, topics);
  impl_ = std::make_unique<Impl>(file, topics, metadata, options);
}

Writer::~Writer() = default;

bool Writer::push(std::uint16_t topic, std::int64_t time_ns,
                  std::span<const double> values) noexcept {
  return impl_->push(topic, time_ns, values);
}

std::uint64_t Writer::waits() const noexcept {
  return impl_->waits.load(std::memory_order_relaxed);
}

void Writer::finish(const Pairs& metadata) { impl_->finish(metadata); }

}  // namespace sinew::log
