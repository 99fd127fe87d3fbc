#include "core/simulate/missing_samples.hpp"

#include <algorithm>
#include <limits>

#include "core/simulate/random.hpp"

namespace loopscope::core::simulate {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// A place among `count`.
std::size_t draw_place(UniformSource& source, std::size_t count) {
  return static_cast<std::size_t>(source.next() * static_cast<double>(count));
}

}  // namespace

std::vector<double> with_gaps(std::vector<double> signal, double share, std::size_t blocks,
                              std::uint64_t seed) {
  const std::size_t longest = signal.size() / blocks;
  const auto length = static_cast<std::size_t>(share * static_cast<double>(longest));
  // Places in what is left of the record when the blocks are cut out of it.
  UniformSource source(seed);
  std::vector<std::size_t> places(blocks);
  for (std::size_t& place : places) {
    place = draw_place(source, signal.size() - blocks * length + 1);
  }
  std::ranges::sort(places);
  for (std::size_t block = 0; block < blocks; ++block) {
    std::fill_n(signal.data() + places[block] + block * length, length, kMissing);
  }
  return signal;
}

std::vector<double> with_masked_spikes(std::vector<double> signal, std::size_t count,
                                       std::uint64_t seed) {
  UniformSource source(seed);
  for (std::size_t spike = 0; spike < count; ++spike) {
    signal[draw_place(source, signal.size())] = kMissing;
  }
  return signal;
}

}  // namespace loopscope::core::simulate
