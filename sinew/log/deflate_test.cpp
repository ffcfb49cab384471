#include "sinew/log/deflate.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace sinew::log::deflate_test {
namespace {

std::string random_bytes(std::size_t size, int values) {
  std::mt19937 random(static_cast<unsigned>(size));
  std::uniform_int_distribution<int> byte(0, values - 1);
  std::string out(size, '\0');
  for (char& c : out) c = static_cast<char>(byte(random));
  return out;
}

TEST(Deflate, ComesBackByteForByte) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{65536},
                                 std::size_t{65537}, std::size_t{1000003}})
    for (const int values : {1, 2, 256}) {
      const std::string bytes = random_bytes(size, values);
      EXPECT_TRUE(inflated(deflated(bytes)) == bytes) << size << " of " << values;
    }
}

TEST(Deflate, MakesWhatRepeatsSmall) {
  EXPECT_LT(deflated(std::string(1000000, 'a')).size(), 10000u);
}

TEST(Deflate, RefusesWhatIsCutOrForeign) {
  const std::string whole = deflated(random_bytes(1000, 256));
  EXPECT_THROW(inflated(std::string_view(whole).substr(0, whole.size() - 1)),
               std::invalid_argument);
  EXPECT_THROW(inflated("no zlib"), std::invalid_argument);
  EXPECT_THROW(inflated(whole + "more"), std::invalid_argument);
  EXPECT_THROW(inflated(""), std::invalid_argument);
}

}  // namespace
}  // namespace sinew::log::deflate_test
