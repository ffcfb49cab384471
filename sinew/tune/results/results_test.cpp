// A study's file: added rows survive the end of any process, and rows of other studies are refused.
#include "sinew/tune/results/results.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "sinew/config/diagnostics.h"
#include "sinew/log/file.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::tune::results_test {
namespace {

namespace fs = std::filesystem;

const std::string root = sinew::test::source_dir();
const std::string lever = root + "/experiments/one-joint.toml";

Sweep study(int seeds_of = 4) {
  return {.experiment = lever,
          .axes = {parse_axis("low_level.duty_rounding=none,truncate sum"), seeds(seeds_of)},
          .report = parse_figures("sequence_duration_s [ms], air_used_kg")};
}

// Artificial rows: numbers, words, empty cells, and texts that CSV has to quote.
std::vector<Row> some_rows() {
  return {{.point = 0, .cells = {"none", "1", "1e-05", "0.30000000000000004", "ok"}, .ok = true},
          {.point = 3,
           .cells = {"none", "4", "", "", "refused: a \"b\",\n\xff"},
           .notes = {.lacks = {}, .differs = {}}},
          {.point = 5,
           .cells = {"truncate sum", "2", "7", "0", "differs in air_used_kg"},
           .ok = true,
           .notes = {.lacks = {"x_m"},
                     .differs = {"air_used_kg"},
                     .stop_reached = true,
                     .no_air = true,
                     .out_of_reach = true}}};
}

bool same(const Row& a, const Row& b) {
  return a.point == b.point && a.cells == b.cells && a.ok == b.ok && a.notes == b.notes;
}

using test::message;

class ResultsTest : public ::testing::Test {
 protected:
  ResultsTest() { fs::create_directories(folder_); }
  ~ResultsTest() override { fs::remove_all(folder_); }

