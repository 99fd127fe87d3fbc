#include "core/model/noise_model.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/model/number_pair.hpp"
#include "core/model/recursion.hpp"

namespace loopscope::core::model {
namespace {

/// At rest at the first value x: y = x (1 - m) / (1 - c).
double level_of(double pole, double zero) {
  return (1.0 - pole) / (1.0 - zero);
}

/// One pair: y(k) = x(k) - m x(k-1) + c y(k-1).
template <typename Number, typename Read, typename Write>
void whiten_pair(double pole, double zero, std::size_t count, Read read, Write write) {
  Number before = read(0);
  const Number state = before * level_of(pole, zero);
  const auto moves = [&](std::size_t k) {
    const Number value = read(k);
    const Number move = value - pole * before;
    before = value;
    return move;
  };
  run_recursion(Number{} + zero, state, count, moves, write);
}

/// The pairs one after the other, the second in place.
template <typename Number, typename Read, typename Again, typename Write>
void whiten_pairs(const NoiseModel& noise, std::size_t count, Read read, Again again, Write write) {
  if (count == 0) return;
  bool first = true;
  for (std::size_t pair = 0; pair < noise.poles.size(); ++pair) {
    const double pole = noise.poles[pair];
    const double zero = noise.zeros[pair];
    if (pole == zero) continue;
    if (first) {
      whiten_pair<Number>(pole, zero, count, read, write);
    } else {
      whiten_pair<Number>(pole, zero, count, again, write);
    }
    first = false;
  }
  for (std::size_t k = 0; first && k < count; ++k) write(k, read(k));
}

}  // namespace

double whitened_level(const NoiseModel& noise) {
  double level = 1.0;
  for (std::size_t pair = 0; pair < noise.poles.size(); ++pair) {
    const bool none = noise.poles[pair] == noise.zeros[pair];
    level *= none ? 1.0 : level_of(noise.poles[pair], noise.zeros[pair]);
  }
  return level;
}

void whiten(const NoiseModel& noise, std::span<const double> v, std::span<double> w) {
  whiten_pairs<double>(
      noise, v.size(), [&](std::size_t k) { return v[k]; }, [&](std::size_t k) { return w[k]; },
      [&](std::size_t k, double value) { w[k] = value; });
}

void whiten(const NoiseModel& noise, std::array<std::span<const double>, 2> v,
            std::array<std::span<double>, 2> w) {
  whiten_pairs<NumberPair>(
      noise, v[0].size(),
      [&](std::size_t k) {
        return NumberPair{v[0][k], v[1][k]};
      },
      [&](std::size_t k) {
        return NumberPair{w[0][k], w[1][k]};
      },
      [&](std::size_t k, NumberPair value) {
        w[0][k] = value[0];
        w[1][k] = value[1];
      });
}

void whiten(const NoiseModel& noise, std::span<double> table, std::size_t width) {
  if (width == 0 || width % 4 != 0 || width > kMaxColumns) {
    throw std::invalid_argument("whiten: width of a table");
  }
  for (std::size_t column = 0; column < width; column += 2) {
    const auto read = [&](std::size_t k) {
      const double* at = &table[k * width + column];
      return NumberPair{at[0], at[1]};
    };
    whiten_pairs<NumberPair>(noise, table.size() / width, read, read,
                             [&](std::size_t k, NumberPair value) {
                               table[k * width + column] = value[0];
                               table[k * width + column + 1] = value[1];
                             });
  }
}

}  // namespace loopscope::core::model
