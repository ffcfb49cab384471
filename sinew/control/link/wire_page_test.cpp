// Tests docs/reference/wire.md: its tables have the fields of each message at the right places, and
// its examples are the exact frames.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "sinew/control/link/configuration.h"
#include "sinew/control/link/test_wire.h"
#include "tests/places.h"

namespace sinew::link::wire_page_test {
namespace {

using Lines = std::vector<std::string>;

const Lines& page() {
  static const Lines lines = [] {
    Lines out;
    std::ifstream in(sinew::test::source_dir() + "/docs/reference/wire.md");
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
  }();
  return lines;
}

// --- tables -------------------------------------------------------------------------------------

// A number on the wire: its offset and type.
using Place = std::pair<std::size_t, std::string>;
using Places = std::vector<Place>;

std::size_t size_of(const std::string& type) {
  return std::stoul(type.substr(1)) / 8;  // u8, i64, f32
}

// Records the numbers that a Writer would write.
class Layout {
 public:
  static constexpr bool reads = false;
  Places places;
  std::size_t size = 0;

  template <class T>
  void whole(const T&) {
    const char* kind = std::is_floating_point_v<T> ? "f" : std::is_signed_v<T> ? "i" : "u";
    places.emplace_back(size, kind + std::to_string(8 * sizeof(T)));
    size += sizeof(T);
  }
  template <class T>
  void limited(const T& x, T, T) {
    whole(x);
  }
  void finite(const float& x) { whole(x); }
};

template <class M>
Places places_of(const M& message) {
  Layout io;
  fields(io, message);
  return io.places;
}

// Returns the cells of the rows under a heading, without their titles.
std::vector<Lines> rows_under(const std::string& heading) {
  std::vector<Lines> out;
  auto line = std::find_if(page().begin(), page().end(), [&](const std::string& l) {
    return l == "### " + heading || l == "#### " + heading;
  });
  if (line == page().end()) ADD_FAILURE() << "no heading " << heading;
  for (; line != page().end() && !(out.size() > 0 && line->empty()); ++line) {
    if (line->starts_with("#") && !line->ends_with(heading)) break;
    if (!line->starts_with("| ")) continue;
    Lines cells;
    std::istringstream in(line->substr(1));
    for (std::string cell; std::getline(in, cell, '|');) {
      const std::size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
      cells.push_back(from == std::string::npos ? "" : cell.substr(from, to - from + 1));
    }
    out.push_back(cells);
  }
  if (out.size() >= 2) out.erase(out.begin(), out.begin() + 2);
  return out;
}

Lines types_under(const std::string& heading);

// Returns the types of a cell: u8, u8[4], (u8 u16)[32], [a joint](#a-joint)[8].
Lines types_in(std::string cell) {
  std::size_t times = 1;
  const std::size_t bracket = cell.rfind('[');
  if (cell.ends_with("]") && bracket != std::string::npos && bracket > 0) {
    times = std::stoul(cell.substr(bracket + 1));
    cell.resize(bracket);
  }
  Lines once;
  if (cell.starts_with("[")) {
    once = types_under(cell.substr(1, cell.find(']') - 1));
  } else {
    std::istringstream in(cell.starts_with("(") ? cell.substr(1, cell.size() - 2) : cell);
    for (std::string type; in >> type;) once.push_back(type);
  }
  Lines out;
  for (; times > 0; --times) out.insert(out.end(), once.begin(), once.end());
  return out;
}

// Rows "12 + 5 c" are repeated as often as the message has items; they are left out here.
bool is_repeated(const Lines& row) { return row[0].find('+') != std::string::npos; }

Places places_under(const std::string& heading) {
  Places out;
  for (const Lines& row : rows_under(heading)) {
    if (is_repeated(row)) continue;
    std::size_t at = std::stoul(row[0]);
    for (const std::string& type : types_in(row[1])) {
      out.emplace_back(at, type);
      at += size_of(type);
    }
  }
  return out;
}

Lines types_under(const std::string& heading) {
  Lines out;
  for (const auto& [at, type] : places_under(heading)) out.push_back(type);
  return out;
}

// Offset and distance of repeated items.
std::pair<std::size_t, std::size_t> repeated_under(const std::string& heading) {
  for (const Lines& row : rows_under(heading))
    if (is_repeated(row))
      return {std::stoul(row[0]), std::stoul(row[0].substr(row[0].find('+') + 1))};
  return {0, 0};
}

// Each type's heading, and the message without repeated items and with one of them.
struct Section {
  std::string heading;
  Places none, one;
};

template <class M>
Section section(const std::string& name, const M& none, const M& one) {
  std::ostringstream heading;
  heading << '`' << name << "` 0x" << std::uppercase << std::hex;
  heading.width(2);
  heading.fill('0');
  heading << static_cast<int>(M::type);
  return {heading.str(), places_of(none), places_of(one)};
}
template <class M>
Section section(const std::string& name) {
  return section(name, M{}, M{});
}

std::vector<Section> sections() {
  return {section<Identify>("identify"),
          section<ConfigureBegin>("configure_begin"),
          section("configure_chunk", ConfigureChunk{}, ConfigureChunk{.count = 1}),
          section<ConfigureEnd>("configure_end"),
          section<ArmFirst>("arm_first"),
          section<ArmSecond>("arm_second"),
          section("command", CommandFor{}, CommandFor{.joints = 1}),
          section<SetGains>("set_gains"),
          section<SetFeedforward>("set_feedforward"),
          section<Enable>("enable"),
          section<ReadSensors>("read_sensors"),
          section<EdgesWanted>("edges_wanted"),
          section<ReadFaultLog>("read_fault_log"),
          section<ClearFault>("clear_fault"),
          section<Heartbeat>("heartbeat"),
          section<ThesisWords>("thesis_words"),
          section<ShutDown>("shut_down"),
          section<Identity>("identity"),
          section("answer", Reply{}, Reply{.letters = 1}),
          section<State>("state"),
          section("readings", Readings{}, Readings{.count = 1}),
          section("counters", Counters{}, Counters{.count = 1}),
          section("joints", Joints{}, Joints{.count = 1}),
          section<Event>("event"),
          section("edges", Edges{}, Edges{.count = 1}),
          section("fault_log", FaultLog{}, FaultLog{.count = 1})};
}

std::size_t end_of(const Places& places) {
  return places.empty() ? 0 : places.back().first + size_of(places.back().second);
}

TEST(WirePage, HasEachMessageByteForByte) {
  ASSERT_EQ(sections().size(), 26u);
  for (const Section& s : sections()) {
    EXPECT_EQ(places_under(s.heading), s.none) << s.heading;
    const std::size_t begin = end_of(s.none), step = end_of(s.one) - begin;
    if (step > 0) {
      EXPECT_EQ(repeated_under(s.heading), std::pair(begin, step)) << s.heading;
    }
  }
}

TEST(WirePage, HasWhatIsRepeatedByteForByte) {
  EXPECT_EQ(places_under("a joint's command"), places_of(control::JointCommand{}));
  EXPECT_EQ(places_under("a channel"), places_of(ChannelReading{}));
  EXPECT_EQ(places_under("a channel's counters"), places_of(control::SensorStatistics{}));
  EXPECT_EQ(places_under("a joint"), places_of(control::JointState{}));
  EXPECT_EQ(places_under("an edge"), places_of(ReportedEdge{}));
  EXPECT_EQ(places_under("Telemetry"), places_of(Part{}));
}

TEST(WirePage, HasAConfigurationByteForByte) {
  EXPECT_EQ(places_under("a muscle's configuration"), places_of(control::MuscleConfig{}));
  EXPECT_EQ(places_under("a joint's configuration"), places_of(control::JointConfig{}));
  const Places all = places_under("all of it");
  EXPECT_EQ(all, places_of(Configuration{}));
  EXPECT_EQ(end_of(all), configuration_size);
}

TEST(WirePage, HasEachCode) {
  std::size_t codes = 0;
  for (const std::string& line : page())
    if (line.starts_with("| " + std::to_string(codes) + " | `")) ++codes;
  EXPECT_EQ(codes, static_cast<std::size_t>(last_code) + 1);
}

// --- examples -----------------------------------------------------------------------------------

// Examples by their first line.
std::map<std::string, Bytes> examples_of_page() {
  std::map<std::string, Bytes> out;
  for (std::size_t i = 0; i < page().size(); ++i) {
    if (page()[i] != "```frame") continue;
    Bytes& bytes = out[page()[++i]];
    for (++i; page()[i] != "```"; ++i) {
      std::istringstream in(page()[i]);
      for (unsigned byte = 0; in >> std::hex >> byte;)
        bytes.push_back(static_cast<std::uint8_t>(byte));
    }
  }
  return out;
}

CommandFor walking() {
  CommandFor out{.from = 123'400, .periods = 3, .joints = 2};
  out.joint[0] = {.angle = 1895, .stiffness = 12.5f, .gains = {0.035f, 6.5f, 0}, .enabled = true};
  out.joint[1] = {.angle = 1175, .stiffness = 10, .gains = {0.12f, 5, 0}, .enabled = true};
  return out;
}

Reply refusal() {
  Reply out{.to = 4, .sequence = 30, .code = Code::configuration, .letters = 24};
  const std::string words = "the period must not be 0";
  std::copy(words.begin(), words.end(), out.text.begin());
  return out;
}

Readings two_channels() {
  Readings out{.of = {.tick = 123'400, .part = 1, .parts = 4}, .count = 2};
  out.channel[0] = {{1895, signals::Status::ok}, 1895};
  out.channel[1] = {{802, signals::Status::ok}, 4095};
  return out;
}

TEST(WirePage, ExamplesAreFramesToTheByte) {
  const std::map<std::string, Bytes> expected = {
      {"identify, to every board, sequence 0", frame_of(Identify{}, {every_board, 0})},
      {"arm_second, to board 1, sequence 31",
       frame_of(ArmSecond{.nonce = 0x12345678, .configuration = 0xcafef00d}, {1, 31})},
      {"command, to board 1, sequence 32", frame_of(walking(), {1, 32})},
      {"enable, joints 0 and 2, to board 1, sequence 33",
       frame_of(Enable{.joints = 5, .enabled = true}, {1, 33})},
      {"shut_down, to every board, sequence 255", frame_of(ShutDown{}, {every_board, 255})},
      {"answer: configuration refused, from board 1, sequence 7", frame_of(refusal(), {1, 7})},
      {"readings, two channels, the second not accepted, from board 1, sequence 9",
       frame_of(two_channels(), {1, 9})},
  };
  const std::map<std::string, Bytes> found = examples_of_page();
  for (const auto& [name, bytes] : expected) {
    const auto example = found.find(name);
    std::ostringstream hex;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const char digits[] = "0123456789ABCDEF";
      hex << (i % 24 ? " " : "\n") << digits[bytes[i] >> 4] << digits[bytes[i] & 15];
    }
    EXPECT_TRUE(example != found.end() && example->second == bytes) << name << hex.str();
  }
  EXPECT_EQ(found.size(), expected.size());
}

}  // namespace
}  // namespace sinew::link::wire_page_test
