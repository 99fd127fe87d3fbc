#include "core/hos/kernels/kernels.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <thread>

#include "core/hos/analyse.hpp"
#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/simulate/calibration_families.hpp"
#include "tests/core/hos/runnable_kernels.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kNaN;

struct NamedSignal {
  std::string name;
  std::vector<double> signal;
};

std::vector<NamedSignal> kernel_inputs() {
  std::vector<NamedSignal> all = {{"white", tests::white_noise(1)},
                                  {"red", tests::first_order_noise(2, 0.99)},
                                  {"exponential", tests::exponential_noise(3)},
                                  {"coupled", tests::triple(4, 0.1, 0.2, true)},
                                  {"two segments", tests::white_noise(5, 96)},
                                  {"odd K", tests::white_noise(6, 64 + 32 * 12 + 5)},
                                  {"huge", tests::affine(tests::white_noise(7), 1e300, 0.0)},
                                  {"small", tests::affine(tests::white_noise(8), 1e-300, 0.0)},
                                  {"offset", tests::affine(tests::white_noise(9), 1.0, 1e6)}};
  NamedSignal gaps{"gaps", tests::white_noise(10)};
  for (std::size_t n = 50; n < gaps.signal.size(); n += 333) gaps.signal[n] = kNaN;
  all.push_back(gaps);
  return all;
}

TEST(HosKernels, TheBestRunsLast) {
  ASSERT_FALSE(tests::runnable_kernels().empty());
  EXPECT_FALSE(tests::runnable_kernels().front()->name.empty());
  EXPECT_EQ(&best_kernels(), tests::runnable_kernels().back());
}

TEST(HosKernels, AllGiveTheSameBicoherence) {
  for (const Settings& settings :
       {Settings{}, Settings{.segment_length = 32, .overlap = 0.75, .dft_length = 64},
        Settings{.segment_length = 48, .dft_length = 96}}) {
    for (const NamedSignal& one : kernel_inputs()) {
      Bicoherence reference(settings, *tests::runnable_kernels().front());
      const auto expected = reference.estimate(one.signal);
      for (const Kernels* kernels : tests::runnable_kernels()) {
        Bicoherence bicoherence(settings, *kernels);
        const auto found = bicoherence.estimate(one.signal);
        ASSERT_EQ(found.size(), expected.size()) << one.name;
        for (std::size_t i = 0; i < found.size(); ++i) {
          // The offset leaves six digits less of every sample.
          const double tolerance = one.name == "offset" ? 1e-9 : 1e-12;
          ASSERT_NEAR(found[i], expected[i], tolerance) << one.name << ' ' << kernels->name;
        }
      }
    }
  }
}

TEST(HosKernels, NoneFindsAnythingInAConstant) {
  for (const Kernels* kernels : tests::runnable_kernels()) {
    Bicoherence bicoherence(Settings{}, *kernels);
    for (const double level : {0.0, 0.1, -1e300, 1e-300}) {
      EXPECT_TRUE(bicoherence.estimate(std::vector<double>(4096, level)).empty());
    }
  }
}

TEST(HosKernels, AllGiveTheSameAnalysis) {
  for (const auto& family : simulate::calibration_families()) {
    const auto signal = family.draw(family.samples, 3);
    const auto expected = analyse(signal, Settings{}, 5, *tests::runnable_kernels().front());
    ASSERT_TRUE(expected) << family.name;
    for (const Kernels* kernels : tests::runnable_kernels()) {
      const auto found = analyse(signal, Settings{}, 5, *kernels);
      ASSERT_TRUE(found) << family.name;
      EXPECT_NEAR(found->ngi, expected->ngi, 1e-12) << family.name;
      EXPECT_NEAR(found->nli, expected->nli, 1e-12) << family.name;
      EXPECT_NEAR(*found->ngi_p, *expected->ngi_p, 1e-9 * *expected->ngi_p) << family.name;
      EXPECT_NEAR(*found->nonlinear_p, *expected->nonlinear_p, 1e-9 * *expected->nonlinear_p)
          << family.name;
      EXPECT_EQ(found->coupling, expected->coupling) << family.name;
      EXPECT_EQ(found->peaks.size(), expected->peaks.size()) << family.name;
    }
  }
}

TEST(HosKernels, RepeatEveryDigitWhateverWasComputedBeforeAndInAnyThread) {
  const auto signal = tests::white_noise(11, 3000);
  const auto other = tests::exponential_noise(12, 4096);
  for (const Kernels* kernels : tests::runnable_kernels()) {
    Bicoherence fresh(Settings{}, *kernels);
    const auto expected = fresh.estimate(signal);
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        Bicoherence used(Settings{}, *kernels);
        (void)used.estimate(other);
        const auto found = used.estimate(signal);
        EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
      });
    }
  }
}

}  // namespace
}  // namespace loopscope::core::hos
