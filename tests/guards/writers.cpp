#include "tests/guards/writers.h"
#include "tests/places.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

namespace sinew::test {

namespace fs = std::filesystem;

namespace {

const std::string bench = "experiments/one-joint.toml";
const std::string stand = "experiments/rig/trapped-60-6.toml";

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Wall time is not part of a result.
std::string comparable(const fs::path& file) {
  const std::string text = read_text(file);
  if (file.filename() != "summary.json") return text;
  nlohmann::ordered_json summary = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!summary.is_object()) return text;
  summary.erase("host");
  return summary.dump(2);
}

Writer of_a_run(const std::string& name, const std::string& experiment, const Words& how,
                const Words& other) {
  const std::string target = "out/" + name;
  const Words words = with({"run", experiment, "-o", target, "--force", "--quiet"}, how);
  return {name, with(words, other), words, with(words, {"--set", "nothing.such=1"}), target};
}

// `-o target --force` after the command that writes from `input`, or from `other`.
Writer of_a_file(const std::string& name, const std::string& target, const Words& before,
                 const std::string& input, const std::string& other, const Words& after = {}) {
  const auto words = [&](const std::string& from) {
    return with(with(with(before, {from}), after), {"-o", "out/" + target, "--force", "--quiet"});
  };
  return {name, words(other), words(input), words("missing"), "out/" + target};
}

}  // namespace

void prepare(const Workspace& w) {
  fs::create_directory(w / "out");
  for (const auto& [folder, seed] : {std::pair{"one", "seed=1"}, {"two", "seed=2"}})
    ASSERT_EQ(w.sinew({"run", bench, "-o", folder, "--set", seed, "--no-report"}).code, 0);
  write_text(w / "mesh.csv", "length [mm],diameter [mm]\n65,11.7\n75,10.5\n85,9.0\n95,6.8\n");
  write_text(w / "mesh2.csv", "length [mm],diameter [mm]\n64,11.7\n74,10.5\n84,9.0\n94,6.8\n");
}

std::vector<Writer> writers(const Workspace& w) {
  std::vector<Writer> out = {
      of_a_run("run", bench, {"--no-report"}, {"--set", "seed=7"}),
      of_a_run("stand", stand, {"--no-report"}, {"--set", "seed=7"}),
      of_a_file("export", "e.csv", {"export"}, "one", "two", {"--csv"}),
      of_a_file("analyze", "a.json", {"analyze"}, "one", "two"),
      of_a_file("figures", "figures", {"figures"}, "one", "two", {"--format", "csv"}),
      of_a_file("identify", "g.toml", {"identify", "geometry"}, "mesh.csv", "mesh2.csv",
                {"--no-report"}),
  };
  const Words sweep = {"sweep",   bench,      "-o",         "out/s.csv", "--force",
                       "--quiet", "--report", "duration_s", "--seeds"};
  out.push_back({"sweep", with(sweep, {"3"}), with(sweep, {"2"}),
                 with(sweep, {"2", "--report", "durations_s"}), "out/s.csv"});
  if (w.sinew({"report", "one"}).err.find("npm") != std::string::npos) return out;
  out.push_back(of_a_run("run with page", bench, {}, {"--set", "seed=7"}));
  out.push_back(of_a_file("report", "r.html", {"report"}, "one", "two"));
  out.push_back(of_a_file("compare", "c.html", {"compare", "one"}, "two", "one"));
  return out;
}

State state(const fs::path& target) {
  State out;
  if (fs::is_regular_file(target)) out[""] = comparable(target);
  if (!fs::is_directory(target)) return out;
  for (const auto& entry : fs::recursive_directory_iterator(target)) {
    const std::string name = fs::relative(entry.path(), target).string();
    if (entry.is_regular_file() && !name.starts_with("unfinished/"))
      out[name] = comparable(entry.path());
  }
  return out;
}

std::string difference(const State& found, const State& expected) {
  std::string out;
  for (const auto& [name, text] : expected)
    if (!found.contains(name)) out += name + " is missing; ";
  for (const auto& [name, text] : found) {
    const auto at = expected.find(name);
    if (at == expected.end()) out += name + " is new; ";
    if (at != expected.end() && at->second != text)
      out += name + " differs, " + std::to_string(text.size()) + " bytes; ";
  }
  return out;
}

std::string neither(const State& found, const Results& results) {
  const std::string from_old = difference(found, results.old);
  const std::string from_fresh = difference(found, results.fresh);
  if (from_old.empty() || from_fresh.empty()) return "";
  return "from the old: " + from_old + "\nfrom the new: " + from_fresh;
}

Results both(const Workspace& w, const Writer& writer) {
  Results out;
  const fs::path target = w / writer.target;
  const Ended fresh = run(w, writer.fresh);
  EXPECT_EQ(fresh.code, 0) << writer.name << fresh.output;
  out.fresh = state(target);
  fs::remove_all(target);
  const Ended old = run(w, writer.old);
  EXPECT_EQ(old.code, 0) << writer.name << old.output;
  out.old = state(target);
  EXPECT_NE(difference(out.old, out.fresh), "") << writer.name << ": nothing to tell apart";
  fs::remove_all(w / "kept");
  fs::copy(target, w / "kept", fs::copy_options::recursive);
  return out;
}

void put_back(const Workspace& w, const Writer& writer) {
  fs::remove_all(w / writer.target);
  fs::remove_all(w / (writer.target + ".part"));
  fs::copy(w / "kept", w / writer.target, fs::copy_options::recursive);
}

Started start(const Workspace& w, const Words& words, const std::function<void()>& before) {
  std::vector<char*> arguments{const_cast<char*>("sinew")};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(ends[1], stream);
    for (const int end : ends) close(end);
    if (chdir(w.path().c_str()) != 0) _exit(126);
    if (before) before();
    execv(sinew::test::program().c_str(), arguments.data());
    _exit(126);
  }
  close(ends[1]);
  return {child, ends[0]};
}

Ended ended(const Started& process) {
  Ended out;
  char room[4096];
  for (ssize_t n = 0; (n = read(process.output, room, sizeof room)) > 0;)
    out.output.append(room, static_cast<std::size_t>(n));
  close(process.output);
  int status = 0;
  waitpid(process.pid, &status, 0);
  if (WIFEXITED(status)) out.code = WEXITSTATUS(status);
  return out;
}

Ended run(const Workspace& w, const Words& words, const std::function<void()>& before) {
  return ended(start(w, words, before));
}

int tries(int usual) {
  const char* asked = std::getenv("SINEW_GUARD_COUNT");
  return asked ? std::atoi(asked) : usual;
}

}  // namespace sinew::test
