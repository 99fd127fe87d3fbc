#include "core/model/noise_model.hpp"

#include <stdexcept>

namespace loopscope::core::model {
namespace {

/// One pair: y(k) = x(k) - m x(k-1) + c y(k-1).
template <std::size_t Width>
void whiten_pair(double pole, double zero, std::span<double> table) {
  std::array<double, Width> before{};
  std::array<double, Width> state{};
  // At rest at the first value x: y = x (1 - m) / (1 - c).
  const double rest = (1.0 - pole) / (1.0 - zero);
  for (std::size_t c = 0; c < Width; ++c) {
    before[c] = table[c];
    state[c] = table[c] * rest;
  }
  for (std::size_t row = 0; row < table.size(); row += Width) {
    for (std::size_t c = 0; c < Width; ++c) {
      const double value = table[row + c];
      state[c] = value - pole * before[c] + zero * state[c];
      before[c] = value;
      table[row + c] = state[c];
    }
  }
}

template <std::size_t Width>
void whiten_width(const NoiseModel& noise, std::span<double> table) {
  for (std::size_t pair = 0; pair < noise.poles.size(); ++pair) {
    if (noise.poles[pair] == noise.zeros[pair]) continue;
    whiten_pair<Width>(noise.poles[pair], noise.zeros[pair], table);
  }
}

}  // namespace

void whiten(const NoiseModel& noise, std::span<double> table, std::size_t width) {
  switch (width) {
    case 4: return whiten_width<4>(noise, table);
    case 8: return whiten_width<8>(noise, table);
    case 12: return whiten_width<12>(noise, table);
    case 16: return whiten_width<16>(noise, table);
    case 20: return whiten_width<20>(noise, table);
    case 24: return whiten_width<24>(noise, table);
    default: throw std::invalid_argument("whiten: width of a table");
  }
}

}  // namespace loopscope::core::model
