#include "core/model/products.hpp"

#include <array>

#include "core/model/number_pair.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;

/// Rows are taken by pairs, two pairs side by side: sums are added in the same order on every
/// processor, and longer vectors end up in memory where it has no registers for them.
constexpr std::size_t kPairs = 2;
constexpr std::size_t kRowsAtOnce = 2 * kPairs;

/// Tiles of two by two signals: each loaded row serves two sums, and the sums still fit into the
/// registers of every processor.
constexpr std::size_t kTile = 2;

template <std::size_t height, std::size_t width>
using Tile = std::array<std::array<double, width>, height>;

inline NumberPair load(Signal signal, std::size_t k) {
  return NumberPair{signal[k], signal[k + 1]};
}

template <std::size_t height, std::size_t width>
using PairTile = std::array<std::array<NumberPair, width>, height>;

/// Inlined always: as a call of its own every sum would go through memory.
template <std::size_t height, std::size_t width>
[[gnu::always_inline]] inline void add_pair(const Signal* left, const Signal* right, std::size_t k,
                                            PairTile<height, width>& sums) {
  std::array<NumberPair, width> b;
  for (std::size_t j = 0; j < width; ++j) b[j] = load(right[j], k);
  for (std::size_t i = 0; i < height; ++i) {
    const NumberPair a = load(left[i], k);
    for (std::size_t j = 0; j < width; ++j) sums[i][j] += a * b[j];
  }
}

template <std::size_t height, std::size_t width>
void add_row(const Signal* left, const Signal* right, std::size_t k, Tile<height, width>& sums) {
  for (std::size_t i = 0; i < height; ++i) {
    for (std::size_t j = 0; j < width; ++j) sums[i][j] += left[i][k] * right[j][k];
  }
}

template <std::size_t height, std::size_t width>
Tile<height, width> tile(const Signal* left, const Signal* right, std::span<const Range> rows) {
  std::array<PairTile<height, width>, kPairs> sums{};
  Tile<height, width> result{};
  for (const Range& range : rows) {
    std::size_t k = range.first;
    for (; k + kRowsAtOnce <= range.end; k += kRowsAtOnce) {
      add_pair<height, width>(left, right, k, sums[0]);
      add_pair<height, width>(left, right, k + 2, sums[1]);
    }
    for (; k < range.end; ++k) add_row<height, width>(left, right, k, result);
  }
  for (std::size_t i = 0; i < height; ++i) {
    for (std::size_t j = 0; j < width; ++j) {
      const NumberPair& first = sums[0][i][j];
      const NumberPair& second = sums[1][i][j];
      result[i][j] += (first[0] + first[1]) + (second[0] + second[1]);
    }
  }
  return result;
}

template <std::size_t height, std::size_t width>
void put_tile(std::span<const Signal> left, std::span<const Signal> right, std::size_t i,
              std::size_t j, std::span<const Range> rows, Eigen::MatrixXd& all) {
  const Tile<height, width> sums = tile<height, width>(&left[i], &right[j], rows);
  for (std::size_t a = 0; a < height; ++a) {
    for (std::size_t b = 0; b < width; ++b) {
      all(static_cast<Index>(i + a), static_cast<Index>(j + b)) = sums[a][b];
    }
  }
}

void put_tile_at(std::span<const Signal> left, std::span<const Signal> right, std::size_t i,
                 std::size_t j, std::span<const Range> rows, Eigen::MatrixXd& all) {
  const bool high = i + 1 < left.size();
  const bool wide = j + 1 < right.size();
  if (high && wide) return put_tile<2, 2>(left, right, i, j, rows, all);
  if (high) return put_tile<2, 1>(left, right, i, j, rows, all);
  if (wide) return put_tile<1, 2>(left, right, i, j, rows, all);
  put_tile<1, 1>(left, right, i, j, rows, all);
}

Eigen::MatrixXd table(std::size_t rows, std::size_t columns) {
  return {static_cast<Index>(rows), static_cast<Index>(columns)};
}

}  // namespace

Eigen::MatrixXd products(std::span<const Signal> left, std::span<const Signal> right,
                         std::span<const Range> rows) {
  Eigen::MatrixXd all = table(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); i += kTile) {
    for (std::size_t j = 0; j < right.size(); j += kTile) {
      put_tile_at(left, right, i, j, rows, all);
    }
  }
  return all;
}

Eigen::MatrixXd products(std::span<const Signal> signals, std::span<const Range> rows) {
  Eigen::MatrixXd all = table(signals.size(), signals.size());
  for (std::size_t i = 0; i < signals.size(); i += kTile) {
    for (std::size_t j = 0; j <= i; j += kTile) {
      put_tile_at(signals, signals, i, j, rows, all);
    }
  }
  return all.selfadjointView<Eigen::Lower>();
}

double sum_of_squares(Signal signal, std::span<const Range> rows) {
  return tile<1, 1>(&signal, &signal, rows)[0][0];
}

}  // namespace loopscope::core::model
