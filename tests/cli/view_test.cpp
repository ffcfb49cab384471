// `sinew view` on a machine with other users: without the token of its address nobody can read or
// steer anything, and a client that sends nothing, or half of a request, blocks no other.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <list>
#include <thread>

#include "tests/cli/program.h"
#include "tests/cli/wire.h"

namespace sinew::test::view_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;
using namespace std::string_literals;
using Clock = std::chrono::steady_clock;

class View : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!SINEW_HAS_PAGE) GTEST_SKIP() << "built without its page";
    begin({"--no-open"});
  }

  void begin(const Words& more) {
    std::filesystem::remove(workspace_ / "out");
    Words words = {
        "view",  "--live",           "experiments/tune-in-air.toml", "-o", "run", "--no-report",
        "--set", "sequence.repeat=1"};
    words.insert(words.end(), more.begin(), more.end());
    child_ = workspace_.start(words);
    const auto until = Clock::now() + seconds(60);
    while (read_text(workspace_ / "out").find('\n') == std::string::npos && Clock::now() < until)
      std::this_thread::sleep_for(milliseconds(20));
    url_ = read_text(workspace_ / "out");
    ASSERT_THAT(url_, StartsWith("http://127.0.0.1:")) << read_text(workspace_ / "err");
    url_.pop_back();
    port_ = port_of(url_);
    path_ = path_of(url_);
  }
  void TearDown() override {
    if (child_ > 0) (void)end();
  }

  // The exit code after Ctrl-C, -1 where it did not end by itself.
  int end() {
    kill(child_, SIGINT);
    int status = 0;
    for (const auto until = Clock::now() + seconds(60); Clock::now() < until;) {
      if (waitpid(child_, &status, WNOHANG) == child_) {
        child_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      }
      std::this_thread::sleep_for(milliseconds(20));
    }
    kill(child_, SIGKILL);
    waitpid(child_, &status, 0);
    child_ = 0;
    return -1;
  }

  std::string host() const { return host_at(port_); }
  std::string request(const std::string& path, const std::string& more = "") const {
    return request_to(port_, path, more);
  }
  std::string upgrade(const std::string& path) const { return upgrade_to(port_, path); }
  std::string answer(const std::string& text) const {
    Wire wire(port_);
    wire.send(text);
    return wire.hear("\r\n\r\n", seconds(5));
  }

  const Workspace workspace_;
  pid_t child_ = 0;
  std::string url_, path_;  // path_: "/" and the token and "/"
  int port_ = 0;
};

