#include "sinew/log/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

#include "sinew/log/mcap.h"
#include "sinew/log/message.h"
#include "sinew/log/steady.h"

namespace sinew::log {
namespace {

using std::filesystem::path;

void check_magic(const path& file, std::string_view bytes) {
  if (bytes.starts_with(kMagic)) return;
  if (kMagic.starts_with(bytes))
    throw Error(file, fmt::format("the log ends after {} bytes", bytes.size()),
                "it was cut off before anything was written: run the experiment again");
  std::string found;
  for (const char c : bytes.substr(0, kMagic.size()))
    found += fmt::format(" {:02x}", static_cast<unsigned char>(c));
  throw Error(file, fmt::format("not an MCAP file: it begins with{}", found),
              "expected 89 4d 43 41 50 30 0d 0a; name a run's log.mcap");
}

// Collects a file's records in a table.
class Collector {
 public:
  Collector(const path& file, const Mapping& mapping)
      : file_(file), mapping_(mapping), bytes_(mapping.bytes()) {}

  signals::Table table();

 private:
  // Returns false if the record is damaged, so that nothing after it can be trusted.
  bool take(const Record& record);
  bool take_schema(std::string_view content);
  bool take_channel(std::string_view content);
  void add_series(std::uint16_t channel, signals::Topic topic, const Pairs& metadata);
  bool take_message(std::string_view content);
  bool take_chunk(std::string_view content);
  void take_cut_chunk(std::string_view beginning);
  bool take_records(const Chunk& chunk);
  bool leave_out();
  void repeat_steady();
  bool ends_properly(const Record& last) const;

  struct Source {  // channel that is read
    std::size_t series;
    MessageFormat format;
  };

