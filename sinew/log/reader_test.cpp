#include "sinew/log/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "sinew/log/fixtures_test.h"
#include "sinew/log/mcap.h"
#include "sinew/log/message.h"

namespace sinew::log::reader_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Reader, ReportsWhatIsWrongWithTheFile) {
  const Folder folder;
  const auto error = [&] { return error_of([&] { read(folder / "log.mcap"); }); };
  EXPECT_THAT(error(), HasSubstr("log.mcap: cannot open the log: No such file or directory; "));
  put_bytes(folder / "log.mcap", "");
  EXPECT_THAT(error(), HasSubstr("the file is empty"));
  put_bytes(folder / "log.mcap", "time [s],x\n0,1\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("not an MCAP file: it begins with 74 69 6d 65 20 5b 73 5d"),
                             HasSubstr("expected 89 4d 43 41 50")));
  put_bytes(folder / "log.mcap", kMagic.substr(0, 5));
  EXPECT_THAT(error(), HasSubstr("ends after 5 bytes"));
  EXPECT_THAT(error_of([&] { read(folder.path()); }), HasSubstr("not a file"));
}

TEST(Reader, ReportsWhatWasRun) {
  const Folder folder;
  for (const bool finished : {false, true}) {
    write_log(folder / "log.mcap", random_table(1, 5), finished);
    EXPECT_EQ(read_metadata(folder / "log.mcap"), (Pairs{{"experiment", "test"}, {"seed", "1"}}));
  }
}

// Everything before a cut is read, wherever it is, and never less than from a shorter log.
void cut_everywhere(bool finished) {
  const Folder folder;
  const signals::Table table = random_table(3, 12);
  write_log(folder / "whole.mcap", table, finished);
  const std::string bytes = bytes_of(folder / "whole.mcap");
  std::size_t most = 0;
  for (std::size_t n = kMagic.size(); n < bytes.size(); ++n) {
    put_bytes(folder / "cut.mcap", std::string_view(bytes).substr(0, n));
    const signals::Table cut = read(folder / "cut.mcap");
    ASSERT_FALSE(cut.complete) << n;
    expect_same(cut, table, /*prefix=*/true);
    ASSERT_GE(messages_in(cut), most) << n;
    most = messages_in(cut);
  }
  const signals::Table whole = read(folder / "whole.mcap");
  EXPECT_EQ(whole.complete, finished);
  expect_same(whole, table);
  // An indexed log has its summary last, a plain one its last message.
  EXPECT_EQ(most + !finished, messages_in(table));
}

// A cut log lacks at most the message at the cut, also in the last chunk, which is a megabyte. Both
// kinds of log are cut at seeded places.
TEST(Reader, ACutLosesOneMessageAtMost) {
  const Folder folder;
  std::mt19937_64 random(21);
  signals::Table table;
  signals::Series& s = table.series.emplace_back();
  s.topic = {"/muscle/tension", "", {{"value", "N"}}};
  s.columns.resize(1);
  for (int i = 0; i < 25'000; ++i) {
    s.time_ns.push_back(i * 1'000'000LL);
    s.columns[0].push_back(any_double(random));
  }
  for (const bool finished : {false, true}) {
    write_log(folder / "whole.mcap", table, finished);
    const std::string bytes = bytes_of(folder / "whole.mcap");
    for (int trial = 0; trial < 10; ++trial) {
      const std::string_view cut =
          std::string_view(bytes).substr(0, 1000 + random() % (bytes.size() - 1000));
      put_bytes(folder / "cut.mcap", cut);
      std::size_t begun = 0;
      for (std::size_t at = 0; (at = cut.find("{\"value\":", at)) != cut.npos; ++at)
        begun += cut.compare(at, 10, "{\"value\":{") != 0;
      const signals::Table read_back = read(folder / "cut.mcap");
      expect_same(read_back, table, /*prefix=*/true);
      ASSERT_GE(messages_in(read_back) + 1, begun) << "cut after " << cut.size() << " bytes";
    }
  }
}

TEST(Reader, PlainLogCutAnywhere) { cut_everywhere(false); }
TEST(Reader, IndexedLogCutAnywhere) { cut_everywhere(true); }

