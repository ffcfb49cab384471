#include "sinew/world/packs/batch.h"

#include "sinew/world/packs/chain_batch_members.h"

namespace sinew::plant {

namespace {

// The widest of at most so many lanes.
const BatchCalls& calls(int most) {
#ifdef SINEW_WIDE
  if (most >= 8 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
    return batch_calls<8>();
  if (most >= 4 && __builtin_cpu_supports("avx2")) return batch_calls<4>();
#endif
  (void)most;
  return batch_calls<2>();
}

}  // namespace

int Batch::widest() { return calls(8).width; }

bool Batch::holds(const Setup& setup) { return ChainBatch<2, 2>::holds(setup); }
bool Batch::alike(const Setup& a, const Setup& b) { return ChainBatch<2, 2>::alike(a, b); }

Batch::Batch(int most, const Setup& like) : calls_(&calls(most)), batch_(calls_->make(like)) {}

}  // namespace sinew::plant
