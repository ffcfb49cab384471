#include "sinew/host/doctor.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/stat.h>

#include "sinew/host/realtime.h"

namespace sinew::host {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream all;
  all << in.rdbuf();
  std::string text = all.str();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

std::vector<fs::path> named(const fs::path& folder, const std::vector<std::string>& starts) {
  std::vector<fs::path> out;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (std::ranges::any_of(starts, [&](const std::string& s) { return name.starts_with(s); }))
      out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

User user_of(const fs::path& root) {
  User out;
  std::istringstream lines(text_of(root / "proc/self/status"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    long real = 0, effective = -1;
    words >> name;
    if (name == "Uid:" && words >> real >> effective) out.id = effective;
    if (name == "Gid:" && words >> real >> effective) out.group = effective;
    if (name == "Groups:")
      for (long group; words >> group;) out.groups.push_back(group);
  }
  return out;
}

bool has_access(const fs::path& file, const User& user) {
  struct stat is {};
  if (::stat(file.c_str(), &is) != 0) return false;
  if (user.id == 0) return true;
  constexpr mode_t both = 06;
  if (static_cast<long>(is.st_uid) == user.id) return (is.st_mode >> 6 & both) == both;
  const auto group = static_cast<long>(is.st_gid);
  if (group == user.group || std::ranges::count(user.groups, group) > 0)
    return (is.st_mode >> 3 & both) == both;
  return (is.st_mode & both) == both;
}

namespace {

// Group of etc/group.
struct Group {
  std::string name, number;
};

std::vector<Group> groups(const fs::path& root) {
  std::vector<Group> out;
  std::istringstream lines(text_of(root / "etc/group"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    Group group;
    std::string password;
    std::getline(words, group.name, ':');
    std::getline(words, password, ':');
    std::getline(words, group.number, ':');
    out.push_back(std::move(group));
  }
  return out;
}

// Returns the commands, each followed by " && ", that make the user a member of a group; empty for
// a member.
std::string joining(const std::string& name, const fs::path& root) {
  const std::vector<Group> all = groups(root);
  const auto group = std::ranges::find(all, name, &Group::name);
  const User user = user_of(root);
  const auto is_its = [&](long number) {
    return group != all.end() && std::to_string(number) == group->number;
  };
  if (is_its(user.group) || std::ranges::any_of(user.groups, is_its)) return "";
  const std::string add = group == all.end() ? fmt::format("sudo groupadd {} && ", name) : "";
  return add + fmt::format("sudo usermod -aG {} $USER && ", name);
}

}  // namespace

std::string group_of(const fs::path& file, const fs::path& root) {
  struct stat is {};
  if (::stat(file.c_str(), &is) != 0) return "";
  const std::string number = std::to_string(is.st_gid);
  const std::vector<Group> all = groups(root);
  const auto group = std::ranges::find(all, number, &Group::number);
  return group == all.end() ? number : group->name;
}

double limit_of(const fs::path& root, const std::string& name) {
  std::istringstream lines(text_of(root / "proc/self/limits"));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name)) continue;
    std::istringstream words(line.substr(name.size()));
    std::string soft;
    words >> soft;
    return soft == "unlimited" ? -1 : std::atof(soft.c_str());
  }
  return 0;
}

namespace {

using Findings = std::vector<Finding>;

// --- devices ---

struct Kind {
  std::string subject, place, group;  // group: the usual group of the devices
  std::vector<std::string> names;     // below /dev
  std::string if_none;                // advice if there is no device
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"serial devices", "serial", "dialout", {"ttyACM", "ttyUSB"}, "sudo dmesg | tail"},
      {"cards", "comedi", "iocard", {"comedi"}, "lsmod | grep comedi"}};
  return all;
}

void check_devices(const Kind& kind, const DoctorOptions& options, Findings& out) {
  const User user = user_of(options.root);
  const std::string why = kind.place == "serial"
                              ? "a board is connected by one"
                              : "a card reads the sensors and switches the valves";
  std::vector<fs::path> devices = named(options.root / "dev", kind.names);
  // A card's device is named comedi and a number; comedi0_subd1 is a part of such a device.
  std::erase_if(devices, [](const fs::path& d) {
    return d.filename().string().find("_subd") != std::string::npos;
  });
  if (devices.empty())
    out.push_back({kind.subject, kind.place, Verdict::missing,
                   "none; is it plugged in, and its "
                   "driver loaded?",
                   why, kind.if_none});
  for (const fs::path& device : devices) {
    const std::string name = "/dev/" + device.filename().string();
    if (has_access(device, user)) {
      out.push_back({kind.subject, kind.place, Verdict::good, name + " may be used", why, ""});
      continue;
    }
    const std::string group = group_of(device, options.root);
    const bool usual = group == kind.group;
    out.push_back(
        {kind.subject, kind.place, Verdict::missing,
         fmt::format("{} may not be used by this user; its group is {}", name, group), why,
         usual ? fmt::format("sudo usermod -aG {} $USER   # then log in again", group)
               : fmt::format("sudo chgrp {0} {1} && sudo chmod 660 {1}", kind.group, name)});
  }
}