  // Returns the first cell of each row of a result.
  std::vector<std::string> ask(const std::string& sql) const {
    sqlite3* db = nullptr;
    std::vector<std::string> out;
    EXPECT_EQ(sqlite3_open_v2(file_.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    const auto take = [](void* to, int, char** cells, char**) {
      static_cast<std::vector<std::string>*>(to)->push_back(cells[0] ? cells[0] : "NULL");
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), take, &out, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
    return out;
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("sinew-results-" + std::to_string(getpid()));
  const fs::path file_ = folder_ / "study.db";
};

TEST_F(ResultsTest, HoldsRowsAsTheyAre) {
  std::vector<Row> rows = some_rows();
  {
    Results results(file_, request_of(study()));
    EXPECT_TRUE(results.rows().empty());
    for (const Row& row : rows) EXPECT_TRUE(results.add(row));
    EXPECT_EQ(ask("SELECT count(*) FROM run"), std::vector<std::string>{"3"}) << "while it is open";
  }
  rows[1].cells.back() = "refused: a \"b\",\n\xef\xbf\xbd";  // invalid UTF-8 is replaced
  Results again(file_, request_of(study()));
  const std::vector<Row> there = again.rows();
  ASSERT_EQ(there.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_TRUE(same(there[i], rows[i])) << i;
}

TEST_F(ResultsTest, IsFoundByItsHeadings) {
  {
    Results results(file_, request_of(study()));
    results.add_all(some_rows());
  }
  using Answer = std::vector<std::string>;
  EXPECT_EQ(ask("SELECT sum(\"sequence_duration [ms]\") FROM run WHERE ok"), Answer{"7.00001"});
  EXPECT_EQ(ask("SELECT typeof(seed) FROM run WHERE point = 0"), Answer{"integer"});
  EXPECT_EQ(ask("SELECT \"low_level.duty_rounding\" FROM run WHERE no_air"),
            Answer{"truncate sum"});
  EXPECT_EQ(ask("SELECT \"air_used [kg]\" FROM run WHERE NOT ok"), Answer{"NULL"});
  EXPECT_EQ(ask("SELECT value FROM study WHERE key = 'points'"), Answer{"8"});
  EXPECT_EQ(ask("PRAGMA journal_mode"), Answer{"wal"});
}

TEST_F(ResultsTest, ThatGotNoRowIsRemoved) {
  { const Results results(file_, request_of(study())); }
  EXPECT_TRUE(fs::is_empty(folder_));
  { Results(file_, request_of(study())).add(some_rows()[0]); }
  { const Results results(file_, request_of(study())); }
  EXPECT_TRUE(fs::exists(file_));
}

// An added row is stored, whenever its writer is killed.
TEST_F(ResultsTest, AKilledWriterLeavesWhatItAdded) {
  const StudyRequest request = request_of(study(1000));
  std::size_t before = 0;
  for (int i = 0; i < 5; ++i) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t writer = fork();
    if (writer == 0) {
      Results results(file_, request);
      Row row = some_rows()[0];
      for (row.point = before; row.point < 2000; ++row.point) {
        results.add(row);
        if (write(ends[1], "x", 1) != 1) _exit(1);
      }
      _exit(0);
    }
    close(ends[1]);
    char told[64];
    std::size_t added = 0;
    while (added < 40u + 30u * static_cast<unsigned>(i)) {
      const ssize_t n = read(ends[0], told, sizeof told);
      ASSERT_GT(n, 0);
      added += static_cast<std::size_t>(n);
    }
    kill(writer, SIGKILL);
    for (ssize_t n = 0; (n = read(ends[0], told, sizeof told)) > 0;)
      added += static_cast<std::size_t>(n);
    close(ends[0]);
    waitpid(writer, nullptr, 0);
    const std::size_t there = read_results(file_).rows.size();
    EXPECT_GE(there, before + added);
    EXPECT_LE(there, before + added + 1) << "added, and not told of";
    before = there;
  }
}

TEST_F(ResultsTest, RefusesAnotherStudyAndReportsWhatDiffers) {
  { Results(file_, request_of(study())).add(some_rows()[0]); }
  const auto refusal = [&](const Sweep& s) {
    return message([&] { const Results results(file_, request_of(s)); });
  };
  const std::string begin = file_.string() + ": found another study, with ";
  EXPECT_EQ(refusal(study()), "");
  Sweep other = study();
  other.sets = {"joint.lever.damping=0.5 N m s/rad"};
  EXPECT_NE(refusal(other).find(begin + "\"[joint.lever] damping"), std::string::npos)
      << refusal(other);
  EXPECT_NE(refusal(study(5)).find("\"vary = seed: 1, 2, 3, 4\"; expected \"vary = seed: 1, 2, 3, "
                                   "4, 5\", as now requested"),
            std::string::npos)
      << refusal(study(5));
  other = study();
  other.report = parse_figures("duration_s");
  EXPECT_NE(refusal(other).find(begin + "\"report = sequence_duration_s [ms]\""),
            std::string::npos);
  EXPECT_EQ(read_results(file_).rows.size(), 1u) << "nothing was changed";
}

// Comments, path and title of an experiment have no effect; a value of its robot does.
TEST_F(ResultsTest, AStudyIsWhatItsFilesSay) {
  for (const char* part : {"robots", "experiments"})
    fs::copy(root + "/" + part, folder_ / part, fs::copy_options::recursive);
  Sweep moved = study();
  moved.experiment = (folder_ / "experiments/one-joint.toml").string();
  const auto change = [](const fs::path& in, const std::string& from, const std::string& to) {
    std::ifstream read(in);
    std::string text{std::istreambuf_iterator<char>(read), {}};
    ASSERT_NE(text.find(from), text.npos) << in;
    std::ofstream(in) << text.replace(text.find(from), from.size(), to);
  };
  change(moved.experiment, "title", "# a comment\ntitle");
  EXPECT_EQ(difference(request_of(moved).text, request_of(study()).text).first, "");

  Sweep robots = moved;
  robots.axes = {parse_axis("experiment=one-joint.toml,leg-in-air.toml")};
  const std::string before = request_of(robots).text;
  std::ofstream(folder_ / "robots/leg/robot.toml", std::ios::app) << "\n# a comment\n";
  EXPECT_EQ(difference(request_of(robots).text, before).first, "");
  std::ofstream(folder_ / "experiments/leg-in-air.toml", std::ios::app)
      << "\n[plant_steps]\nbody = \"0.5 ms\"\n";
  EXPECT_NE(request_of(robots).text, before);
}

TEST_F(ResultsTest, RefusesWhatIsNoStudy) {
  const auto refusal = [&] {
    return message([&] { const Results results(file_, request_of(study())); });
  };
  const auto make = [&](const std::string& sql) {
    fs::remove(file_);
    sqlite3* db = nullptr;
    sqlite3_open(file_.c_str(), &db);
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(db);
  };
  std::ofstream(file_) << "a,b\n1,2\n";
  EXPECT_NE(refusal().find("is no database"), std::string::npos) << refusal();
  make("CREATE TABLE a (b)");
  EXPECT_NE(refusal().find("a database of another program"), std::string::npos) << refusal();
  fs::remove(file_);
  { Results(file_, request_of(study())).add(some_rows()[0]); }
  sqlite3* db = nullptr;
  sqlite3_open(file_.c_str(), &db);
  sqlite3_exec(db, "PRAGMA user_version = 9", nullptr, nullptr, nullptr);
  EXPECT_NE(refusal().find("format 9; expected format 3; try a newer"), std::string::npos)
      << refusal();
  sqlite3_exec(db, "PRAGMA user_version = 1", nullptr, nullptr, nullptr);
  EXPECT_NE(refusal().find("an older Sinew wrote it"), std::string::npos) << refusal();
  sqlite3_exec(db, "PRAGMA user_version = 3; UPDATE study SET value = 'x' WHERE key = 'cases'",
               nullptr, nullptr, nullptr);
  EXPECT_NE(refusal().find("is damaged: its cases cannot be read"), std::string::npos) << refusal();
  sqlite3_exec(db,
               "UPDATE study SET value = '[]' WHERE key = 'cases';"
               "UPDATE study SET value = 'x' WHERE key = 'hash'",
               nullptr, nullptr, nullptr);
  EXPECT_NE(refusal().find("is damaged"), std::string::npos) << refusal();
  sqlite3_close(db);
}

// A tuning's file with flipped bits.
TEST_F(ResultsTest, AFlippedBitIsRefusedOrChangesNothing) {
  StudyRequest request = request_of(study());
  request.of_candidates = {{"joint.hip.stiffness [count/deg]", true}, {"feasible", false}};
  std::vector<CandidateRow> candidates;
  for (std::size_t i = 0; i < 40; ++i)
    candidates.push_back({.number = i,
                          .generation = i / 8,
                          .feasible = i % 2 == 0,
                          .violation = 0.1 * static_cast<double>(i),
                          .holds = 0.5,
                          .cells = {std::to_string(i), "yes"}});
  {
    Results results(file_, request);
    results.add_all(some_rows());
    results.add_candidates(candidates);
  }
  const StoredStudy right = read_results(file_);
  EXPECT_EQ(right.candidates, candidates);
  std::ifstream in(file_, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::mt19937 random(39);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    std::string spoilt = bytes;
    const std::size_t at = random() % bytes.size();
    spoilt[at] = static_cast<char>(spoilt[at] ^ (1 << random() % 8));
    std::ofstream(file_, std::ios::binary) << spoilt;
    try {
      const StoredStudy held = read_results(file_);
      EXPECT_EQ(held.candidates, right.candidates) << at;
      EXPECT_EQ(held.rows.size(), right.rows.size()) << at;
      for (std::size_t k = 0; k < std::min(held.rows.size(), right.rows.size()); ++k)
        EXPECT_EQ(held.rows[k].cells, right.rows[k].cells) << at;
      EXPECT_EQ(held.request.text, right.request.text) << at;
    } catch (const std::exception&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

TEST_F(ResultsTest, AFileThatIsRemovedWhileItIsWrittenIsReported) {
  const auto rows = some_rows();
  Results results(file_, request_of(study()));
  EXPECT_TRUE(results.add(rows[0]));
  fs::rename(file_, file_.string() + ".away");
  EXPECT_FALSE(results.add(rows[1]));
  const std::string failure = message([&] { results.throw_failure(); });
  EXPECT_NE(failure.find("was removed or replaced while the study was written"), std::string::npos)
      << failure;
}

TEST_F(ResultsTest, OfAnotherVersionOfSinewIsRefused) {
  StudyRequest old = request_of(study());
  old.text.replace(0, old.text.find('\n'), "sinew = 0.0.9");
  { Results(file_, old).add(some_rows()[0]); }
  const std::string refusal = message([&] { const Results results(file_, request_of(study())); });
  EXPECT_NE(refusal.find("a study of Sinew 0.0.9; expected one of this version"), std::string::npos)
      << refusal;
}

TEST_F(ResultsTest, HasOneWriter) {
  Results first(file_, request_of(study()));
  first.add(some_rows()[0]);
  EXPECT_NE(message([&] {
              const Results second(file_, request_of(study()));
            }).find("process " + std::to_string(getpid()) + " is writing it"),
            std::string::npos);
  EXPECT_EQ(read_results(file_).rows.size(), 1u) << "readers are not refused";
}

// Waits for another program's transaction, then reports it; no stored row is lost.
TEST_F(ResultsTest, ReportsAnotherProgramsTransaction) {
  Results results(file_, request_of(study()));
  results.add(some_rows()[0]);
  sqlite3* db = nullptr;
  sqlite3_open(file_.c_str(), &db);
  sqlite3_exec(db, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr);
  EXPECT_FALSE(results.add(some_rows()[1]));
  EXPECT_NE(message([&] { results.throw_failure(); }).find("another program is writing into it"),
            std::string::npos);
  sqlite3_close(db);
  EXPECT_EQ(results.rows().size(), 1u);
}

TEST_F(ResultsTest, ReportsAFolderThatIsMissingOrNotWritable) {
  const StudyRequest request = request_of(study());
  EXPECT_NE(message([&] { const Results r(folder_ / "no/study.db", request); }).find("no folder"),
            std::string::npos);
  EXPECT_NE(message([&] { const Results r("/sys/study.db", request); }).find("cannot be written"),
            std::string::npos);
  EXPECT_NE(message([&] { const Results r(folder_, request); }).find("a folder"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::tune::results_test