  const path& file_;
  const Mapping& mapping_;
  const std::string_view bytes_;
  std::map<std::uint16_t, Schema> schemas_;
  // Keyed by channel number; null for a channel that is skipped.
  std::map<std::uint16_t, std::unique_ptr<Source>> sources_;
  // Topics of channels with an open schema, until a first message shows the fields.
  std::map<std::uint16_t, std::string> open_;
  const signals::PageFile pages_ = signals::PageFile::make();
  std::vector<signals::Series> series_;
  std::vector<std::pair<std::size_t, std::string>> steady_;  // series, topic with its times
  std::vector<double> values_;
  bool whole_ = true;  // false: a message was damaged
};

signals::Table Collector::table() {
  Records records(bytes_.substr(kMagic.size()));
  bool ended = false;
  while (const auto record = records.next()) {
    if (record->op == Op::data_end || record->op == Op::footer) {
      ended = ends_properly(*record);
      break;
    }
    if (!take(*record)) break;
    mapping_.release_before(record->whole.data());
  }
  if (records.torn()) take_cut_chunk(records.rest());
  repeat_steady();
  return {std::move(series_), ended && whole_};
}

void Collector::repeat_steady() {
  for (const auto& [series, topic] : steady_) {
    const auto times = std::ranges::find(
        series_, topic,
        [](const signals::Series& s) -> const std::string& { return s.topic.name; });
    if (times != series_.end()) repeat(series_[series], *times);
  }
}

bool Collector::take(const Record& record) {
  switch (record.op) {
    case Op::schema:
      return take_schema(record.content);
    case Op::channel:
      return take_channel(record.content);
    case Op::message:
      return take_message(record.content);
    case Op::chunk:
      return take_chunk(record.content);
    default:
      return true;  // indexes, attachments, and additions of later versions
  }
}

bool Collector::take_schema(std::string_view content) {
  const auto schema = parse_schema(content);
  if (schema) schemas_.try_emplace(schema->id, *schema);
  return schema.has_value();
}

bool Collector::take_channel(std::string_view content) {
  const auto channel = parse_channel(content);
  if (!channel) return false;
  const auto [source, is_new] = sources_.try_emplace(channel->id, nullptr);
  const auto schema = schemas_.find(channel->schema);
  if (!is_new || channel->encoding != kMessageEncoding) return true;
  const bool has_schema = schema != schemas_.end() && schema->second.encoding == kSchemaEncoding;
  auto topic = has_schema ? from_schema(schema->second.data, channel->topic) : std::nullopt;
  if (topic)
    add_series(channel->id, std::move(*topic), channel->metadata);
  else if (schema == schemas_.end() || is_open_schema(schema->second.data))
    open_.emplace(channel->id, channel->topic);
  return true;
}

void Collector::add_series(std::uint16_t channel, signals::Topic topic, const Pairs& metadata) {
  // Other programs' logs may have two channels of one topic: only the first is read.
  for (const signals::Series& series : series_)
    if (series.topic.name == topic.name) return;
  sources_[channel] = std::make_unique<Source>(Source{series_.size(), MessageFormat(topic)});
  for (const auto& [key, value] : metadata)
    if (key == kSteady) steady_.emplace_back(series_.size(), value);
  const std::size_t fields = topic.fields.size();
  series_.push_back({std::move(topic), signals::Times(pages_),
                     std::vector<signals::Column>(fields, signals::Column(pages_))});
}

// Skips a damaged message, after which the next one can still be found.
bool Collector::leave_out() {
  whole_ = false;
  return true;
}

bool Collector::take_message(std::string_view content) {
  const auto message = parse_message(content);
  if (!message) return false;
  const auto source = sources_.find(message->channel);
  if (source == sources_.end()) return leave_out();
  if (const auto open = open_.find(message->channel); open != open_.end()) {
    auto topic = from_message(message->data, open->second);
    open_.erase(open);
    if (topic) add_series(message->channel, std::move(*topic), {});
  }
  if (!source->second) return true;
  const MessageFormat& format = source->second->format;
  values_.resize(format.fields());
  if (!format.parse(message->data, values_)) return leave_out();

  signals::Series& series = series_[source->second->series];
  series.time_ns.push_back(static_cast<std::int64_t>(message->log_time));
  for (std::size_t i = 0; i < values_.size(); ++i) series.columns[i].push_back(values_[i]);
  return true;
}

bool Collector::take_chunk(std::string_view content) {
  const auto chunk = parse_chunk(content);
  if (!chunk) return false;
  const bool known = chunk->compression.empty();
  if (known && chunk->crc != 0 && chunk->crc != crc32(chunk->records)) return false;
  return take_records(*chunk);
}

// Takes the complete records of a chunk that was cut off: as its messages are in the order in which
// they were logged, all topics reach the end of the file. Its checksum covers all records and
// cannot be compared.
void Collector::take_cut_chunk(std::string_view beginning) {
  if (const auto chunk = parse_cut_chunk(beginning)) take_records(*chunk);
}

bool Collector::take_records(const Chunk& chunk) {
  if (chunk.compression == "zstd" || chunk.compression == "lz4")
    throw Error(file_, fmt::format("the log is compressed with {}", chunk.compression),
                "write an uncompressed copy with `mcap decompress IN -o OUT` and read that");
  if (!chunk.compression.empty()) return false;
  Records records(chunk.records);
  while (const auto record = records.next())
    if (record->op == Op::chunk || !take(*record)) return false;
  return !records.torn();
}

// Checks the data's checksum, if there is one, and the end of the file.
bool Collector::ends_properly(const Record& last) const {
  const std::size_t tail = kRecordHead + kFooterContent + kMagic.size();
  const auto at = static_cast<std::size_t>(last.whole.data() - bytes_.data());
  if (last.op == Op::data_end) {
    Fields fields(last.content);
    const std::uint32_t crc = fields.u32();
    if (!fields.ok() || (crc != 0 && crc != mapping_.crc(at))) return false;
    if (bytes_.size() < at + last.whole.size() + tail) return false;
  } else if (bytes_.size() != at + tail) {
    return false;
  }
  Records end(bytes_.substr(bytes_.size() - tail, tail - kMagic.size()));
  const auto footer = end.next();
  return footer && footer->op == Op::footer && bytes_.ends_with(kMagic);
}

// Sorts samples by time; in most logs they are already sorted.
void sort_by_time(signals::Series& series) {
  if (std::is_sorted(series.time_ns.begin(), series.time_ns.end())) return;
  std::vector<std::size_t> order(series.time_ns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return series.time_ns[a] < series.time_ns[b];
  });
  const auto reorder = [&](auto& values) {
    std::decay_t<decltype(values)> sorted(values.file());
    for (const std::size_t i : order) sorted.push_back(values[i]);
    values = std::move(sorted);
  };
  reorder(series.time_ns);
  for (auto& column : series.columns) reorder(column);
}

}  // namespace

signals::Table read(const path& file) {
  const Mapping mapping(file);
  check_magic(file, mapping.bytes());
  signals::Table table = Collector(file, mapping).table();
  for (signals::Series& series : table.series) sort_by_time(series);
  return table;
}

Pairs read_metadata(const path& file) {
  const Mapping mapping(file);
  check_magic(file, mapping.bytes());
  Records records(mapping.bytes().substr(kMagic.size()));
  while (const auto record = records.next()) {
    if (record->op != Op::metadata) continue;
    auto metadata = parse_metadata(record->content);
    if (metadata && metadata->first == kRunMetadata) return std::move(metadata->second);
  }
  return {};
}

}  // namespace sinew::log
