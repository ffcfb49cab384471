// The hashes of hashes.txt are those of the processor, and a card can hold these runs.
#include <gtest/gtest.h>

#include "sinew/analysis/state_hash.h"
#include "sinew/run/simulation/run.h"
#include "tests/graphics_card/walks.h"

namespace sinew::hashes_test {
namespace {

TEST(CardHashes, AreThoseOfTheProcessor) {
  for (const test::HashedRun& r : test::hashed_runs()) {
    EXPECT_TRUE(run::fits_batch(r.experiment)) << r.name;
    EXPECT_EQ(analysis::state_hash(run::run(r.experiment).table), r.hash) << r.name;
  }
}

}  // namespace
}  // namespace sinew::hashes_test
