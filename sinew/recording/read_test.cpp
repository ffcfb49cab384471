#include "sinew/recording/recorded.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "sinew/log/csv.h"
#include "sinew/log/mcap.h"
#include "sinew/log/reader.h"
#include "sinew/log/writer.h"
#include "sinew/recording/assemble.h"
#include "sinew/recording/measured.h"
#include "tests/places.h"

namespace sinew::recording::read_test {
namespace {

namespace fs = std::filesystem;

class ReadTest : public ::testing::Test {
 protected:
  ReadTest() {
    std::string name = (fs::temp_directory_path() / "sinew-read-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~ReadTest() override { fs::remove_all(folder_); }

  std::string put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  std::string error_of(const std::string& path, const Mapping& mapping = {}) const {
    try {
      (void)read_recording(path, mapping);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "no error";
  }

  fs::path folder_;
};

// A log as another program writes it: objects within objects, times since 1970.
std::string foreign_log(std::int64_t start) {
  log::Bytes out;
  out.raw(log::kMagic);
  log::put_header(out, "another program");
  log::put_schema(out, {1, "Joint", "jsonschema",
                        R"({"type": "object", "properties": {
                          "timestamp": {"type": "object", "properties":
                            {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}},
                          "frame": {"type": "string"},
                          "state": {"type": "object", "properties":
                            {"angle": {"type": "number", "unit": "deg"},
                             "moving": {"type": "boolean"}}}}})"});
  log::put_channel(out, {7, 1, "/elbow", "json"});
  for (int i = 0; i < 3; ++i) {
    const std::size_t message =
        log::open_message(out, 7, 0, static_cast<std::uint64_t>(start) + 10'000'000ull * i);
    out.raw(R"({"timestamp": {"sec": 1, "nsec": 2}, "frame": "a", "state": {"moving": true, )");
    out.raw("\"angle\": " + std::to_string(30 * i) + "}}");
    out.close(message);
  }
  log::put_data_end(out, 0);
  log::put_footer(out, 0, 0, 0);
  return out.data();
}

TEST_F(ReadTest, ALogOfAnotherProgramCountsFromItsFirstMessage) {
  const std::int64_t start = 1'795'946'400'123'456'789;
  const Recorded r = read_recording(put("a.mcap", foreign_log(start)), {});
  EXPECT_EQ(r.kind, "MCAP");
  ASSERT_EQ(r.columns.size(), 2u);
  EXPECT_EQ(r.columns[0].name, "/elbow.state.angle");
  EXPECT_EQ(r.columns[0].unit, "deg");
  EXPECT_EQ(r.columns[0].values.in_memory(), (std::vector<double>{0, 30, 60}));
  EXPECT_EQ(r.columns[1].values.in_memory(), (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(r.clocks[0].time_ns.in_memory(),
            (std::vector<std::int64_t>{0, 10'000'000, 20'000'000}));
  EXPECT_EQ(r.clocks[0].origin, start);
  EXPECT_EQ(r.started.substr(0, 10), "2026-11-29") << r.started;
  EXPECT_TRUE(r.header().find("state.angle") == 0u || r.header().find("angle") == 0u);
}

// Two topics in JSON with a schema number that does not exist; one message has no value.
std::string open_log(std::uint16_t schema) {
  log::Bytes out;
  out.raw(log::kMagic);
  log::put_header(out, "");
  log::put_schema(out, {1, "any", "jsonschema", R"({"type": "object"})"});
  log::put_channel(out, {7, schema, "/elbow", "json"});
  for (const char* angle : {"30", "NaN", "-Infinity", "60"}) {
    const std::size_t message = log::open_message(out, 7, 0, 10'000'000);
    out.raw(fmt::format(R"({{"note": "NaN", "state": {{"angle": {}}}}})", angle));
    out.close(message);
  }
  log::put_data_end(out, 0);
  log::put_footer(out, 0, 0, 0);
  return out.data();
}

TEST_F(ReadTest, ALogWithAnOpenSchemaOrNoneHasTheNumbersOfItsMessages) {
  for (const std::uint16_t schema : {0, 1}) {
    const Recorded r = read_recording(put("a.mcap", open_log(schema)), {});
    ASSERT_EQ(r.columns.size(), 1u);
    EXPECT_EQ(r.columns[0].name, "/elbow.state.angle");
    const std::vector<double> values = r.columns[0].values.in_memory();
    ASSERT_EQ(values.size(), 4u);
    EXPECT_EQ(values[0], 30);
    EXPECT_TRUE(std::isnan(values[1]) && std::isnan(values[2]));
    EXPECT_EQ(values[3], 60);
    EXPECT_TRUE(r.complete);
  }
}

TEST_F(ReadTest, LabViewsHeaderHasTheClockAndTheUnits) {
  const std::string head =
      "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\nX_Columns\tNo\n"
      "***End_of_Header***\t\n\t\nChannels\t1\t\nY_Unit_Label\tMPa\t\nX0\t0,5\t\n"
      "Delta_X\t0,01\t\n***End_of_Header***\t\t\nX_Value\tDruck ABS.\tComment\n";
  const Recorded r = read_recording(put("a.lvm", head + "\t0,1\tok\n\t0,2\n\t0,3\n\t0,4\n"), {});
  ASSERT_EQ(r.columns.size(), 1u);
  EXPECT_EQ(r.columns[0].values.in_memory(), (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(r.clocks[0].time_ns.in_memory(),
            (std::vector<std::int64_t>{500'000'000, 510'000'000, 520'000'000, 530'000'000}));
}

// A complete LabVIEW file in Latin-1 with remarks in some rows: angle = 270 + 15 sin(pi t) deg,
// pressure = 2 + sin(pi t + 0.4) bar gauge, written as absolute MPa.
TEST_F(ReadTest, LabViewsRemarksAreLeftOutAndItsNumbersAreTheTruth) {
  const std::string path =
      sinew::test::source_dir() + "/tests/fuzz/corpus/csv/labview-remarks-latin1.lvm";
  EXPECT_NE(error_of(path).find("encoding=latin1"), std::string::npos);
  Mapping mapping;
  mapping.table.encoding = "latin1";
  const Recorded r = read_recording(path, mapping);
  ASSERT_EQ(r.columns.size(), 3u);
  EXPECT_EQ(r.columns[0].unit, "MPa abs");
  const std::vector<std::int64_t> time = r.clocks[0].time_ns.in_memory();
  const std::vector<double> pressure = r.columns[0].values.in_memory(),
                            angle = r.columns[2].values.in_memory();
  ASSERT_EQ(time.size(), 200u);
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double phase = std::numbers::pi * 1e-9 * static_cast<double>(time[i]);
    EXPECT_NEAR(angle[i], 270 + 15 * std::sin(phase), 1e-4) << i;
    EXPECT_NEAR(10 * pressure[i] - 1.01325, 2 + std::sin(phase + 0.4), 1e-5) << i;
  }
  EXPECT_NE(std::ranges::find(r.notes, "columns without numbers left out: Comment"), r.notes.end());
}

TEST_F(ReadTest, MarkersDatesAndShortRowsAreLeftOutAndCounted) {
  const std::string text =
      "t [s],angle [deg]\n01/17/26 12:50:48\n0,1\n1,2\n__ERROR__\n2,3\n3,lost\n4,5\n5\n6,7\n";
  Mapping m;
  EXPECT_NE(error_of(put("a.csv", text)).find("drop_incomplete=true"), std::string::npos);
  m.table.drop_incomplete = true;
  const Recorded r = read_recording(put("a.csv", text), m);
  EXPECT_EQ(r.clocks[0].time_ns.size(), 6u);
  EXPECT_EQ(r.columns[0].values[1], 2);
  EXPECT_EQ(r.columns[0].values[5], 7);
  std::string notes;
  for (const std::string& note : r.notes) notes += note + "\n";
  EXPECT_NE(notes.find("2 lines with another number of cells"), std::string::npos) << notes;
  EXPECT_NE(notes.find("\"01/17/26 12:50:48\": left out"), std::string::npos) << notes;
}

TEST_F(ReadTest, ShiftJisAndGitLfsAreNamed) {
  EXPECT_NE(error_of(put("a.csv", "\x8E\x9E\x8A\xD4[s],\x88\xB3\x97\xCD\n0,1\n"))
                .find("iconv -f SHIFT_JIS"),
            std::string::npos);
  EXPECT_NE(error_of(put("b.csv",
                         "time [s],T [\xB0"
                         "C]\n0,1\n"))
                .find("latin1"),
            std::string::npos);
  EXPECT_NE(error_of(put("c.csv", "version https://git-lfs.github.com/spec/v1\noid a\n"))
                .find("git lfs pull"),
            std::string::npos);
}

TEST_F(ReadTest, ACompressedLogIsRefusedWithAHint) {
  log::Bytes out;
  out.raw(log::kMagic);
  log::put_header(out, "");
  const std::size_t chunk = out.open(log::Op::chunk);
  out.u64(0), out.u64(0), out.u64(3), out.u32(0);
  out.text("zstd");
  out.u64(3);
  out.raw("abc");
  out.close(chunk);
  const std::string text = error_of(put("a.mcap", out.data()));
  EXPECT_NE(text.find("compressed with zstd"), std::string::npos) << text;
  EXPECT_NE(text.find("mcap decompress"), std::string::npos) << text;
}

TEST_F(ReadTest, WhatNoRecordingIsIsNamed) {
  EXPECT_NE(error_of((folder_ / "no.csv").string()).find("no.csv"), std::string::npos);
  EXPECT_NE(error_of(folder_.string()), "no error");
  EXPECT_NE(error_of(put("empty.csv", "")), "no error");
  EXPECT_NE(error_of(put("b.xlsx", std::string("PK\x03\x04", 4) + "[Content_Types].xml")),
            "no error");
  Mapping where;
  map_where(where, "a", "1");
  EXPECT_NE(error_of(put("a.mcap", foreign_log(0)), where).find("where"), std::string::npos);
}

// --- our own export ---

signals::Table some_run() {
  signals::Table table;
  const auto add = [&](const char* topic, std::vector<signals::Field> fields,
                       std::vector<std::vector<double>> columns, std::vector<std::int64_t> times) {
    signals::Series& s = table.series.emplace_back();
    s.topic = {topic, "", std::move(fields)};
    s.time_ns = signals::Times(std::move(times));
    for (auto& column : columns) s.columns.emplace_back(std::move(column));
  };
  const double nan = std::nan("");
  add("/joint/elbow/angle", {{"value", "rad"}}, {{0.1, 0.2, 0.30000000000000004}},
      {1'300'000, 11'300'000, 21'300'000});
  add("/desired/foot/position", {{"x", "m"}, {"y", "m"}}, {{1e-300, nan, -0.0}, {2, nan, 3}},
      {1'300'000, 11'300'000, 21'300'000});
  add("/muscle/flexor/pressure", {{"value", "Pa"}}, {{101325.00000000001}}, {11'300'000});
  add("/valve/flexor/inlet/open", {{"value", "1"}}, {{1, 0}}, {11'300'000, 21'300'000});
  return table;
}

std::string csv_of(const signals::Table& table) {
  std::ostringstream out;
  log::write_csv(table, out);
  return out.str();
}

TEST_F(ReadTest, OurOwnExportComesBackWithTheSameDigits) {
  const signals::Table table = some_run();
  std::vector<signals::Topic> topics;
  for (const signals::Series& s : table.series) topics.push_back(s.topic);
  const std::string csv = csv_of(table);
  const AssembledRecording back = assemble({read_recording(put("run.csv", csv), {})}, {}, topics);
  EXPECT_EQ(csv_of(back.table), csv);
}

TEST_F(ReadTest, OurOwnLogComesBackBitForBit) {
  const signals::Table table = some_run();
  std::vector<signals::Topic> topics;
  for (const signals::Series& s : table.series) topics.push_back(s.topic);
  const std::string file = (folder_ / "log.mcap").string();
  {
    log::Writer log(file, topics);
    for (std::size_t t = 0; t < topics.size(); ++t)
      for (std::size_t i = 0; i < table.series[t].time_ns.size(); ++i) {
        std::vector<double> values;
        for (const signals::Column& column : table.series[t].columns) values.push_back(column[i]);
        ASSERT_TRUE(log.push(static_cast<std::uint16_t>(t), table.series[t].time_ns[i], values));
      }
    log.finish();
  }
  const AssembledRecording back = assemble({read_recording(file, {})}, {}, topics);
  EXPECT_EQ(csv_of(back.table), csv_of(table));
}

// The folder of a run gives the table that its log exports, bit for bit.
TEST_F(ReadTest, ARunsFolderIsReadAsItsExportedTable) {
  const fs::path folder = folder_;
  {
    log::Writer writer(folder / "log.mcap",
                       {{"/muscle/flexor/pressure", "inside, absolute", {{"value", "Pa"}}},
                        {"/muscle/flexor/tension", "it pulls with", {{"value", "N"}}}});
    for (int i = 0; i < 50; ++i) {
      writer.push(0, 10'000'000LL * i, std::vector<double>{2e5 + 1e5 / (i + 3)});
      writer.push(1, 10'000'000LL * i, std::vector<double>{100.0 / (i + 7)});
    }
    writer.finish();
  }
  log::write_csv(log::read(folder / "log.mcap"), folder / "run.csv");
  constexpr ColumnSpec specs[] = {{.name = "time", .unit = "s", .doc = "of it"},
                                  {.name = "pressure", .unit = "Pa gauge", .doc = "inside"},
                                  {.name = "force", .unit = "N", .doc = "it pulls with"}};
  Source source{
      .path = folder.string(),
      .names = {{"pressure", "/muscle/flexor/pressure"}, {"force", "/muscle/flexor/tension"}}};
  const Measured run = read_measured(source, specs);
  source.path = (folder / "run.csv").string();
  const Measured csv = read_measured(source, specs);
  ASSERT_EQ(run.rows(), 50u);
  for (const ColumnSpec& w : specs) EXPECT_EQ(run[w.name], csv[w.name]) << w.name;
  // A channel's unit is Pa by default, absolute.
  for (std::size_t i = 0; i < run.rows(); ++i)
    EXPECT_NEAR(run["pressure"][i], 2e5 + 1e5 / static_cast<double>(i + 3) - units::atmosphere,
                1e-9);

  const auto said_of = [](const Source& asked, std::span<const ColumnSpec> columns) {
    try {
      (void)read_measured(asked, columns);
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  source = {.path = folder.string(), .names = {{"force", "/muscle/flexor/tension"}}};
  const std::string said = said_of(source, specs);
  EXPECT_NE(said.find("pressure: found no column \"pressure\" among time, "
                      "/muscle/flexor/pressure, /muscle/flexor/tension"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("try names.pressure=/muscle/flexor/pressure"), std::string::npos) << said;
  std::filesystem::remove(folder / "log.mcap");
  const std::string none = said_of(source, specs);
  EXPECT_NE(
      none.find("found a folder; expected measurements as CSV, or a run's folder with log.mcap"),
      std::string::npos)
      << none;
}

TEST_F(ReadTest, CountsTheBytesOfATableForWhoeverLooks) {
  std::string csv = "time [s],force [N]\n";
  for (int i = 0; i < 1000; ++i) csv += fmt::format("{},{}\n", i, 2 * i);
  std::atomic<std::int64_t> read{-1};
  EXPECT_EQ(read_recording(put("counted.csv", csv), {}, &read).columns.at(0).values.size(), 1000u);
  EXPECT_EQ(read, static_cast<std::int64_t>(csv.rfind("999,")));
}

}  // namespace
}  // namespace sinew::recording::read_test
