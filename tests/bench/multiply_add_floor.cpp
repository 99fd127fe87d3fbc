#include "tests/bench/multiply_add_floor.hpp"

#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace loopscope::core::hos::bench {
namespace {

constexpr std::size_t kChains = PeakLoop::kChains;

/// Values stay near 0.5 for any number of rounds.
constexpr double kFactor = 0.998;
constexpr double kTerm = 0.001;

// An empty statement that may change the chains: without it they would be computed ahead.
#define LOOPSCOPE_KEEP(chains)                                                       \
  asm volatile(""                                                                    \
               : "+x"(chains[0]), "+x"(chains[1]), "+x"(chains[2]), "+x"(chains[3]), \
                 "+x"(chains[4]), "+x"(chains[5]), "+x"(chains[6]), "+x"(chains[7]), \
                 "+x"(chains[8]), "+x"(chains[9]), "+x"(chains[10]), "+x"(chains[11]))

#if defined(__x86_64__)

__attribute__((target("avx512f"))) void run_avx512(std::size_t rounds) {
  __m512d chains[kChains] = {};
  const __m512d factor = _mm512_set1_pd(kFactor);
  const __m512d term = _mm512_set1_pd(kTerm);
  for (std::size_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (__m512d& chain : chains) chain = _mm512_fmadd_pd(chain, factor, term);
    LOOPSCOPE_KEEP(chains);
  }
}

__attribute__((target("avx2,fma"))) void run_avx2(std::size_t rounds) {
  __m256d chains[kChains] = {};
  const __m256d factor = _mm256_set1_pd(kFactor);
  const __m256d term = _mm256_set1_pd(kTerm);
  for (std::size_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (__m256d& chain : chains) chain = _mm256_fmadd_pd(chain, factor, term);
    LOOPSCOPE_KEEP(chains);
  }
}

#endif

// A multiplication and an addition, which round apart.
void run_portable(std::size_t rounds) {
  using Vector [[gnu::vector_size(16)]] = double;
  Vector chains[kChains] = {};
  const Vector factor = {kFactor, kFactor};
  const Vector term = {kTerm, kTerm};
  for (std::size_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (Vector& chain : chains) chain = chain * factor + term;
#if defined(__x86_64__)
    LOOPSCOPE_KEEP(chains);
#else
    for (Vector& chain : chains) benchmark::DoNotOptimize(chain);
#endif
  }
}

}  // namespace

PeakLoop peak_loop(std::string_view path) {
#if defined(__x86_64__)
  if (path == "avx512") return {8, run_avx512};
  if (path == "avx2") return {4, run_avx2};
#endif
  return {2, run_portable};
}

void multiply_add_floor(benchmark::State& state, const PeakLoop& loop) {
  const double vectors = kMultiplyAdds / static_cast<double>(loop.lanes);
  const auto rounds = static_cast<std::size_t>(std::ceil(vectors / static_cast<double>(kChains)));
  for (auto _ : state) {
    loop.run(rounds);
    benchmark::ClobberMemory();
  }
}

}  // namespace loopscope::core::hos::bench