TEST_F(View, WithoutTheTokenNoPageIsInformedOrSteers) {
  ASSERT_THAT(path_, MatchesRegex("/[0-9a-f]{32}/"));
  EXPECT_THAT(answer(request(path_)), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(answer(upgrade(path_ + "live")), StartsWith("HTTP/1.1 101"));

  std::string other = path_;
  other[1] = other[1] == '0' ? '1' : '0';
  std::string last = path_;
  last[32] = last[32] == '0' ? '1' : '0';
  const std::string short_by_one = path_.substr(0, 32) + "/";
  for (const std::string& path :
       {"/"s, "/runs"s, "/run/0"s, other, last, short_by_one, path_.substr(0, 33) + "0/",
        "/" + path_, "//"s, "/?token=" + path_.substr(1, 32), path_.substr(1)}) {
    for (const std::string& text : {request(path), upgrade(path), upgrade(path + "live")}) {
      const std::string got = answer(text);
      EXPECT_THAT(got, StartsWith("HTTP/1.1 40")) << text;
      EXPECT_THAT(got, Not(HasSubstr(path_.substr(1, 32)))) << text;
    }
  }
  Wire wire(port_);
  wire.send(request("/"));
  EXPECT_THAT(wire.hear("printed", seconds(5)), HasSubstr("lacks its token; open the whole one"));
}

TEST_F(View, EachHasATokenOfItsOwn) {
  const std::string first = path_;
  ASSERT_EQ(end(), 0);
  std::filesystem::remove_all(workspace_ / "run");
  begin({"--no-open"});
  EXPECT_NE(path_, first);
}

// The arguments of a command can be read by all users: the browser gets a file that only its user
// can read.
TEST_F(View, TheTokenIsNoWordOfACommand) {
  ASSERT_EQ(end(), 0);
  namespace fs = std::filesystem;
  fs::remove_all(workspace_ / "run");
  for (const char* folder : {"bin", "own"}) fs::create_directory(workspace_ / folder);
  write_text(workspace_ / "bin/xdg-open",
             "#!/bin/sh\nstat -c %a \"$1\" >>opened.new\ncat \"$1\" >>opened.new\n"
             "echo \"$1\" >word\nmv opened.new opened\n");
  fs::permissions(workspace_ / "bin/xdg-open", fs::perms::owner_all);
  const std::string path = getenv("PATH");
  setenv("PATH", ((workspace_ / "bin").string() + ":" + path).c_str(), 1);
  setenv("DISPLAY", ":0", 1);
  setenv("XDG_RUNTIME_DIR", (workspace_ / "own").c_str(), 1);
  begin({});
  setenv("PATH", path.c_str(), 1);
  for (const char* name : {"DISPLAY", "XDG_RUNTIME_DIR"}) unsetenv(name);
  for (const auto until = Clock::now() + seconds(20);
       !fs::exists(workspace_ / "opened") && Clock::now() < until;)
    std::this_thread::sleep_for(milliseconds(20));

  EXPECT_THAT(read_text(workspace_ / "word"), Not(HasSubstr(path_.substr(1, 32))));
  EXPECT_THAT(read_text(workspace_ / "opened"), StartsWith("600\n"));
  EXPECT_THAT(read_text(workspace_ / "opened"), HasSubstr("url=" + url_));
  EXPECT_EQ(names_in(workspace_ / "own").size(), 1u);
  EXPECT_EQ(end(), 0);
  EXPECT_TRUE(names_in(workspace_ / "own").empty());
}

// Four times as many connections as are allowed, with clients that send nothing or half a request.
TEST_F(View, HalfOpenConnectionsBlockNobody) {
  Wire watcher(port_);
  watcher.send(upgrade(path_ + "live"));
  ASSERT_THAT(watcher.hear("\r\n\r\n", seconds(5)), StartsWith("HTTP/1.1 101"));

  const std::string said[] = {
      "", "GET", "GET / HTTP/1.1\r\nHost: " + host() + "\r\nX: y",
      "POST / HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: 99\r\n\r\n"};
  std::list<Wire> silent;
  for (int i = 0; i < 256; ++i) silent.emplace_back(port_).send(said[i % 4]);
  for (int i = 0; i < 10; ++i)
    EXPECT_THAT(answer(request(path_)), StartsWith("HTTP/1.1 200")) << "while they wait, " << i;

  // And while new ones arrive.
  std::atomic<bool> over{false};
  std::thread crowd([&] {
    while (!over) {
      silent.emplace_back(port_);
      if (silent.size() > 300) silent.pop_front();
      std::this_thread::sleep_for(milliseconds(1));
    }
  });
  for (int i = 0; i < 10; ++i)
    EXPECT_THAT(answer(request(path_)), StartsWith("HTTP/1.1 200")) << "while they come, " << i;
  over = true;
  crowd.join();

  // A client that was connected before still receives data.
  watcher.send(masked("{}"));
  EXPECT_THAT(watcher.hear("\"error\"", seconds(5)), HasSubstr("what is to be done"));
  EXPECT_EQ(end(), 0);
  EXPECT_TRUE(std::filesystem::exists(workspace_ / "run/summary.json"));
}

// A client that sends a byte every now and then is closed like one that sends nothing.
TEST_F(View, HalfARequestIsDroppedAfterAWhile) {
  Wire silent(port_), half(port_), slow(port_);
  half.send("GET / HTTP/1.1\r\n");
  slow.send("GET /");
  const auto start = Clock::now();
  while (Clock::now() < start + seconds(20) &&
         !(silent.closed() && half.closed() && slow.closed())) {
    slow.send("a");
    for (Wire* wire : {&silent, &half, &slow}) wire->hear("never", seconds(1));
  }
  EXPECT_TRUE(silent.closed() && half.closed() && slow.closed());
  EXPECT_LT(Clock::now() - start, seconds(14));
}

}  // namespace
}  // namespace sinew::test::view_test
