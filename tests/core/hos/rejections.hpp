#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos::tests {

/// A signal per seed.
using Draw = std::function<std::vector<double>(std::uint64_t seed)>;

/// loopscope::tests::records() as a divisor of shares.
[[nodiscard]] int records(int full);

/// Shares of records that Hinich's and Fackrell's tests reject at a level.
struct Rejections {
  double gaussianity = 0.0;
  double linearity = 0.0;
  double fackrell_count = 0.0;
  double fackrell_some = 0.0;
};
[[nodiscard]] Rejections rejections(const Draw& draw, const Settings& settings, double level,
                                    int records);

}  // namespace loopscope::core::hos::tests
