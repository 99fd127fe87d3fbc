#pragma once

#include <span>
#include <vector>

#include "core/model/vectors/eight_numbers.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model::tests {

/// White noise in each place, another one in each.
inline std::vector<EightNumbers> eight_noises(std::size_t samples) {
  std::vector<EightNumbers> eight(samples);
  for (std::size_t place = 0; place < kSideBySide; ++place) {
    const Series noise = white_noise(samples, place + 1);
    for (std::size_t k = 0; k < samples; ++k) eight[k][place] = noise[k];
  }
  return eight;
}

inline void append(std::span<const double> numbers, std::vector<double>& to) {
  to.insert(to.end(), numbers.begin(), numbers.end());
}

}  // namespace loopscope::core::model::tests