// --- USB adapters ---

// FTDI's driver collects bytes for this time before it passes them on [ms].
void check_adapters(const DoctorOptions& options, Findings& out) {
  const fs::path folder = options.root / "sys/bus/usb-serial/devices";
  for (const fs::path& device : named(folder, {"tty"})) {
    const std::string text = text_of(device / "latency_timer");
    if (text.empty()) continue;
    const std::string name = device.filename().string();
    const bool good = text == "1" || text == "2";
    out.push_back({"USB adapter", "serial", good ? Verdict::good : Verdict::advice,
                   fmt::format("{} collects bytes for {} ms", name, text),
                   "a board's word is due every 10 ms; one that waits comes a period late",
                   good ? ""
                        : fmt::format("echo 1 | sudo tee /sys/bus/usb-serial/devices/{}/"
                                      "latency_timer",
                                      name)});
  }
}

// --- real time ---

void check_limits(const DoctorOptions& options, Findings& out) {
  const bool first_user = user_of(options.root).id == 0;
  const double most = limit_of(options.root, "Max realtime priority");
  const double memory = limit_of(options.root, "Max locked memory");
  const bool first = first_user || most < 0 || most >= priority;
  // A run's memory is mostly its log; a gigabyte exceeds the largest so far.
  const bool locked = first_user || memory < 0 || memory >= 1e9;
  const auto said = [](double limit) {
    return limit < 0 ? std::string("unlimited") : fmt::format("{:.0f}", limit);
  };
  const char* file = "/etc/security/limits.d/sinew.conf   # then log in again";
  const std::string join = first && locked ? "" : joining("iocard", options.root);
  out.push_back(
      {"real-time priority", "", first ? Verdict::good : Verdict::advice,
       first_user ? "this is root, who may" : "RLIMIT_RTPRIO is " + said(most),
       fmt::format("the loop requests priority {}, before all other programs", priority),
       first ? "" : fmt::format("{}echo '@iocard - rtprio 90' | sudo tee -a {}", join, file)});
  out.push_back({"locked memory", "", locked ? Verdict::good : Verdict::advice,
                 first_user ? "this is root, who may"
                            : "RLIMIT_MEMLOCK is " + said(memory) + (memory < 0 ? "" : " bytes"),
                 "a page that was put out costs the loop milliseconds",
                 locked ? ""
                        : fmt::format("{}echo '@iocard - memlock unlimited' | sudo tee -a {}",
                                      first ? join : "", file)});
}

void check_kernel(const DoctorOptions& options, Findings& out) {
  const std::string version = text_of(options.root / "proc/sys/kernel/version");
  const bool real_time = text_of(options.root / "sys/kernel/realtime") == "1" ||
                         version.find("PREEMPT_RT") != std::string::npos;
  out.push_back({"kernel", "", real_time ? Verdict::good : Verdict::advice,
                 version.empty() ? "its version is unknown" : version,
                 "one with PREEMPT_RT wakes a program within a bound, any other as a rule",
                 real_time ? "" : "sudo apt-get install linux-image-rt-amd64   # then start it"});

  const fs::path clock = options.root / "sys/devices/system/clocksource/clocksource0";
  const std::string source = text_of(clock / "current_clocksource");
  const bool slow = source == "hpet" || source == "acpi_pm" || source == "jiffies";
  out.push_back({"clock source", "", slow ? Verdict::advice : Verdict::good,
                 source.empty() ? "unknown" : source,
                 "reading hpet or acpi_pm costs a microsecond or more, tsc some nanoseconds",
                 slow ? "sudo dmesg | grep -i tsc   # prints why it was rejected" : ""});

  // Each processor has its own governor; the loop may run on the slowest.
  std::string slowest;
  for (const fs::path& cpu : named(options.root / "sys/devices/system/cpu", {"cpu"})) {
    const std::string governor = text_of(cpu / "cpufreq/scaling_governor");
    if (!governor.empty() && governor != "performance") slowest = governor;
  }
  out.push_back({"CPU governor", "", slowest.empty() ? Verdict::good : Verdict::advice,
                 slowest.empty() ? "performance, or none" : slowest,
                 "a processor that has slowed down wakes up late",
                 slowest.empty() ? "" : "sudo cpupower frequency-set -g performance"});
}

void check_latency(const DoctorOptions& options, Findings& out) {
  if (!options.latency) return;
  const Latency latency = options.latency();
  const LatencyClass c = class_of(latency);
  out.push_back(
      {"timer latency", "", c == LatencyClass::real_time ? Verdict::good : Verdict::advice,
       describe_latency(latency), "an edge of a valve is as late as the wake-up before it",
       c == LatencyClass::real_time ? ""
                                    : "sinew doctor   # again, once the advice above is followed"});
}

// --- programs and libraries ---

bool has_program(const DoctorOptions& options, const std::string& name) {
  return std::ranges::any_of(options.programs, [&](const std::string& folder) {
    return fs::exists(options.root / fs::path(folder).relative_path() / name);
  });
}

