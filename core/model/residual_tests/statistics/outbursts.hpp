#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// A moment at which a series leaves its noise.
struct Outburst {
  std::size_t at_sample = 0;  ///< where the sum that stands out begins
  std::size_t samples = 1;    ///< of the sum: 1, 2, 4, 8 or 16
  double mean = 0.0;          ///< over these samples
};

struct Outbursts {
  double p = 1.0;
  std::vector<Outburst> events;  ///< strongest first, at most 5; those that alone have p <= 0.05
};

/// Peaks of moving sums over 1, 2, 4, 8 and 16 samples against the tail that the other peaks show:
/// the excesses of the highest peaks over a threshold are taken as exponential, the tail of
/// exponential and Laplacian noise and heavier than Gaussian noise's, and the largest of them is
/// judged by its share of their sum (tails.hpp). Up to five events are peeled off, the last one
/// first, so that they do not hide each other. `series` has mean 0; 0 is missing.
[[nodiscard]] Outbursts find_outbursts(std::span<const double> series);

}  // namespace loopscope::core::model
