// Warm, the path from a window to its indices and peaks takes no memory. Counted by replacing the
// global operators of this program by ones that count in their own thread; sanitizers bring their
// own, and their builds leave the test out.

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <new>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/bicoherence/indices.hpp"
#include "core/hos/bicoherence/peaks.hpp"
#include "tests/core/hos/runnable_kernels.hpp"
#include "tests/core/hos/signals.hpp"

namespace {

thread_local std::size_t allocations = 0;

void* counted(void* memory) {
  ++allocations;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(std::malloc(size == 0 ? 1 : size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}

namespace loopscope::core::hos {
namespace {

TEST(HosAllocations, AWarmKernelTakesNoMemory) {
  const Settings settings;
  auto gaps = tests::exponential_noise(1);
  gaps[1000] = std::numeric_limits<double>::quiet_NaN();
  for (const Kernels* kernels : tests::runnable_kernels()) {
    Bicoherence bicoherence(settings, *kernels);
    PeakFinder peaks(settings);
    const auto run = [&](const std::vector<double>& signal) {
      const auto bic2 = bicoherence.estimate(signal);
      (void)indices(bic2, bicoherence.segments(), settings.alpha);
      return peaks.find(bic2, bicoherence.segments()).size();
    };
    const auto coupled = tests::triple(2, 0.1, 0.2, true);
    EXPECT_GT(run(coupled), 0U);
    const std::size_t before = allocations;
    run(gaps);
    run(coupled);
    EXPECT_EQ(allocations, before) << kernels->name;
  }
}

}  // namespace
}  // namespace loopscope::core::hos

#endif
