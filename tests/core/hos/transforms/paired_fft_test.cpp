#include "core/hos/transforms/paired_fft.hpp"

#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <thread>
#include <vector>

#include "core/hos/kernels/aligned.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

/// Output of a batch whose sequences stand one after another in `samples`.
AlignedVector transform(std::size_t length, const std::vector<double>& samples) {
  const PairedFft& fft = PairedFft::of_length(length);
  AlignedVector input(fft.buffer_size());
  AlignedVector output(fft.buffer_size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    input[fft.input_begin(i / length) + i % length * PairedFft::kStride] = samples[i];
  }
  fft.execute(input, output);
  return output;
}

std::complex<double> naive_dft(std::span<const double> x, std::size_t k) {
  std::complex<double> sum;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double turn = static_cast<double>(k * n) / static_cast<double>(x.size());
    sum += x[n] * std::polar(1.0, -2.0 * std::numbers::pi * turn);
  }
  return sum;
}

TEST(HosPairedFft, AgreesWithTheDefinition) {
  for (const std::size_t length : {16U, 66U, 128U}) {
    const auto samples = tests::white_noise(1, PairedFft::kBatch * length);
    const AlignedVector output = transform(length, samples);
    const auto sequence = [&](std::size_t i) {
      return std::span(samples).subspan(i * length, length);
    };
    for (std::size_t pair = 0; pair < PairedFft::kBatch / 2; ++pair) {
      for (std::size_t k = 0; k <= length / 2; ++k) {
        const auto [first, second] = PairedFft::of_length(length).separate(output, pair, k);
        EXPECT_LT(std::abs(first - naive_dft(sequence(2 * pair), k)), 1e-11);
        EXPECT_LT(std::abs(second - naive_dft(sequence(2 * pair + 1), k)), 1e-11);
      }
    }
  }
}

TEST(HosPairedFft, OnePlanPerLength) {
  EXPECT_EQ(&PairedFft::of_length(64), &PairedFft::of_length(64));
  EXPECT_NE(&PairedFft::of_length(64), &PairedFft::of_length(66));
}

TEST(HosPairedFft, ManyThreadsMayPlanAndExecuteAtOnce) {
  const std::size_t lengths[] = {20, 22, 24, 26};
  std::vector<std::vector<double>> samples;
  for (const std::size_t length : lengths) {
    samples.push_back(tests::white_noise(length, PairedFft::kBatch * length));
  }
  std::vector<AlignedVector> together(16);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < together.size(); ++i) {
      threads.emplace_back([&, i] { together[i] = transform(lengths[i % 4], samples[i % 4]); });
    }
  }
  for (std::size_t i = 0; i < together.size(); ++i) {
    EXPECT_EQ(together[i], transform(lengths[i % 4], samples[i % 4]));
  }
}

}  // namespace
}  // namespace loopscope::core::hos
