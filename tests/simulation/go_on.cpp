// go_on EXPERIMENT SAVE...   continues from each save to the end, and prints a hash.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>

#include "tests/simulation/seen.h"

int main(int count, char** words) try {
  using namespace sinew;
  const experiment::Experiment e = experiment::load(words[1]);
  for (int i = 2; i < count; ++i) {
    std::ifstream file(words[i], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    run::Simulation s(e);
    s.restore(std::as_bytes(std::span(bytes)));
    std::printf("%016llx\n", static_cast<unsigned long long>(test::seen_to_the_end(s)));
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
