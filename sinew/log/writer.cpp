#include "sinew/log/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "sinew/json/json.h"
#include "sinew/log/file.h"
#include "sinew/log/index.h"
#include "sinew/log/mcap.h"
#include "sinew/log/message.h"
#include "sinew/log/names.h"
#include "sinew/log/ring.h"
#include "sinew/log/steady.h"

namespace sinew::log {
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

// What stands before the first message: which library, which run, which topics. Topic i has schema
// and channel i + 1, since a schema must not be number 0.
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
  const std::vector<std::string> topics_;  // their names
  std::vector<MessageFormat> formats_;     // per topic
  Ring ring_;
  Output output_;

  // The loop's.
  bool closed_ = false;

  bool begun_ = false;  // the file has what is before the samples

  // The thread's.
  Bytes pending_;
  std::vector<std::uint32_t> sequence_;  // per topic
  std::vector<Steadiness> steadiness_;   // per topic

  // Between the two. The mutex belongs to the thread's sleep alone; the loop never takes it.
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

// The thread: sleeps, and writes what has come. It goes on emptying the ring when the file can no
// longer be written, so that the loop never waits for a disk that is full.
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

  // The end of a file without a summary; then the file with one.
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
  const std::string why = output_.error() ? system_words(output_.error()) : "out of memory";
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
