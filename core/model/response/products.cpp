#include "core/model/response/products.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/model/response/row_kernel.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;

/// Signals to a tile of the results, over the rows where none of them is all zeros.
constexpr std::size_t kTile = 4;

/// Signals, and between which of the rows each is not zero.
struct Bounded {
  std::span<const Signal> signals;
  std::vector<Range> supports;  ///< numbers of rows' ranges
};

/// Eight numbers at a time, which the processor compares side by side.
bool is_silent(std::span<const double> signal) {
  constexpr std::size_t kAtOnce = 8;
  std::size_t k = 0;
  for (; k + kAtOnce <= signal.size(); k += kAtOnce) {
    double loudest = 0.0;
    for (std::size_t i = k; i < k + kAtOnce; ++i) loudest += std::abs(signal[i]);
    if (loudest != 0.0) return false;
  }
  return std::all_of(signal.begin() + static_cast<std::ptrdiff_t>(k), signal.end(),
                     [](double value) { return value == 0.0; });
}

/// The ranges from the first to the last one that a signal has more than zeros in.
Range support_of(Signal signal, std::span<const Range> rows) {
  const auto silent = [&](const Range& range) {
    return is_silent({signal + range.first, range.size()});
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

/// Of up to a tile's signals from `i` and from `j` on.
void put_tile(const Bounded& left, const Bounded& right, std::size_t i, std::size_t j,
              std::span<const Range> rows, Eigen::MatrixXd& all) {
  const std::size_t height = std::min(kTile, left.signals.size() - i);
  const std::size_t width = std::min(kTile, right.signals.size() - j);
  const Range a = united(left, i, height), b = united(right, j, width);
  const std::size_t first = std::max(a.first, b.first);
  const std::size_t end = std::max(first, std::min(a.end, b.end));
  // Of a column of the results the rows stand side by side.
  best_row_kernel().add_products(right.signals.subspan(j, width), left.signals.subspan(i, height),
                                 rows.subspan(first, end - first),
                                 &all(static_cast<Index>(i), static_cast<Index>(j)),
                                 static_cast<std::size_t>(all.rows()));
}

Eigen::MatrixXd table(std::size_t rows, std::size_t columns) {
  return Eigen::MatrixXd::Zero(static_cast<Index>(rows), static_cast<Index>(columns));
}

}  // namespace

std::vector<Signal> columns_of(const Eigen::Ref<const Eigen::MatrixXd>& table) {
  std::vector<Signal> result;
  for (Index at = 0; at < table.cols(); ++at) result.push_back(table.col(at).data());
  return result;
}

Eigen::MatrixXd products(std::span<const Signal> left, std::span<const Signal> right,
                         std::span<const Range> rows) {
  Eigen::MatrixXd all = table(left.size(), right.size());
  const Bounded a = bounded(left, rows), b = bounded(right, rows);
  for (std::size_t i = 0; i < left.size(); i += kTile) {
    for (std::size_t j = 0; j < right.size(); j += kTile) {
      put_tile(a, b, i, j, rows, all);
    }
  }
  return all;
}

Eigen::MatrixXd products(std::span<const Signal> signals, std::span<const Range> rows) {
  Eigen::MatrixXd all = table(signals.size(), signals.size());
  const Bounded bound = bounded(signals, rows);
  for (std::size_t i = 0; i < signals.size(); i += kTile) {
    for (std::size_t j = 0; j <= i; j += kTile) {
      put_tile(bound, bound, i, j, rows, all);
    }
  }
  return all.selfadjointView<Eigen::Lower>();
}

double sum_of_squares(Signal signal, std::span<const Range> rows) {
  double sum = 0.0;
  best_row_kernel().add_products({&signal, 1}, {&signal, 1}, rows, &sum, 1);
  return sum;
}

}  // namespace loopscope::core::model
