// Every number of every kind of file, replaced by an invalid value: refused with its key and line,
// or accepted, listed with a reason in matrix_accepted.txt, and run without any NaN.
//
//   cells      zero, negative, nan, inf, 1e300, 1e-300, wrong unit, text, missing, twice
//   missing    is accepted of optional keys alone; the others' acceptance must be in the list
//
// A field is tested once: at the first shipped experiment that has it. SINEW_GUARD_COUNT: cells
// that the program itself checks and runs as well.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "sinew/config/write/writer.h"
#include "sinew/run/setup/buildable.h"
#include "tests/cli/program.h"
#include "tests/guards/subjects.h"
#include "tests/places.h"

namespace sinew::guards {
namespace {

using config::Node;

// --- cells ---

const std::vector<std::string> cells = {"zero",   "negative",   "nan",  "inf",     "1e300",
                                        "1e-300", "wrong unit", "text", "missing", "twice"};

bool suspicious(const std::string& cell) {
  return cell == "zero" || cell == "negative" || cell == "1e300" || cell == "1e-300";
}

Node value_of(const NumericField& field, const std::string& cell) {
  const double now = field.values.empty() ? 0 : field.values.front();
  if (cell == "zero") return quantity(field, 0);
  if (cell == "negative")
    return quantity(field, std::isfinite(now) && now != 0 ? -std::abs(now) : -1);
  if (cell == "1e300") return quantity(field, 1e300);
  if (cell == "1e-300") return quantity(field, 1e-300);
  if (cell == "wrong unit")
    return config::make_text("", field.unit.find("ohm") == field.unit.npos ? "3 ohm" : "3 kg");
  if (cell == "text") return config::make_text("", "much");
  const double none = cell == "nan" ? std::nan("") : units::unbounded;
  if (field.unit.empty() || field.unit == "1") return config::make_number("", none);
  return config::make_text("", cell + " " + field.unit);
}

Node with(const Subject& subject, const NumericField& field, const std::string& cell) {
  Node root = subject.root;
  if (cell == "missing") {
    std::string key;
    table_of(root, field.path, key).erase(key);
  } else {
    put(root, field, value_of(field, cell));
  }
  return root;
}

// --- their outcome ---

struct Verdict {
  bool accepted = false;
  std::string words;  // of the error message, or the violation
  bool wrong = false;
};

// An error message names the key or a place.
void judge_refusal(const config::Error& e, const NumericField& field, const std::string& cell,
                   Verdict& out) {
  out.words = e.what();
  for (const config::Problem& p : e.problems()) {
    if (p.key.empty() || p.found.empty() || p.expected.empty()) out.wrong = true;
    if (p.found.find("nan") != std::string::npos && cell != "nan") out.wrong = true;
  }
  // A cell that the reader refuses is reported with its own line.
  const bool own = std::ranges::any_of(e.problems(), [&](const config::Problem& p) {
    return p.where.file == "cell.toml" && p.where.line == 7;
  });
  const bool by_reader = cell == "nan" || cell == "inf" || cell == "wrong unit" || cell == "text";
  if (by_reader && !own) out.wrong = true;
  (void)field;
}

// Accepted: it runs, and every number is finite, except those that are not in the unchanged run.
void judge_run(const Ran& ran, const std::set<std::string>& usual, Verdict& out) {
  if (ran.ended) {
    out.words = "ended: " + ran.cause;
    out.wrong = ran.cause.find(" at ") == std::string::npos;
    return;
  }
  for (const std::string& name : ran.not_finite)
    if (!usual.contains(name)) out.wrong = true, out.words += " " + name + " is not finite";
}

Verdict judge(const Subject& subject, const NumericField& field, const std::string& cell,
              const std::set<std::string>& usual) {
  Verdict out;
  try {
    const Node root = with(subject, field, cell);
    experiment::Experiment e = run::buildable(root, "cell.toml");
    const analysis::Machine machine = analysis::read_machine(root);
    out.accepted = true;
    judge_run(short_run(std::move(e), machine), usual, out);
  } catch (const config::Error& e) {
    if (out.accepted) out.wrong = true;
    judge_refusal(e, field, cell, out);
  } catch (const std::exception& e) {
    out.wrong = true;
    out.words = e.what();
  }
  return out;
}

// A key that occurs twice in its table.
Verdict judge_twice(const NumericField& field) {
  const std::size_t dot = field.path.rfind('.');
  const std::string key = dot == field.path.npos ? field.path : field.path.substr(dot + 1);
  try {
    config::parse_text("[table]\n" + key + " = 1\nother = 2\n" + key + " = 3\n", "cell.toml");
  } catch (const config::Error& e) {
    const config::Problem& p = e.problems().front();
    return {.accepted = false, .words = e.what(), .wrong = p.where.line != 4};
  }
  return {.accepted = true, .words = "twice", .wrong = true};
}

std::set<std::string> usual_of(const Subject& s) {
  const Ran ran = short_run(experiment::load(s.root, s.name), analysis::read_machine(s.root));
  EXPECT_FALSE(ran.ended) << s.name << ": " << ran.cause;
  return {ran.not_finite.begin(), ran.not_finite.end()};
}

// --- the list of accepted cells ---

// "reason: …" and below it lines "robot pattern cell cell …"
std::map<std::string, std::string> listed() {
  std::ifstream in(sinew::test::source_dir() + "/tests/guards/matrix_accepted.txt");
  std::map<std::string, std::string> out;
  std::string line, reason;
  while (std::getline(in, line)) {
    if (line.empty() || line.starts_with("#")) continue;
    if (line.starts_with("reason: ")) {
      reason = line.substr(8);
      continue;
    }
    std::istringstream words(line);
    std::string pattern, cell;
    words >> pattern;
    while (words >> cell) {
      EXPECT_TRUE(suspicious(cell)) << line;
      EXPECT_TRUE(out.emplace(pattern + " " + cell, reason).second) << pattern << " twice";
    }
    EXPECT_FALSE(reason.empty()) << line;
  }
  return out;
}

std::string id_of(const Subject& subject, const NumericField& field) {
  std::string unit = field.unit;
  std::ranges::replace(unit, ' ', '_');
  return std::string(subject.rig ? "rig:" : "run:") + field.pattern +
         (field.pattern.ends_with(".scale") ? "[" + unit + "]" : "");
}

struct Cell {
  Subject const* subject;
  NumericField field;
  std::string cell;
  bool accepted;
};

// --- the program itself ---

void check_by_program(const std::vector<Cell>& all, std::size_t count) {
  const test::Workspace w;
  for (std::size_t i = 0; i < count && i < all.size(); ++i) {
    const Cell& c = all[i * all.size() / std::max<std::size_t>(count, 1) % all.size()];
    const Node root = with(*c.subject, c.field, c.cell);
    test::write_text(w / "cell.toml", config::to_toml(root));
    const std::string told = id_of(*c.subject, c.field) + " " + c.cell;
    const test::Result check = w.sinew({"check", "cell.toml"});
    EXPECT_EQ(check.code, c.accepted ? 0 : 1) << told << check.out << check.err;
    const test::Result run = w.sinew({"run", "cell.toml", "-o", "out", "--force", "--no-report"});
    const bool ended = run.err.find("the run was ended") != run.err.npos;
    EXPECT_EQ(run.code == 0 || ended, c.accepted) << told << run.err;
    if (c.accepted) continue;
    EXPECT_THAT(check.out, ::testing::HasSubstr("cell.toml:")) << told;
    // The same message: check prints it to stdout, run to stderr.
    const std::string first = check.out.substr(0, check.out.find('\n'));
    EXPECT_THAT(run.err, ::testing::HasSubstr(first)) << told;
  }
}

TEST(Matrix, EveryNumberIsRefusedOrRuns) {
  const auto list = listed();
  const bool print = std::getenv("SINEW_MATRIX_PRINT") != nullptr;
  std::set<std::string> seen, accepted;
  std::vector<Cell> all;
  std::vector<std::unique_ptr<Subject>> subjects;

  for (const auto& file : shipped()) {
    subjects.push_back(std::make_unique<Subject>(subject(file)));
    const Subject& s = *subjects.back();
    std::set<std::string> usual;
    bool ran = false;
    for (const NumericField& field : s.fields) {
      const std::string id = id_of(s, field);
      if (!seen.insert(id).second) continue;
      if (!ran) usual = usual_of(s), ran = true;
      for (const std::string& cell : cells) {
        const std::string key = id + " " + cell;
        const Verdict v = cell == "twice" ? judge_twice(field) : judge(s, field, cell, usual);
        EXPECT_FALSE(v.wrong) << s.name << ": " << key << ": " << v.words;
        if (cell != "twice") all.push_back({&s, field, cell, v.accepted});
        if (!v.accepted) {
          EXPECT_FALSE(list.contains(key))
              << s.name << ": " << key << " is listed and refused: " << v.words;
          continue;
        }
        if (cell == "missing") {
          EXPECT_TRUE(field.optional) << s.name << ": " << key;
          continue;
        }
        accepted.insert(key);
        if (print) std::cout << "ACCEPTED " << key << " # " << v.words << "\n";
        EXPECT_TRUE(print || list.contains(key))
            << s.name << ": " << key << " is accepted and not listed";
      }
    }
  }
  for (const auto& [key, reason] : list)
    EXPECT_TRUE(accepted.contains(key)) << key << " is listed and no cell";
  EXPECT_GT(seen.size(), 200u);
  std::cout << seen.size() << " fields, " << all.size() << " cells and as many keys twice, "
            << accepted.size() << " of the suspicious accepted\n";

  const char* count = std::getenv("SINEW_GUARD_COUNT");
  if (!print) check_by_program(all, count ? std::strtoul(count, nullptr, 10) : 12);
}

}  // namespace
}  // namespace sinew::guards