// Damage must not end the program, and damage in the data of a complete file must be noticed.
void damage(bool finished, int trials) {
  const Folder folder;
  const signals::Table table = random_table(4, 20);
  write_log(folder / "whole.mcap", table, finished);
  const std::string bytes = bytes_of(folder / "whole.mcap");
  const std::size_t data_end = bytes.rfind(std::string("\x0f\x04\0\0\0\0\0\0\0", 9));
  std::mt19937_64 random(finished ? 11 : 12);
  for (int trial = 0; trial < trials; ++trial) {
    std::string damaged = bytes;
    for (std::size_t i = 0, n = 1 + random() % 3; i < n; ++i) {
      const std::size_t at = kMagic.size() + random() % (bytes.size() - kMagic.size());
      // Lengths filled with ones are the most likely to mislead the reader.
      damaged[at] = random() % 4 ? static_cast<char>(random()) : '\xFF';
    }
    put_bytes(folder / "damaged.mcap", damaged);
    const signals::Table read_back = read(folder / "damaged.mcap");
    ASSERT_LE(messages_in(read_back), messages_in(table));
    // Every byte of the data of a finished log is under a checksum.
    const bool same_data = damaged.compare(0, data_end, bytes, 0, data_end) == 0;
    ASSERT_FALSE(finished && !same_data && read_back.complete) << "trial " << trial;
    for (const signals::Series& s : read_back.series)
      for (const auto& column : s.columns) ASSERT_EQ(column.size(), s.time_ns.size());
    read_metadata(folder / "damaged.mcap");
  }
}

TEST(Reader, DamagedPlainLogsAreSurvived) { damage(false, 4000); }
TEST(Reader, DamagedIndexedLogsAreSurvived) { damage(true, 4000); }

TEST(Reader, AbsurdLengthsTakeNoMemory) {
  const Folder folder;
  for (const Op op : {Op::schema, Op::channel, Op::message, Op::chunk, Op::metadata}) {
    Bytes file;
    file.raw(kMagic);
    const std::size_t record = file.open(op);
    for (int i = 0; i < 8; ++i) file.u64(~std::uint64_t{0});
    file.close(record);
    put_bytes(folder / "log.mcap", file.view());
    EXPECT_FALSE(read(folder / "log.mcap").complete || messages_in(read(folder / "log.mcap")));
    EXPECT_TRUE(read_metadata(folder / "log.mcap").empty());
  }
}

// Log of another program, with everything that Sinew itself does not write.
class Foreign {
 public:
  Foreign() {
    out_.raw(kMagic);
    put_header(out_, "other");
  }

  void channel(std::uint16_t id, std::string_view topic, std::string_view schema,
               std::string_view encoding = "json") {
    put_schema(out_, {id, topic, encoding == "json" ? "jsonschema" : "ros2msg", schema});
    put_channel(out_, {id, id, topic, encoding});
  }
  void message(std::uint16_t channel, std::uint64_t time, std::string_view data) {
    const std::size_t record = open_message(out_, channel, 0, time);
    out_.raw(data);
    out_.close(record);
  }
  void compressed_chunk(std::string_view compression) {
    const std::size_t record = out_.open(Op::chunk);
    for (const std::uint64_t v : {0, 0, 3}) out_.u64(v);  // times, size
    out_.u32(0);                                          // no checksum
    out_.text(compression);
    out_.u64(3);
    out_.raw("abc");
    out_.close(record);
  }
  void unknown_record() {
    out_.u8(0x90);
    out_.u64(2);
    out_.raw("??");
  }
  signals::Table read_back(bool with_data_end = true) {
    if (with_data_end) put_data_end(out_, 0);
    Bytes footer;
    put_footer(footer, 0, 0);
    out_.raw(footer.view());
    put_bytes(folder_ / "foreign.mcap", out_.view());
    return read(folder_ / "foreign.mcap");
  }

 private:
  Folder folder_;
  Bytes out_;
};

const char* const kPose =
    R"({"type":"object","properties":{"name":{"type":"string"},"x":{"type":"number","unit":"m"},)"
    R"("on":{"type":"boolean"},"n":{"type":"integer"},"deep":{"type":"object"}}})";

TEST(Reader, TakesTheNumbersOfForeignLogs) {
  Foreign log;
  log.channel(5, "/pose", kPose);
  log.message(5, 10, R"({ "x": 1.5, "name": "a", "on": true, "n": 3, "deep": {"x": 9} })");
  log.unknown_record();
  log.message(5, 30, R"({"n": 4})");
  log.message(5, 20, R"({"x": "text", "on": false, "n": 5})");
  const signals::Table table = log.read_back();
  EXPECT_TRUE(table.complete);
  ASSERT_EQ(table.series.size(), 1u);
  const signals::Series& s = table.series[0];
  EXPECT_EQ(s.time_ns, (std::vector<std::int64_t>{10, 20, 30}));  // sorted
  ASSERT_EQ(s.topic.fields.size(), 3u);
  EXPECT_EQ(s.topic.fields[0].unit, "m");
  EXPECT_EQ(s.columns[0][0], 1.5);
  EXPECT_TRUE(std::isnan(s.columns[0][1]) && std::isnan(s.columns[0][2]));
  EXPECT_EQ(s.columns[1][0], 1.0);
  EXPECT_EQ(s.columns[2], (std::vector<double>{3, 5, 4}));
}

