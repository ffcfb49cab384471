// Other programs that are started, and the reasons if they are not.
#include "sinew/host/module.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace sinew::host::module_test {
namespace {

namespace fs = std::filesystem;

class OtherProgram : public ::testing::Test {
 protected:
  OtherProgram() : path_(std::getenv("PATH")) {
    fs::create_directories(folder_);
    ::setenv("PATH", folder_.c_str(), 1);
  }
  ~OtherProgram() override {
    ::setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder_);
  }

  void put(const char* text, fs::perms permissions) const {
    std::ofstream(folder_ / "tool") << text;
    fs::permissions(folder_ / "tool", permissions);
  }

  static std::string message() {
    try {
      return "exit code " + std::to_string(exit_code_of({"tool"}, "no tool; try this"));
    } catch (const std::exception& e) {
      return e.what();
    }
  }

  const std::string path_;
  const fs::path folder_ = fs::temp_directory_path() / ("sinew-module-" + std::to_string(getpid()));
};

TEST_F(OtherProgram, ItsExitCodeIsReturned) {
  put("#!/bin/sh\nexit 127\n", fs::perms::owner_all);
  EXPECT_EQ(message(), "exit code 127");
  put("#!/bin/sh\nkill -9 $$\n", fs::perms::owner_all);
  EXPECT_EQ(message(), "exit code 1");
}

TEST_F(OtherProgram, AMissingOneHasAHint) { EXPECT_EQ(message(), "no tool; try this"); }

TEST_F(OtherProgram, OneWithoutPermissionIsNotMissing) {
  put("#!/bin/sh\n", fs::perms::owner_read);
  EXPECT_EQ(message(), "tool: cannot be started: Permission denied");
}

// The system reports a lack of permission here, as for a folder that cannot be read.
TEST_F(OtherProgram, AFolderOfItsNameIsNoProgram) {
  fs::create_directories(folder_ / "tool");
  EXPECT_EQ(message(), "no tool; try this");
}

}  // namespace
}  // namespace sinew::host::module_test
