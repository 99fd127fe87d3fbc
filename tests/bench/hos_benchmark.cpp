// Time of the higher-order statistics of one window of 4096 samples with the paper's settings, on
// every path of this processor:
//   hos_benchmark --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
//                 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>
#include <random>
#include <string>
#include <vector>

#include "core/hos/analyse.hpp"
#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/bicoherence/indices.hpp"
#include "core/hos/bicoherence/peaks.hpp"
#include "core/hos/linear/linear_model.hpp"
#include "core/hos/literature/bispectrum_indirect.hpp"
#include "core/hos/slow/period.hpp"
#include "core/hos/transforms/segments.hpp"
#include "core/simulate/calibration_families.hpp"
#include "tests/bench/multiply_add_floor.hpp"
#include "tests/core/hos/runnable_kernels.hpp"

namespace loopscope::core::hos {
namespace {

std::vector<double> window() {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  std::vector<double> samples(4096);
  for (double& sample : samples) sample = normal(generator);
  return samples;
}

/// The kernel J: a window to its squared bicoherence, indices and peaks.
void kernel(benchmark::State& state, const Kernels& kernels) {
  const auto signal = window();
  const Settings settings;
  Bicoherence bicoherence(settings, kernels);
  PeakFinder peaks(settings);
  for (auto _ : state) {
    const auto bic2 = bicoherence.estimate(signal);
    benchmark::DoNotOptimize(indices(bic2, bicoherence.segments(), settings.alpha, kernels));
    benchmark::DoNotOptimize(peaks.find(bic2, bicoherence.segments()));
  }
}

void find_segments_of_window(benchmark::State& state, const Kernels& kernels) {
  const auto signal = window();
  std::vector<std::size_t> positions;
  for (auto _ : state) {
    find_segments(signal, kernels.scan(signal).complete, Settings{}, positions);
    benchmark::DoNotOptimize(positions.data());
  }
}

void segment_spectra(benchmark::State& state, const Kernels& kernels) {
  const auto signal = window();
  Spectra spectra(Settings{}, kernels);
  for (auto _ : state) {
    spectra.compute(signal);
    benchmark::ClobberMemory();
  }
}

void triple_sums(benchmark::State& state, const Kernels& kernels) {
  const auto signal = window();
  Spectra spectra(Settings{}, kernels);
  spectra.compute(signal);
  TripleSums sums;
  for (auto _ : state) {
    sum_triples(spectra, sums);
    benchmark::ClobberMemory();
  }
}

void indices_and_peaks(benchmark::State& state, const Kernels& kernels) {
  const auto signal = window();
  const Settings settings;
  Bicoherence bicoherence(settings, kernels);
  PeakFinder peaks(settings);
  const auto bic2 = bicoherence.estimate(signal);
  for (auto _ : state) {
    benchmark::DoNotOptimize(indices(bic2, bicoherence.segments(), settings.alpha, kernels));
    benchmark::DoNotOptimize(peaks.find(bic2, bicoherence.segments()));
  }
}

/// Twenty records of each family of a kind.
std::vector<std::vector<double>> records_of(simulate::FamilyKind kind) {
  constexpr std::uint64_t kPerFamily = 20;
  std::vector<std::vector<double>> all;
  for (std::uint64_t seed = 1; seed <= kPerFamily; ++seed) {
    for (const auto& family : simulate::calibration_families()) {
      if (family.kind == kind) all.push_back(family.draw(family.samples, seed));
    }
  }
  return all;
}

/// Records of healthy loops: the linear Gaussian families of the calibration.
const std::vector<std::vector<double>>& healthy_records() {
  static const auto records = records_of(simulate::FamilyKind::linear_gaussian);
  return records;
}

const std::vector<std::vector<double>>& plant_noise_records() {
  static const auto records = records_of(simulate::FamilyKind::linear_non_gaussian);
  return records;
}

/// Everything in a Result, second passes and all, averaged over records in turn.
void calibrated(benchmark::State& state, const Kernels& kernels) {
  const auto& records = healthy_records();
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(analyse(records[next], Settings{}, 1, kernels));
    next = next + 1 < records.size() ? next + 1 : 0;
  }
}

/// The same of records of linear loops in noise as plants have it.
void plant_noise(benchmark::State& state, const Kernels& kernels) {
  const auto& records = plant_noise_records();
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(analyse(records[next], Settings{}, next, kernels));
    next = next + 1 < records.size() ? next + 1 : 0;
  }
}

void indirect_bispectrum(benchmark::State& state) {
  const auto signal = window();
  for (auto _ : state) {
    benchmark::DoNotOptimize(bispectrum_indirect(signal, Settings{}));
  }
}

using Job = void (*)(benchmark::State&, const Kernels&);

benchmark::internal::Benchmark* add(const char* stage, Job job, const Kernels& kernels) {
  const std::string name = std::string(stage) + '/' + std::string(kernels.name);
  return benchmark::RegisterBenchmark(name.c_str(), job, kernels)->Unit(benchmark::kMicrosecond);
}

const bool kRegistered = [] {
  // Three times round, so that every record has the same weight.
  const auto turns = static_cast<benchmark::IterationCount>(3 * healthy_records().size());
  for (const Kernels* kernels : tests::runnable_kernels()) {
    add("kernel", kernel, *kernels);
    benchmark::RegisterBenchmark(("floor/" + std::string(kernels->name)).c_str(),
                                 bench::multiply_add_floor, bench::peak_loop(kernels->name))
        ->Unit(benchmark::kMicrosecond);
    add("segments", find_segments_of_window, *kernels);
    add("spectra", segment_spectra, *kernels);
    add("triples", triple_sums, *kernels);
    add("indices", indices_and_peaks, *kernels);
    add("calibrated", calibrated, *kernels)->Iterations(turns);
    add("plant_noise", plant_noise, *kernels)
        ->Iterations(static_cast<benchmark::IterationCount>(plant_noise_records().size()));
  }
  return true;
}();

BENCHMARK(indirect_bispectrum)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace loopscope::core::hos
