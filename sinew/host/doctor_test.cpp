// Simulated computer with one defect at a time: each is found, and advice is given.
#include "sinew/host/doctor.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace sinew::host::doctor_test {
namespace {

namespace fs = std::filesystem;

// Computer without any defect, until a test adds one.
class Doctor : public ::testing::Test {
 protected:
  Doctor() {
    std::string name = (fs::temp_directory_path() / "sinew-doctor-XXXXXX").string();
    root_ = mkdtemp(name.data());
    // The user who runs the test does not have this number, so that only modes decide.
    put("proc/self/status",
        "Name:\tsinew\nUid:\t64001\t64001\nGid:\t64001\t64001\nGroups:\t64002\n");
    put("proc/self/limits",
        "Limit                     Soft Limit           Hard Limit           Units\n"
        "Max locked memory         unlimited            unlimited            bytes\n"
        "Max realtime priority     90                   90                   \n");
    put("proc/sys/kernel/version", "#1 SMP PREEMPT_RT Debian 6.1.99-1");
    put("sys/kernel/realtime", "1");
    put("sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc");
    put("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
    put("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance");
    put("sys/bus/usb-serial/devices/ttyUSB0/latency_timer", "1");
    put("usr/bin/qemu-system-arm", "");
    put("usr/bin/arm-none-eabi-gcc", "");
    put("usr/lib/libcomedi.so.0", "");
    put("dev/ttyUSB0", "");
    put("dev/comedi0", "");
    mode("dev/ttyUSB0", 0666);
    mode("dev/comedi0", 0666);
  }
  ~Doctor() override {
    std::error_code none;
    fs::remove_all(root_, none);
  }

  void put(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << "\n";
  }
  void mode(const std::string& file, mode_t bits) const {
    ASSERT_EQ(::chmod((root_ / file).c_str(), bits), 0);
  }
  std::vector<Finding> look(Latency latency = {1e-6, 5e-6, 20e-6, 10'000}) const {
    return examine({.root = root_,
                    .latency = [=] { return latency; },
                    .cards =
                        [&](std::string& problem) {
                          problem = problem_;
                          return cards_;
                        },
                    .has_card_program = has_card_program_,
                    .card_speed = card_speed_});
  }
  static Finding find(const std::vector<Finding>& all, const std::string& subject) {
    for (const Finding& f : all)
      if (f.subject == subject) return f;
    ADD_FAILURE() << "nothing said of " << subject;
    return {};
  }
  // Expects that only this finding is not good; returns it.
  Finding only(const std::string& subject) const {
    const std::vector<Finding> all = look();
    for (const Finding& f : all) {
      const bool as_meant = f.subject == subject || f.verdict == Verdict::good;
      EXPECT_TRUE(as_meant) << f.subject << ": " << f.found;
    }
    const Finding out = find(all, subject);
    EXPECT_NE(out.verdict, Verdict::good) << subject;
    EXPECT_FALSE(out.found.empty() || out.why.empty() || out.todo.empty()) << subject;
    return out;
  }

  fs::path root_;
  std::vector<card::Properties> cards_{{.number = 0,
                                        .name = "NVIDIA H200",
                                        .multiprocessors = 132,
                                        .memory = 150'000'000'000,
                                        .driver = "13.0"}};
  std::string problem_;
  bool has_card_program_ = true;
  std::function<std::optional<double>(const card::Properties&)> card_speed_;
};

TEST_F(Doctor, OfAComputerOnWhichNothingIsWrongAllIsGood) {
  for (const Finding& f : look()) {
    EXPECT_EQ(f.verdict, Verdict::good) << f.subject << ": " << f.found;
    EXPECT_EQ(f.todo, "") << f.subject;
  }
  for (const char* place : {"simulated", "serial", "emulated", "comedi"})
    EXPECT_TRUE(is_ready(look(), place)) << place;
}

TEST_F(Doctor, OfATreeWithNothingInItASimulationIsReadyAndNothingElse) {
  const std::vector<Finding> all = examine({.root = root_ / "nowhere"});
  EXPECT_TRUE(is_ready(all, "simulated"));
  for (const char* place : {"serial", "emulated", "comedi"}) EXPECT_FALSE(is_ready(all, place));
}

TEST_F(Doctor, ADeviceOfAnotherGroupNamesTheGroup) {
  struct stat is {};
  ASSERT_EQ(::stat((root_ / "dev/comedi0").c_str(), &is), 0);
  put("etc/group", "root:x:99999:\niocard:x:" + std::to_string(is.st_gid) + ":\n");
  mode("dev/comedi0", 0660);
  EXPECT_EQ(only("cards").todo, "sudo usermod -aG iocard $USER   # then log in again");
  EXPECT_FALSE(is_ready(look(), "comedi"));
  EXPECT_TRUE(is_ready(look(), "serial"));

  put("etc/group", "wheel:x:" + std::to_string(is.st_gid) + ":\n");
  EXPECT_EQ(only("cards").todo, "sudo chgrp iocard /dev/comedi0 && sudo chmod 660 /dev/comedi0");
}

TEST_F(Doctor, MembersOfTheGroupAndTheOwnerMayUseADevice) {
  struct stat is {};
  ASSERT_EQ(::stat((root_ / "dev/comedi0").c_str(), &is), 0);
  const auto as = [&](long user, long group) {
    put("proc/self/status", "Uid:\t1\t" + std::to_string(user) + "\nGid:\t1\t1\nGroups:\t7 " +
                                std::to_string(group) + "\n");
    return has_access(root_ / "dev/comedi0", user_of(root_));
  };
  const auto owner = static_cast<long>(is.st_uid), group = static_cast<long>(is.st_gid);
  mode("dev/comedi0", 0660);
  EXPECT_TRUE(as(64001, group));
  EXPECT_FALSE(as(64001, 64002));
  EXPECT_TRUE(as(0, 64002));
  EXPECT_TRUE(as(owner, 64002));
  mode("dev/comedi0", 0640);  // reading alone is not enough to drive a machine
  EXPECT_FALSE(as(64001, group));
}

TEST_F(Doctor, APartOfACardIsNoCardAndOneDeviceThatMayBeUsedIsEnough) {
  put("dev/ttyACM0", "");
  mode("dev/ttyACM0", 0600);
  EXPECT_TRUE(is_ready(look(), "serial"));
  fs::remove(root_ / "dev/ttyACM0");
  fs::rename(root_ / "dev/comedi0", root_ / "dev/comedi0_subd1");
  EXPECT_NE(only("cards").found.find("none"), std::string::npos);
}

TEST_F(Doctor, WhatIsNotPluggedInOrNotInstalledIsMissing) {
  fs::remove(root_ / "usr/lib/libcomedi.so.0");
  EXPECT_EQ(only("libcomedi").todo,
            "sudo apt-get install libcomedi-dev   # then cmake --preset release && cmake --build "
            "--preset all");
  EXPECT_FALSE(is_ready(look(), "comedi"));
  put("usr/lib/x86_64-linux-gnu/libcomedi.so.0", "");
  EXPECT_TRUE(is_ready(look(), "comedi"));
  for (const char* program : {"qemu-system-arm", "arm-none-eabi-gcc"}) {
    fs::remove(root_ / "usr/bin" / program);
    EXPECT_NE(only(program).todo.find("sudo apt-get install "), std::string::npos);
    EXPECT_FALSE(is_ready(look(), "emulated"));
    put(std::string("usr/local/bin/") + program, "");
  }
  fs::remove(root_ / "dev/ttyUSB0");
  EXPECT_EQ(only("serial devices").todo, "sudo dmesg | tail");
}

TEST_F(Doctor, LimitsThatForbidRealTimeAreAdviceAndRootHasNone) {
  put("proc/self/limits", "Max locked memory         unlimited\nMax realtime priority     0\n");
  EXPECT_EQ(only("real-time priority").found, "RLIMIT_RTPRIO is 0");
  put("proc/self/limits", "Max locked memory         8388608\nMax realtime priority     90\n");
  EXPECT_EQ(only("locked memory").found, "RLIMIT_MEMLOCK is 8388608 bytes");
  EXPECT_TRUE(is_ready(look(), "comedi"));
  put("proc/self/status", "Uid:\t0\t0\n");
  for (const Finding& f : look()) EXPECT_EQ(f.verdict, Verdict::good) << f.subject;
}

TEST_F(Doctor, TheGroupOfTheLimitsIsJoinedByWhoIsNoMember) {
  const std::string priority =
      "echo '@iocard - rtprio 90' | sudo tee -a /etc/security/limits.d/sinew.conf   # then log in "
      "again";
  const std::string memory =
      "echo '@iocard - memlock unlimited' | sudo tee -a /etc/security/limits.d/sinew.conf   # then "
      "log in again";
  const std::string join = "sudo usermod -aG iocard $USER && ";
  put("proc/self/limits", "Max locked memory         8388608\nMax realtime priority     0\n");
  const auto todo = [&](const char* subject) { return find(look(), subject).todo; };
  EXPECT_EQ(todo("real-time priority"), "sudo groupadd iocard && " + join + priority);
  EXPECT_EQ(todo("locked memory"), memory) << "the advice before it names the group";

  put("etc/group", "iocard:x:64003:\n");
  EXPECT_EQ(todo("real-time priority"), join + priority);
  put("etc/group", "iocard:x:64002:\n");
  EXPECT_EQ(todo("real-time priority"), priority);

  put("etc/group", "iocard:x:64003:\n");
  put("proc/self/limits", "Max locked memory         8388608\nMax realtime priority     90\n");
  EXPECT_EQ(todo("locked memory"), join + memory);
}

TEST_F(Doctor, AKernelWithoutAPromiseIsAdviceHoweverTheOtherReportsIt) {
  put("proc/sys/kernel/version", "#1 SMP PREEMPT_DYNAMIC Debian 6.1.99-1");
  EXPECT_EQ(find(look(), "kernel").verdict, Verdict::good) << "/sys/kernel/realtime says 1";
  fs::remove(root_ / "sys/kernel/realtime");
  EXPECT_NE(only("kernel").todo.find("linux-image-rt-amd64"), std::string::npos);
  put("proc/sys/kernel/version", "#1 SMP PREEMPT_RT");
  EXPECT_EQ(find(look(), "kernel").verdict, Verdict::good);
}

TEST_F(Doctor, ASlowClockAndOneProcessorThatSlowsDownAreAdvice) {
  put("sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet");
  EXPECT_EQ(only("clock source").found, "hpet");
  put("sys/devices/system/clocksource/clocksource0/current_clocksource", "kvm-clock");
  put("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave");
  EXPECT_EQ(only("CPU governor").found, "powersave");
}

TEST_F(Doctor, AnAdapterThatCollectsFor16MillisecondsIsReportedWithTheRemedy) {
  put("sys/bus/usb-serial/devices/ttyUSB0/latency_timer", "16");
  const Finding said = only("USB adapter");
  EXPECT_EQ(said.found, "ttyUSB0 collects bytes for 16 ms");
  EXPECT_EQ(said.todo, "echo 1 | sudo tee /sys/bus/usb-serial/devices/ttyUSB0/latency_timer");
}

TEST_F(Doctor, EachGraphicsCardIsListedAndTheReasonIfItCannotBeUsed) {
  EXPECT_EQ(find(look(), "graphics card").found,
            "0: NVIDIA H200, 150 GB, 132 multiprocessors, driver for CUDA 13.0");
  card_speed_ = [](const card::Properties&) { return std::nullopt; };
  EXPECT_TRUE(find(look(), "graphics card").found.ends_with("driver for CUDA 13.0"));
  card_speed_ = [](const card::Properties&) { return 1234.5678; };
  EXPECT_TRUE(find(look(), "graphics card").found.ends_with(", 1235 walks of test 1 per second"));
  card_speed_ = [](const card::Properties&) -> std::optional<double> {
    throw std::runtime_error("the graphics card failed");
  };
  EXPECT_TRUE(only("graphics card").found.ends_with("; the graphics card failed"));
  has_card_program_ = false;
  const Finding unused = only("graphics card");
  EXPECT_TRUE(unused.found.ends_with("; this build has no program for it")) << unused.found;
  EXPECT_TRUE(unused.todo.starts_with("tools/install-dependencies.sh card ")) << unused.todo;
  cards_.clear();
  problem_ = "no driver of NVIDIA";
  EXPECT_EQ(only("graphics card").found, "none: no driver of NVIDIA");
}

TEST_F(Doctor, ALateTimerIsAdviceWithItsClass) {
  const Finding late = find(look({1e-6, 2e-4, 5e-3, 10'000}), "timer latency");
  EXPECT_EQ(late.verdict, Verdict::advice);
  EXPECT_TRUE(late.found.starts_with("unfit: ")) << late.found;
  // Without a measurement there is no finding.
  for (const Finding& f : examine({.root = root_})) EXPECT_NE(f.subject, "timer latency");
}

}  // namespace
}  // namespace sinew::host::doctor_test
