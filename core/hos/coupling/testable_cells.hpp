#pragma once

#include <algorithm>
#include <cstddef>

#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// The bifrequencies at which the null does not depend on the signal's spectrum.
///
/// Left out are cells whose frequencies share a main lobe (half width b bins): k2 < b, where X(k1)
/// and X(k1 + k2) are one and what leaks from the mean, from drift and from slow oscillations sits;
/// k1 <= 2 b, where one line can fill all three; and k1 + k2 > M / 2 - b, where the spectrum
/// overlaps its mirror image. Slow coupling is looked for with longer segments instead.
class TestableCells {
 public:
  explicit TestableCells(const Settings& settings);

  [[nodiscard]] bool contains(Bifrequency at) const {
    return at.k2 >= lobe_ && at.k1 > 2 * lobe_ && at.k1 + at.k2 + lobe_ <= half_;
  }
  /// The k1 that go with a k2: `begin` to `end` - 1; none when end <= begin.
  struct Range {
    std::size_t begin;
    std::size_t end;
  };
  [[nodiscard]] Range row(std::size_t k2) const {
    if (k2 < lobe_ || k2 + lobe_ > half_) return {0, 0};
    return {std::max(k2, 2 * lobe_ + 1), half_ - lobe_ - k2 + 1};
  }
  /// How many there are; 0 when segments are so short that none is left.
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::size_t lobe_;
  std::size_t half_;
  std::size_t count_ = 0;
};

}  // namespace loopscope::core::hos
