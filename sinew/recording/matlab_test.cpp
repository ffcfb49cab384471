#include "sinew/recording/matlab.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sinew/config/diagnostics.h"
#include "sinew/host/module.h"
#include "sinew/recording/recorded.h"

// Files are written here byte by byte, after the published format, so that the reader is tested
// independently of its own library.
namespace sinew::recording::matlab_test {
namespace {

namespace fs = std::filesystem;

// An element: its type, its length, and its data, padded to a multiple of eight bytes.
std::string element(std::uint32_t type, const std::string& bytes) {
  std::string out(8, '\0');
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(out.data(), &type, 4);
  std::memcpy(out.data() + 4, &size, 4);
  out += bytes;
  out.resize((out.size() + 7) / 8 * 8, '\0');
  return out;
}

template <class T>
std::string words(std::initializer_list<T> values) {
  std::string out;
  for (const T v : values) out.append(reinterpret_cast<const char*>(&v), sizeof v);
  return out;
}

constexpr std::uint32_t int8 = 1, uint16 = 4, int32 = 5, uint32 = 6, float64 = 9, matrix_type = 14;
constexpr std::uint32_t struct_class = 2, char_class = 4, double_class = 6;

std::string begin(std::uint32_t kind, std::int32_t rows, std::int32_t columns,
                  const std::string& name) {
  return element(uint32, words({kind, std::uint32_t{0}})) + element(int32, words({rows, columns})) +
         element(int8, name);
}

std::string numbers(const std::string& name, std::int32_t rows, std::int32_t columns,
                    const std::vector<double>& values) {
  std::string bytes(values.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return element(matrix_type, begin(double_class, rows, columns, name) + element(float64, bytes));
}

std::string vector(const std::string& name, const std::vector<double>& values) {
  return numbers(name, static_cast<std::int32_t>(values.size()), 1, values);
}

std::string text(const std::string& name, const std::string& letters) {
  std::string wide;
  for (const char c : letters) wide += {c, '\0'};
  return element(matrix_type,
                 begin(char_class, 1, static_cast<std::int32_t>(letters.size()), name) +
                     element(uint16, wide));
}

// Writes the fields of an array of structs, element by element.
std::string structure(const std::string& name, std::int32_t count,
                      const std::vector<std::string>& fields,
                      const std::vector<std::string>& values) {
  std::string names;
  for (std::string field : fields) {
    field.resize(32, '\0');
    names += field;
  }
  std::string out = begin(struct_class, 1, count, name);
  // Four bytes are stored next to their type, in one word of eight bytes.
  out += words({std::uint32_t{4 << 16 | int32}, std::uint32_t{32}}) + element(int8, names);
  for (const std::string& value : values) out += value;
  return element(matrix_type, out);
}

std::string file_of(const std::string& variables) {
  std::string out = "MATLAB 5.0 MAT-file, of a test";
  out.resize(124, ' ');
  return out + words({std::uint16_t{0x0100}}) + "IM" + variables;
}

class MatlabTest : public ::testing::Test {
 protected:
  MatlabTest() {
    std::string name = (fs::temp_directory_path() / "sinew-matlab-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~MatlabTest() override { fs::remove_all(folder_); }
  void SetUp() override {
    if (host::find_module("sinew_matlab.so").empty())
      GTEST_SKIP() << "built without libmatio-dev: no MATLAB files";
  }

  std::string put(const std::string& bytes, const std::string& name = "a.mat") const {
    std::ofstream(folder_ / name, std::ios::binary | std::ios::trunc) << bytes;
    return (folder_ / name).string();
  }
  Recorded take(const std::string& variables, const ClockMapping& clock = {}) const {
    return read_matlab(put(file_of(variables)), clock);
  }
  std::string error_of(const std::string& bytes, const ClockMapping& clock = {}) const {
    try {
      (void)read_matlab(put(bytes), clock);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "no error";
  }

  fs::path folder_;
};

std::vector<double> values(const Recorded& of, const std::string& name) {
  const auto column = of.header().find(name);
  return column ? of.columns[*column].values.in_memory() : std::vector<double>{};
}

TEST_F(MatlabTest, VectorsAndMatricesBesideATime) {
  const Recorded r =
      take(vector("t", {0, 0.5, 1}) + vector("angle", {1, 2, 3}) + numbers("row", 1, 3, {4, 5, 6}) +
           numbers("p", 3, 2, {1, 2, 3, 10, 20, 30}) + numbers("q", 2, 3, {1, 10, 2, 20, 3, 30}) +
           vector("gain", {7}) + vector("other", {1, 2}));
  ASSERT_EQ(r.clocks.size(), 1u);
  EXPECT_EQ(r.clocks[0].time_ns[1], 500'000'000);
  EXPECT_EQ(values(r, "angle"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(values(r, "row"), (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(values(r, "p(2)"), (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(values(r, "q(2)"), (std::vector<double>{10, 20, 30}));
  ASSERT_EQ(r.notes.size(), 2u);
  EXPECT_NE(r.notes[0].find("gain"), std::string::npos);
  EXPECT_NE(r.notes[1].find("other (2 x 1)"), std::string::npos);
}

TEST_F(MatlabTest, StructuresAsSimulinkLogsThem) {
  const std::string signals =
      structure("", 2, {"values", "label"},
                {vector("", {1, 2}), text("", "elbow angle"), vector("", {3, 4}), text("", "")});
  const Recorded r =
      take(structure("log", 1, {"time", "signals"}, {vector("", {0, 0.1}), signals}) +
           structure("ts", 1, {"Time", "Data"}, {vector("", {0, 1, 2}), vector("", {7, 8, 9})}) +
           structure("s", 1, {"time", "force"}, {vector("", {0, 1}), vector("", {5, 6})}));
  EXPECT_EQ(r.clocks.size(), 3u);
  EXPECT_EQ(values(r, "elbow angle"), (std::vector<double>{1, 2}));
  EXPECT_EQ(values(r, "log(2)"), (std::vector<double>{3, 4}));
  EXPECT_EQ(values(r, "ts"), (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(values(r, "s.force"), (std::vector<double>{5, 6}));
  EXPECT_EQ(values(r, "force"), (std::vector<double>{5, 6}));
  EXPECT_EQ(r.clocks[r.columns[*r.header().find("ts")].clock].time_ns.size(), 3u);
}

// A table as MATLAB saves it: an object whose numbers are elsewhere in the file.
TEST_F(MatlabTest, OfATableTheWayOutIsNamed) {
  const auto word = [](const char* letters) { return element(int8, letters); };
  const std::string table =
      element(matrix_type, element(uint32, words({std::uint32_t{17}, std::uint32_t{0}})) +
                               word("T") + word("MCOS") + word("table") + numbers("", 1, 1, {1}));
  const Recorded r = take(vector("t", {0, 1}) + vector("angle", {1, 2}) + table);
  EXPECT_EQ(values(r, "angle"), (std::vector<double>{1, 2}));
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_NE(r.notes[0].find("an object of a class; of a table, table2struct(T, 'ToScalar', true)"),
            std::string::npos)
      << r.notes[0];
  EXPECT_NE(error_of(file_of(table)).find("table2struct"), std::string::npos)
      << error_of(file_of(table));
}

TEST_F(MatlabTest, TheClockMayBeNamedOrMade) {
  const std::string variables = vector("clk", {0, 5}) + vector("a", {1, 2});
  EXPECT_EQ(take(variables, {.column = "clk", .unit = "ms"}).clocks[0].time_ns[1], 5'000'000);
  const Recorded made = take(vector("a", {1, 2, 3}), {.rate = "100 Hz"});
  EXPECT_EQ(made.clocks[0].time_ns[2], 20'000'000);
  const std::string none = error_of(file_of(variables));
  EXPECT_NE(none.find("no vector of times among clk, a"), std::string::npos) << none;
}

TEST_F(MatlabTest, WhatIsNoWholeMatFileIsNamed) {
  const std::string whole = file_of(vector("t", {0, 1}) + vector("a", {1, 2}));
  for (const std::size_t cut : {std::size_t{40}, whole.size() - 9, whole.size() - 60})
    EXPECT_NE(error_of(whole.substr(0, cut)).find("ends within a variable"), std::string::npos)
        << cut;
  const std::string table = error_of("time,angle\n0,1\n");
  EXPECT_NE(table.find("begins with \"time,angle"), std::string::npos) << table;
  EXPECT_NE(table.find("level 4, 5 or 7.3"), std::string::npos) << table;
  std::string broken = whole;
  broken[190] = '\x7f';  // the first variable claims more numbers than there are bytes
  EXPECT_NE(error_of(broken), "no error");
}

// MATLAB puts 512 bytes of its own before the signature of HDF5; here nothing follows it.
TEST_F(MatlabTest, AVersion73ThatCannotBeReadIsNamedWithTheWayOut) {
  std::string bytes = "MATLAB 7.3 MAT-file, Platform: GLNXA64, HDF5 schema 1.00 .";
  bytes.resize(124, ' ');
  bytes += std::string("\x00\x02IM", 4);
  bytes.resize(512, '\0');
  bytes += "\x89HDF\r\n\x1a\n";
  const std::string said = error_of(bytes);
  EXPECT_NE(said.find("a MAT file of version 7.3 (HDF5) that cannot be read"), std::string::npos)
      << said;
  EXPECT_NE(said.find("save('file.mat', '-v7') in MATLAB"), std::string::npos) << said;

  const std::string bare = error_of("\x89HDF\r\n\x1a\n");
  EXPECT_NE(bare.find("an HDF5 file"), std::string::npos) << bare;
  EXPECT_NE(bare.find("'-v7'"), std::string::npos) << bare;
}

TEST_F(MatlabTest, Level4HasVectorsToo) {
  const auto four = [](const std::string& name, const std::vector<double>& v) {
    std::string out =
        words({std::uint32_t{0}, static_cast<std::uint32_t>(v.size()), std::uint32_t{1},
               std::uint32_t{0}, static_cast<std::uint32_t>(name.size() + 1)});
    out += name + '\0';
    for (const double x : v) out += words({x});
    return out;
  };
  const Recorded r = read_recording(put(four("t", {0, 1}) + four("a", {4, 5})), {});
  EXPECT_EQ(r.kind, "MATLAB");
  EXPECT_EQ(values(r, "a"), (std::vector<double>{4, 5}));
  EXPECT_FALSE(is_matlab("time,angle"));
}

}  // namespace
}  // namespace sinew::recording::matlab_test