bool has_library(const DoctorOptions& options, const std::string& name) {
  for (const char* folder : {"usr/lib", "usr/local/lib", "lib"}) {
    const fs::path here = options.root / folder;
    if (!named(here, {name}).empty()) return true;
    for (const fs::path& below : named(here, {"x86_64-linux", "aarch64-linux", "arm-linux"}))
      if (!named(below, {name}).empty()) return true;
  }
  return false;
}

void check_parts(const DoctorOptions& options, Findings& out) {
  const auto add = [&](bool there, const char* name, const char* place, const char* why,
                       const char* package) {
    out.push_back({name, place, there ? Verdict::good : Verdict::missing,
                   there ? "there" : "not found", why,
                   there ? "" : fmt::format("sudo apt-get install {}", package)});
  };
  add(has_program(options, "qemu-system-arm"), "qemu-system-arm", "emulated",
      "runs a board's program without a board", "qemu-system-arm");
  add(has_program(options, "arm-none-eabi-gcc"), "arm-none-eabi-gcc", "emulated",
      "compiles the board's program", "gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib");
  add(has_library(options, "libcomedi.so"), "libcomedi", "comedi", "reads and writes the card",
      "libcomedi-dev   # then cmake --preset release && cmake --build --preset all");
}

// --- graphics cards ---

void check_cards(const DoctorOptions& options, Findings& out) {
  if (!options.cards) return;
  const auto add = [&](const std::string& found, const char* todo) {
    out.push_back({"graphics card", "", *todo ? Verdict::advice : Verdict::good, found,
                   "one runs thousands of machines of a study at the same time", todo});
  };
  std::string problem;
  const std::vector<card::Properties> cards = options.cards(problem);
  if (cards.empty())
    add("none: " + problem,
        "sudo apt-get install nvidia-driver   # if the computer has a card of NVIDIA");
  for (const card::Properties& c : cards) {
    const std::string found =
        fmt::format("{}: {}, {:.0f} GB, {} multiprocessor{}, driver for CUDA {}", c.number, c.name,
                    static_cast<double>(c.memory) / 1e9, c.multiprocessors,
                    c.multiprocessors == 1 ? "" : "s", c.driver);
    if (!options.has_card_program) {
      add(found + "; this build has no program for it",
          "tools/install-dependencies.sh card   # then "
          "cmake --preset release && cmake --build --preset all");
      continue;
    }
    try {
      const auto speed = options.card_speed ? options.card_speed(c) : std::nullopt;
      add(found + (speed ? fmt::format(", {:.0f} walks of test 1 per second", *speed) : ""), "");
    } catch (const std::runtime_error& e) {
      add(fmt::format("{}; {}", found, e.what()), "device=cpu runs studies without it");
    }
  }
}

}  // namespace

std::vector<Finding> examine(const DoctorOptions& options) {
  Findings out;
  for (const Kind& kind : kinds()) check_devices(kind, options, out);
  check_adapters(options, out);
  check_parts(options, out);
  check_limits(options, out);
  check_kernel(options, out);
  check_latency(options, out);
  check_cards(options, out);
  return out;
}

// One usable device is enough.
bool is_ready(const std::vector<Finding>& findings, const std::string& place) {
  for (const Finding& f : findings) {
    if (f.place != place || f.verdict != Verdict::missing) continue;
    const bool another = std::ranges::any_of(findings, [&](const Finding& other) {
      return other.subject == f.subject && other.verdict == Verdict::good;
    });
    if (!another) return false;
  }
  return true;
}

namespace {

std::string_view word(Verdict v) {
  return v == Verdict::good ? "good" : v == Verdict::advice ? "advice" : "missing";
}

}  // namespace

std::string text_of(const std::vector<Finding>& findings, bool color) {
  std::string out;
  for (const Finding& f : findings) {
    const std::string verdict = fmt::format("{:<8}", word(f.verdict));
    const bool red = color && f.verdict == Verdict::missing;
    out += red ? "\033[31m" + verdict + "\033[0m" : verdict;
    out += f.subject + ": " + f.found + "\n";
    if (f.verdict == Verdict::good) continue;
    out += fmt::format("        {}{}\n", f.why, f.place.empty() ? "" : " (" + f.place + ":)");
    if (!f.todo.empty()) out += "        " + f.todo + "\n";
  }
  return out;
}

Json json_of(const std::vector<Finding>& findings, const std::string& place) {
  Json list = Json::array();
  for (const Finding& f : findings) {
    Json item{
        {"subject", f.subject}, {"verdict", word(f.verdict)}, {"found", f.found}, {"why", f.why}};
    if (!f.place.empty()) item["place"] = f.place;
    if (!f.todo.empty()) item["todo"] = f.todo;
    list.push_back(std::move(item));
  }
  return {{"format", "sinew.doctor/1"},
          {"place", place},
          {"ready", is_ready(findings, place)},
          {"findings", std::move(list)}};
}

}  // namespace sinew::host