TEST(Reader, PassesOverWhatItCannotUse) {
  Foreign log;
  log.channel(1, "/image", "bytes", "cdr");
  log.channel(2, "/text", R"({"type":"object","properties":{"t":{"type":"string"}}})");
  log.channel(3, "/list", R"([1, 2])");
  log.channel(4, "/broken", R"({"type":)");
  log.channel(5, "/pose", kPose);
  log.channel(6, "/pose", kPose);  // a second publisher
  for (std::uint16_t id = 1; id <= 6; ++id) log.message(id, id, R"({"x":1})");
  const signals::Table table = log.read_back(/*with_data_end=*/false);
  EXPECT_TRUE(table.complete);
  ASSERT_EQ(table.series.size(), 1u);
  EXPECT_EQ(table.series[0].time_ns, (std::vector<std::int64_t>{5}));
}

TEST(Reader, DamagedMessageIsLeftOut) {
  Foreign log;
  log.channel(1, "/pose", kPose);
  log.message(1, 1, R"({"x":1})");
  log.message(1, 2, R"({"x":1e999})");
  log.message(1, 3, R"({"x":nan})");
  log.message(1, 4, R"(7)");
  log.message(9, 5, R"({"x":1})");  // no such channel
  log.message(1, 6, R"({"x":2})");
  const signals::Table table = log.read_back();
  EXPECT_FALSE(table.complete);
  EXPECT_EQ(table.series.at(0).columns[0], (std::vector<double>{1, 2}));
}

TEST(Reader, CompressedLogsAreRefusedWithAdvice) {
  for (const char* compression : {"zstd", "lz4"}) {
    Foreign log;
    log.compressed_chunk(compression);
    EXPECT_THAT(error_of([&] { log.read_back(); }),
                AllOf(HasSubstr(std::string("compressed with ") + compression),
                      HasSubstr("mcap decompress")));
  }
}

TEST(Message, ReadsOwnAndOthersAlike) {
  const MessageFormat format({"/t", "", {{"x", "N"}, {"y", "N"}}});
  std::string text;
  format.append(text, std::array{-0.0, std::nan("")});
  EXPECT_EQ(text, R"({"x":-0,"y":null})");
  double v[2];
  ASSERT_TRUE(format.parse(text, v));
  EXPECT_TRUE(same_bits(v[0], -0.0));
  EXPECT_TRUE(std::isnan(v[1]));
  ASSERT_TRUE(format.parse(R"({ "y" : 2, "z" : [], "x" : 1 })", v));
  EXPECT_EQ(v[0], 1.0);
  EXPECT_EQ(v[1], 2.0);
  for (const char* bad : {"", "{", R"({"x":1,"y":2)", R"({"x":1,"y":2}})", R"({"x":inf,"y":2})"})
    EXPECT_FALSE(format.parse(bad, v)) << bad;
}

// Walk of 12 s: 60 topics every 10 ms, and 8000 edges of 8 valves. Prints the time it took.
TEST(Reader, ReadsAWalkQuickly) {
  const Folder folder;
  std::mt19937_64 random(5);
  signals::Table table;
  for (int t = 0; t < 68; ++t) {
    signals::Series& s = table.series.emplace_back();
    const bool edges = t >= 60;
    const std::string number = std::to_string(t);
    s.topic = {edges ? "/valve/muscle_" + number + "/inlet/open" : "/muscle/number_" + number,
               "",
               {{"value", "N"}}};
    if (t < 12) s.topic.fields = {{"x", "m"}, {"y", "m"}};
    s.columns.resize(s.topic.fields.size());
    for (int i = 0; i < (edges ? 1000 : 1200); ++i) {
      s.time_ns.push_back(i * (edges ? 12'000'000LL : 10'000'000LL));
      for (auto& c : s.columns) c.push_back(edges ? i % 2 : 1e-17 * static_cast<double>(random()));
    }
  }
  using Clock = std::chrono::steady_clock;
  const auto ms = [](Clock::duration d) { return std::chrono::duration<double, std::milli>(d); };
  const auto start = Clock::now();
  Writer writer(folder / "log.mcap", topics_of(table));
  push_all(writer, table);
  const auto pushed = Clock::now();
  writer.finish();
  const auto finished = Clock::now();
  const signals::Table back = read(folder / "log.mcap");
  const auto done = Clock::now();
  expect_same(back, table);
  std::printf("%zu messages, %ju bytes: push %.1f ms (%ju waits), finish %.1f ms, read %.1f ms\n",
              messages_in(table),
              static_cast<std::uintmax_t>(std::filesystem::file_size(folder / "log.mcap")),
              ms(pushed - start).count(), static_cast<std::uintmax_t>(writer.waits()),
              ms(finished - pushed).count(), ms(done - finished).count());
}

}  // namespace
}  // namespace sinew::log::reader_test
