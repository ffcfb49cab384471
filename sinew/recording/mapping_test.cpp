#include "sinew/recording/mapping.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "sinew/config/diagnostics.h"

namespace sinew::recording::mapping_test {
namespace {

namespace fs = std::filesystem;

class MappingTest : public ::testing::Test {
 protected:
  MappingTest() {
    std::string name = (fs::temp_directory_path() / "sinew-mapping-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~MappingTest() override { fs::remove_all(folder_); }

  std::string put(const std::string& text) const {
    std::ofstream(folder_ / "m.toml") << text;
    return (folder_ / "m.toml").string();
  }
  std::string error_of(const std::string& text) const {
    try {
      (void)load_mapping(put(text));
    } catch (const config::Error& e) {
      return e.what();
    }
    return "no error";
  }

  fs::path folder_;
};

Mapping full() {
  Mapping m;
  m.table = {.encoding = "latin1",
             .decimal = ",",
             .thousands = ".",
             .dates = "day first",
             .spread_times = true,
             .drop_incomplete = true,
             .columns = {"t [s]", "a \"b\" [N]"}};
  m.clock = {.column = "Zeit", .unit = "ms", .scale = 0.997, .start = "12.5 s"};
  map_where(m, "Test", "fill, 3");
  map_channel(m, "/joint/elbow/angle", "Winkel \\ \"a\"");
  map_unit(m, "Winkel \\ \"a\"", "deg");
  map_scale(m, "Winkel \\ \"a\"", -1.0000000000000002);
  map_offset(m, "Winkel \\ \"a\"", "90 deg");
  map_unit(m, "elbow_angle", "rad");
  m.keep_others = true;
  return m;
}

TEST_F(MappingTest, ComesBackFromItsFile) {
  const Mapping m = full();
  const Mapping back = load_mapping(put(text_of(m)));
  EXPECT_EQ(text_of(back), text_of(m));
  ASSERT_EQ(back.columns.size(), 2u);
  EXPECT_EQ(back.columns[0].name, "Winkel \\ \"a\"");
  EXPECT_EQ(back.columns[0].scale, -1.0000000000000002);
  EXPECT_EQ(back.clock.scale, 0.997);
  EXPECT_EQ(back.table.columns, m.table.columns);
  EXPECT_TRUE(back.keep_others);
  EXPECT_EQ(text_of(load_mapping(put(text_of(Mapping{})))), text_of(Mapping{}));
}

TEST_F(MappingTest, LaterWordsStandInThePlaceOfEarlierOnes) {
  Mapping later;
  map_channel(later, "/joint/elbow/angle", "W");  // another column for the channel
  map_unit(later, "elbow_angle", "deg");
  later.clock.rate = "100 Hz";
  const Mapping m = merged(full(), later);
  ASSERT_EQ(m.columns.size(), 2u);
  EXPECT_EQ(m.columns[0].unit, "deg");
  EXPECT_EQ(m.columns[1].name, "W");
  EXPECT_EQ(m.clock.column, "");
  EXPECT_EQ(m.clock.scale, 0.997);
  check_mapping(m, "m.toml");
}

TEST_F(MappingTest, ReportsWhatIsWrong) {
  const std::string begin = "format = \"sinew.mapping/1\"\n";
  const auto wrong = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(error_of(text).find(part), std::string::npos) << part << "\nin: " << error_of(text);
  };
  wrong("format = \"sinew.mapping/2\"\n", "sinew.mapping/2");
  wrong("format = \"sinew.robot/1\"\nname = \"x\"\n", "\"sinew.mapping/1\"");
  wrong(begin + "[[column]]\nname = \"a\"\nchanel = \"/x\"\n", "channel");
  wrong(begin + "[[column]]\nname = \"a\"\nchannel = \"x\"\n", "try \"/x\"");
  wrong(begin + "[[column]]\nname = \"a\"\nscale = 0\n", "scale");
  wrong(begin + "[[column]]\nname = \"a\"\n[[column]]\nname = \"a\"\n", "a second time");
  wrong(begin +
            "[[column]]\nname = \"a\"\nchannel = \"/x\"\n[[column]]\nname = \"b\"\nchannel = "
            "\"/x\"\n",
        "one column for it: a or b");
  wrong(begin + "[clock]\ncolumn = \"t\"\nrate = \"1 Hz\"\n", "one of the two");
  wrong(begin + "[clock]\nscale = 1000\n", "clock.scale");
  for (const double scale : {0.0, -1.0, 0.4, 1000.0, std::nan("")}) {
    Mapping stated;
    stated.clock.scale = scale;
    EXPECT_THROW(check_mapping(stated, ""), config::Error) << scale;
  }
}

}  // namespace
}  // namespace sinew::recording::mapping_test
