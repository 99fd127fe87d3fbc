#include "core/hos/kernels/segment_dft.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "core/hos/kernels/plan_cache.hpp"

namespace loopscope::core::hos {
namespace {

using Turn = SegmentDft::Turn;
using Level = SegmentDft::Level;

Turn turn(std::size_t step, std::size_t length) {
  const double angle =
      2.0 * std::numbers::pi * static_cast<double>(step) / static_cast<double>(length);
  return {std::cos(angle), std::sin(angle)};
}

std::vector<Turn> radix_4_turns(std::size_t block) {
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < block / 4; ++i) {
    for (std::size_t q = 1; q <= 3; ++q) turns.push_back(turn(q * i, block));
  }
  return turns;
}

/// Frequency that the last step finds first in block number `block` of `blocks`: its digits to the
/// base 4, the last one first.
std::size_t reversed_digits(std::size_t block, std::size_t blocks) {
  std::size_t reversed = 0;
  for (; blocks > 1; blocks /= 4, block /= 4) reversed = 4 * reversed + block % 4;
  return reversed;
}

Level make_level(std::size_t real_length, std::size_t dft_length) {
  Level level;
  level.length = real_length / 4;
  for (std::size_t i = 0; i < level.length; ++i) level.input_turns.push_back(turn(i, real_length));
  std::size_t block = level.length;
  for (; block > 8; block /= 4) level.steps.push_back(radix_4_turns(block));
  level.last_radix = block;
  const std::size_t blocks = level.length / block;
  for (std::size_t b = 0; b < blocks; ++b) {
    for (std::size_t t = 0; t < block; ++t) {
      const std::size_t j = reversed_digits(b, blocks) + blocks * t;
      const std::size_t k = (4 * j + 1) * (dft_length / real_length);
      const bool mirrored = k > dft_length / 2;
      level.places.push_back({mirrored ? dft_length - k : k, mirrored ? -1.0 : 1.0});
    }
  }
  return level;
}

}  // namespace

bool SegmentDft::made_for(std::size_t segment_length, std::size_t dft_length) {
  return dft_length == 2 * segment_length && std::has_single_bit(dft_length) && dft_length >= 64;
}

const SegmentDft& SegmentDft::of_length(std::size_t dft_length) {
  return cached_plan<SegmentDft>(dft_length);
}

SegmentDft::SegmentDft(std::size_t dft_length) : dft_length_(dft_length) {
  for (std::size_t n = dft_length; n >= 4; n /= 2) levels_.push_back(make_level(n, dft_length));
}

}  // namespace loopscope::core::hos
