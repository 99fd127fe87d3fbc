// Time of the higher-order statistics of one window: 4096 samples, the paper's settings.

#include <benchmark/benchmark.h>
#include <random>
#include <vector>

#include "core/hos/analyse.hpp"
#include "core/hos/bicoherence.hpp"
#include "core/hos/bispectrum_indirect.hpp"

namespace loopscope::core::hos {
namespace {

std::vector<double> window() {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  std::vector<double> samples(4096);
  for (double& sample : samples) {
    sample = normal(generator);
  }
  return samples;
}

void analyse_window(benchmark::State& state) {
  const auto signal = window();
  for (auto _ : state) {
    benchmark::DoNotOptimize(analyse(signal, Settings{}));
  }
}

void squared_bicoherence(benchmark::State& state) {
  const auto signal = window();
  Bicoherence bicoherence{Settings{}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(bicoherence.estimate(signal));
  }
}

void segment_spectra(benchmark::State& state) {
  const auto signal = window();
  Spectra spectra{Settings{}};
  for (auto _ : state) {
    spectra.compute(signal);
    benchmark::ClobberMemory();
  }
}

void triple_sums(benchmark::State& state, const TileKernel& kernel) {
  const auto signal = window();
  Spectra spectra{Settings{}};
  spectra.compute(signal);
  TripleSums sums;
  for (auto _ : state) {
    sum_triples(spectra, sums, kernel);
    benchmark::ClobberMemory();
  }
}

void indirect_bispectrum(benchmark::State& state) {
  const auto signal = window();
  for (auto _ : state) {
    benchmark::DoNotOptimize(bispectrum_indirect(signal, Settings{}));
  }
}

BENCHMARK(analyse_window)->Unit(benchmark::kMicrosecond);
BENCHMARK(squared_bicoherence)->Unit(benchmark::kMicrosecond);
BENCHMARK(segment_spectra)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(triple_sums, best, best_tile_kernel())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(triple_sums, portable, kPortableTile)->Unit(benchmark::kMicrosecond);
BENCHMARK(indirect_bispectrum)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace loopscope::core::hos
