// sinew_peers - comparison of Sinew with other programs, measured alternately.
//
//   sinew_peers [--passes N] [--rounds N] [--only PART]...
//                                                 prints the table on stderr, the record on stdout
//   sinew_peers --compare OLD NEW                 prints rows that are slower or faster by more
//   than
//                                                 the spread
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "bench/peers/record.h"

namespace {

using namespace sinew::bench;

struct Named {
  const char* name;
  Part rows;
};
constexpr Named parts[] = {{"actuator", actuator_rows}, {"body", body_rows},
                           {"walk", walk_rows},         {"stand", stand_rows},
                           {"threads", thread_rows},    {"cost", cost_rows},
                           {"program", program_rows}};

constexpr const char* usage =
    "usage: sinew_peers [--passes N] [--rounds N] [--only PART]...\n"
    "       sinew_peers --compare OLD NEW\n"
    "parts: actuator body walk stand threads cost program\n"
    "example: sinew_peers --only walk > walk.json\n";

struct Arguments {
  Effort effort{.program = SINEW_PROGRAM};
  int passes = 3;  // passes through the table, minutes apart, since the speed of a computer varies
  std::vector<std::string> only, compared;
  bool wrong = false;
};

bool is_part(const std::string& name) {
  for (const Named& p : parts)
    if (name == p.name) return true;
  return false;
}

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc && !a.wrong; ++i) {
    const std::string word = argv[i];
    const int left = argc - i - 1;
    if (word == "--rounds" && left >= 1) {
      a.effort.rounds = std::atoi(argv[++i]);
      a.wrong = a.effort.rounds < 1;
    } else if (word == "--passes" && left >= 1) {
      a.passes = std::atoi(argv[++i]);
      a.wrong = a.passes < 1;
    } else if (word == "--only" && left >= 1) {
      a.only.emplace_back(argv[++i]);
      a.wrong = !is_part(a.only.back());
    } else if (word == "--compare" && left == 2) {
      a.compared = {argv[i + 1], argv[i + 2]};
      i += 2;
    } else {
      a.wrong = true;
    }
  }
  return a;
}

nlohmann::ordered_json read(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path + ": there is no such file");
  return nlohmann::ordered_json::parse(in);
}

int compare_files(const std::vector<std::string>& files) {
  const std::vector<Change> changes = compare(read(files[0]), read(files[1]));
  std::cout << text(changes);
  for (const Change& c : changes)
    if (c.kind == Change::Kind::slower) return 1;
  return 0;
}

// Returns the rows of all requested parts.
std::vector<Row> pass(const Arguments& arguments) {
  std::vector<Row> rows;
  for (const Named& part : parts) {
    bool wanted = arguments.only.empty();
    for (const std::string& name : arguments.only) wanted = wanted || name == part.name;
    if (!wanted) continue;
    std::cerr << part.name << " …\n";
    for (Row& row : part.rows(arguments.effort)) rows.push_back(std::move(row));
  }
  return rows;
}

int measure(const Arguments& arguments, const std::string& command) {
  std::vector<Row> rows = pass(arguments);
  for (int i = 1; i < arguments.passes; ++i) add(rows, pass(arguments));
  std::cerr << table(rows);
  std::cout << record(rows, command).dump(1) << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  if (arguments.wrong) {
    std::cerr << usage;
    return argc == 2 && std::strcmp(argv[1], "--help") == 0 ? 0 : 2;
  }
  std::string command = "sinew_peers";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  try {
    return arguments.compared.empty() ? measure(arguments, command)
                                      : compare_files(arguments.compared);
  } catch (const std::exception& e) {
    std::cerr << "sinew_peers: " << e.what() << "\n";
    return 1;
  }
}
