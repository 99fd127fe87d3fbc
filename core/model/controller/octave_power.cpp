#include "core/model/controller/octave_power.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace loopscope::core::model {
namespace {

/// Pairs of blocks that an octave has to hold.
constexpr std::size_t kLeastPairs = 8;

/// Half the mean square of the difference of neighbours; 0 without enough of them.
double power_of_pairs(const std::vector<double>& blocks) {
  double sum = 0.0;
  std::size_t pairs = 0;
  for (std::size_t k = 0; k + 1 < blocks.size(); k += 2) {
    const double difference = blocks[k + 1] - blocks[k];
    if (!std::isfinite(difference)) continue;
    sum += 0.5 * difference * difference;
    ++pairs;
  }
  return pairs >= kLeastPairs ? sum / static_cast<double>(pairs) : 0.0;
}

}  // namespace

std::vector<double> halved(const std::vector<double>& blocks) {
  std::vector<double> result(blocks.size() / 2);
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = 0.5 * (blocks[2 * k] + blocks[2 * k + 1]);
  return result;
}

std::vector<OctavePower> octave_powers(std::span<const double> signal) {
  std::vector<double> blocks(signal.begin(), signal.end());
  std::vector<OctavePower> octaves;
  double total = 0.0;
  for (double high = std::numbers::pi; blocks.size() >= 2 * kLeastPairs; high *= 0.5) {
    octaves.push_back({0.5 * high, high, power_of_pairs(blocks), 0.0});
    total += octaves.back().power;
    blocks = halved(blocks);
  }
  if (!(total > 0.0)) return {};
  for (OctavePower& octave : octaves) octave.share = octave.power / total;
  return octaves;
}

}  // namespace loopscope::core::model
