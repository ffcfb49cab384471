// Ports of a server: the same one for the same folder, another one while it is taken.

#include <gtest/gtest.h>

#include <set>

#include "sinew/live/server.h"

namespace sinew::live::port_test {
namespace {

namespace fs = std::filesystem;

TEST(FolderPort, IsTheSameForTheSameFolderAndSeldomAnothers) {
  const fs::path here = fs::temp_directory_path();
  EXPECT_EQ(folder_port(here).number, folder_port(here / "." / "x" / "..").number);
  std::set<int> all;
  for (int i = 0; i < 100; ++i) {
    const Port port = folder_port(here / ("leg-" + std::to_string(i)));
    EXPECT_GE(port.number, 20000);
    EXPECT_LT(port.number, 30000);
    EXPECT_TRUE(port.or_free);
    all.insert(port.number);
  }
  EXPECT_GE(all.size(), 97u);
}

TEST(Server, TakesItsPortAgainAndAFreeOneWhileItIsTaken) {
  std::uint16_t number = 0;
  {
    const Server first({}, {});
    number = first.port();
    const Server second({.number = number, .or_free = true}, {});
    EXPECT_NE(second.port(), number);
    EXPECT_GT(second.port(), 0);
    EXPECT_THROW(Server({.number = number}, {}), std::runtime_error);
  }
  const Server again({.number = number, .or_free = true}, {});
  EXPECT_EQ(again.port(), number);
}

}  // namespace
}  // namespace sinew::live::port_test
