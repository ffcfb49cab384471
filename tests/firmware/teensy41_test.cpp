// The image for Teensy 4.1, byte by byte as it is stored in the flash chip: it is not executed
// here, but a word in the wrong place would keep the board from starting.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>

#include "tests/firmware/images.h"

namespace sinew::firmware {
namespace {

constexpr std::uint32_t chip = 0x60000000, chip_size = 7'936 << 10;
constexpr std::uint32_t data_begin = 0x20000000, data_size = 384 << 10;

// The bytes of an ELF file's segments, by the address at which they are loaded.
class Flash {
 public:
  explicit Flash(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string all(std::istreambuf_iterator<char>(in), {});
    const auto field = [&](std::size_t at, std::size_t size) {
      std::uint32_t out = 0;
      std::memcpy(&out, all.data() + at, size);
      return out;
    };
    const std::uint32_t headers = field(28, 4), size = field(42, 2), count = field(44, 2);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t header = headers + i * size;
      if (field(header, 4) != 1) continue;  // to be loaded
      const std::uint32_t from = field(header + 4, 4), to = field(header + 12, 4);
      const std::uint32_t runs = field(header + 8, 4), bytes = field(header + 16, 4);
      for (std::uint32_t b = 0; b < bytes; ++b)
        byte_[to + b] = static_cast<std::uint8_t>(all[from + b]);
      if (runs == 0) code_at_ = to, code_size_ = bytes;
    }
  }
  std::uint32_t begin() const { return byte_.begin()->first; }
  std::uint32_t end() const { return byte_.rbegin()->first + 1; }
  std::uint32_t word(std::uint32_t at) const {
    std::uint32_t out = 0;
    for (std::uint32_t b = 0; b < 4; ++b) out |= std::uint32_t{byte_.at(at + b)} << 8 * b;
    return out;
  }
  std::uint32_t code_at() const { return code_at_; }
  std::uint32_t code_size() const { return code_size_; }

 private:
  std::map<std::uint32_t, std::uint8_t> byte_;
  std::uint32_t code_at_ = 0, code_size_ = 0;
};

const Flash& flash() {
  static const Flash image_of_it(image("application-teensy41"));
  return image_of_it;
}

TEST(Teensy41, ImageBeginsWithHowItsFlashChipIsRead) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  EXPECT_EQ(flash().begin(), chip);
  EXPECT_LE(flash().end(), chip + chip_size);
  EXPECT_EQ(flash().word(chip), 0x42464346u) << "FCFB";
  EXPECT_EQ(flash().word(chip + 0x50), 8u << 20) << "bytes of the chip";
  EXPECT_EQ(flash().word(chip + 0x80), 0x0A1804EBu) << "fast read on four wires";
}

TEST(Teensy41, ImageHasItsAddressAndStartAtItsPlace) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  constexpr std::uint32_t table = chip + 0x1000;
  EXPECT_EQ(flash().word(table), 0x432000D1u);
  EXPECT_EQ(flash().word(table + 20), table) << "itself";
  const std::uint32_t extent = flash().word(table + 16);
  EXPECT_EQ(flash().word(extent), chip);
  EXPECT_EQ(flash().word(extent + 4), flash().end() - chip) << "no byte is left out";
  EXPECT_EQ(flash().word(extent + 8), 0u) << "no plug-in";
}

// They run before any other memory has code: up to the jump that leaves the chip there is no call.
TEST(Teensy41, FirstInstructionsRunInTheChipAndCallNothing) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  const std::uint32_t entry = flash().word(chip + 0x1004);
  ASSERT_EQ(entry % 2, 1u) << "Thumb";
  ASSERT_GT(entry, chip + 0x1000);
  const auto half = [](std::uint32_t at) {
    return flash().word(at & ~3u) >> 8 * (at & 2u) & 0xFFFFu;
  };
  std::uint32_t at = entry - 1;
  while (at < flash().code_at() && (half(at) & 0xFF87) != 0x4700) {  // BX
    const bool call = (half(at) & 0xF800) == 0xF000 && (half(at + 2) & 0xD000) == 0xD000;
    EXPECT_FALSE(call) << std::hex << at;
    at += 2;
  }
  EXPECT_LT(at, flash().code_at());
}

TEST(Teensy41, VectorsAreTheFirstWordsOfTheCodeAndLeadIntoIt) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  const std::uint32_t vectors = flash().code_at();
  EXPECT_LE(flash().code_size(), 128u << 10);
  EXPECT_EQ(flash().word(vectors), data_begin + data_size) << "the stack's top";
  for (std::uint32_t i = 1; i < 16 + 160; ++i) {
    const std::uint32_t handler = flash().word(vectors + 4 * i);
    EXPECT_EQ(handler % 2, 1u) << i;
    EXPECT_LT(handler, flash().code_size()) << i;
  }
  const std::uint32_t nobody = flash().word(vectors + 4 * (16 + 0));
  for (const std::uint32_t used : {25, 100, 122})  // line, edges, ticks
    EXPECT_NE(flash().word(vectors + 4 * (16 + used)), nobody) << used;
}

}  // namespace
}  // namespace sinew::firmware
