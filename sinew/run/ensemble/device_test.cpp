// Names of devices, and the refusal of a card that cannot be used.
#include "sinew/run/ensemble/device.h"

#include <dlfcn.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <stdexcept>

#include "sinew/card/walk.h"
#include "sinew/config/diagnostics.h"
#include "tests/places.h"

namespace sinew::run::device_test {
namespace {

using ::testing::HasSubstr;

TEST(Device, HasAName) {
  EXPECT_EQ(parse_device("auto"), Device{});
  EXPECT_EQ(parse_device("cpu").kind, Device::Kind::cpu);
  EXPECT_EQ(parse_device("gpu"), parse_device("gpu:0"));
  EXPECT_EQ(parse_device("gpu:12"), (Device{.kind = Device::Kind::gpu, .number = 12}));
  for (const char* wrong : {"", "GPU", "gpu:", "gpu:-1", "gpu:1x", "cpu:0", "gpu:99999999999"})
    EXPECT_THROW(parse_device(wrong), config::Error) << wrong;
}

TEST(Device, ACardThatCannotBeUsedIsRefused) {
  const auto refusal = [](const char* device, const char* cards) -> std::string {
    ::setenv("SINEW_FAKE_CARD", cards, 1);
    try {
      (void)chosen(parse_device(device));
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  };
  ASSERT_TRUE(dlopen((test::build_dir() + "/tests/graphics_card/libcuda.so.1").c_str(), RTLD_NOW))
      << dlerror();
  EXPECT_EQ(refusal("auto", "none"), "");
  EXPECT_EQ(refusal("cpu", "none"), "");
  EXPECT_EQ(refusal("gpu", "none"),
            "found no graphics card: the driver found none (CUDA_ERROR_NO_DEVICE, 100); expected a "
            "usable one for device=gpu:0; try device=cpu, or device=auto");
  EXPECT_THAT(refusal("gpu:0", "cards=3 old-card"), HasSubstr("of this number, but 2 others;"));
  const std::string with_card = refusal("gpu:1", "cards=2");
  if (card::walk_ptx().empty())
    EXPECT_THAT(with_card, HasSubstr("a build without a program for graphics cards"));
  else
    EXPECT_EQ(with_card, "");
  ::unsetenv("SINEW_FAKE_CARD");
}

}  // namespace
}  // namespace sinew::run::device_test
