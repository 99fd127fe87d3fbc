#include "core/model/response/products.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/model/vectors/number_pair.hpp"

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
  std::array<NumberPair, width> b{};
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

/// Signals, and between which of the rows each is not zero.
struct Bounded {
  std::span<const Signal> signals;
  std::vector<Range> supports;  ///< numbers of rows' ranges
};

/// The ranges from the first to the last one that a signal has more than zeros in.
Range support_of(Signal signal, std::span<const Range> rows) {
  const auto silent = [&](const Range& range) {
    return std::all_of(signal + range.first, signal + range.end,
                       [](double value) { return value == 0.0; });
  };
  Range support{0, rows.size()};
  while (support.first < support.end && silent(rows[support.first])) ++support.first;
  while (support.first < support.end && silent(rows[support.end - 1])) --support.end;
  return support;
}

Bounded bounded(std::span<const Signal> signals, std::span<const Range> rows) {
  Bounded result{signals, {}};
  for (const Signal signal : signals) result.supports.push_back(support_of(signal, rows));
  return result;
}

/// Where any of a few signals from `first` on is not zero.
Range united(const Bounded& all, std::size_t first, std::size_t count) {
  Range support = all.supports[first];
  for (std::size_t i = first + 1; i < first + count; ++i) {
    support.first = std::min(support.first, all.supports[i].first);
    support.end = std::max(support.end, all.supports[i].end);
  }
  return support;
}

template <std::size_t height, std::size_t width>
void put_tile(const Bounded& left, const Bounded& right, std::size_t i, std::size_t j,
              std::span<const Range> rows, Eigen::MatrixXd& all) {
  const Range a_support = united(left, i, height), b_support = united(right, j, width);
  const std::size_t first = std::max(a_support.first, b_support.first);
  const std::size_t end = std::max(first, std::min(a_support.end, b_support.end));
  const Tile<height, width> sums =
      tile<height, width>(&left.signals[i], &right.signals[j], rows.subspan(first, end - first));
  for (std::size_t a = 0; a < height; ++a) {
    for (std::size_t b = 0; b < width; ++b) {
      all(static_cast<Index>(i + a), static_cast<Index>(j + b)) = sums[a][b];
    }
  }
}

void put_tile_at(const Bounded& left, const Bounded& right, std::size_t i, std::size_t j,
                 std::span<const Range> rows, Eigen::MatrixXd& all) {
  const bool high = i + 1 < left.signals.size();
  const bool wide = j + 1 < right.signals.size();
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
  const Bounded a = bounded(left, rows), b = bounded(right, rows);
  for (std::size_t i = 0; i < left.size(); i += kTile) {
    for (std::size_t j = 0; j < right.size(); j += kTile) {
      put_tile_at(a, b, i, j, rows, all);
    }
  }
  return all;
}

Eigen::MatrixXd products(std::span<const Signal> signals, std::span<const Range> rows) {
  Eigen::MatrixXd all = table(signals.size(), signals.size());
  const Bounded bound = bounded(signals, rows);
  for (std::size_t i = 0; i < signals.size(); i += kTile) {
    for (std::size_t j = 0; j <= i; j += kTile) {
      put_tile_at(bound, bound, i, j, rows, all);
    }
  }
  return all.selfadjointView<Eigen::Lower>();
}

double sum_of_squares(Signal signal, std::span<const Range> rows) {
  return tile<1, 1>(&signal, &signal, rows)[0][0];
}

}  // namespace loopscope::core::model
