#pragma once

#include "core/model/lane_basis.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

/// Rows are added up four at a time and these four at the end, in that order for every processor.
inline constexpr std::size_t kRowsAtOnce = 4;

/// Sums of products of `height` signals with `width` others over ranges of rows: each loaded row
/// serves as many sums, and all of them stay in registers.
template <typename Number, std::size_t height, std::size_t width>
class ProductTile {
 public:
  void add(const Signal* left, const Signal* right, const Range& rows) {
    // Copies of its own: a sum that could be one of the rows would go through memory every time.
    Sums sums = sums_;
    std::array<Signal, height> a;
    std::array<Signal, width> b;
    std::copy_n(left, height, a.begin());
    std::copy_n(right, width, b.begin());
    std::size_t k = rows.first;
    for (; k + kRowsAtOnce <= rows.end; k += kRowsAtOnce) add_rows(a, b, k, sums);
    sums_ = sums;
    for (; k < rows.end; ++k) {
      for (std::size_t i = 0; i < height; ++i) {
        for (std::size_t j = 0; j < width; ++j) single_[i][j] += a[i][k] * b[j][k];
      }
    }
  }

  [[nodiscard]] double sum(std::size_t i, std::size_t j) const {
    std::array<double, kRowsAtOnce> parts;
    std::memcpy(&parts, &sums_[i * width + j], sizeof(parts));
    return single_[i][j] + ((parts[0] + parts[1]) + (parts[2] + parts[3]));
  }

 private:
  static constexpr std::size_t kVectors = kRowsAtOnce / kElements<Number>;
  using Rows = NumberRow<Number, kVectors>;
  using Sums = NumberRow<Rows, height * width>;

  static Rows load(const double* values) {
    Rows rows;
    std::memcpy(&rows, values, sizeof(rows));
    return rows;
  }

  [[gnu::always_inline]] static inline void add_rows(const std::array<Signal, height>& left,
                                                     const std::array<Signal, width>& right,
                                                     std::size_t k, Sums& sums) {
    NumberRow<Rows, width> b;
    for (std::size_t j = 0; j < width; ++j) b[j] = load(right[j] + k);
    for (std::size_t i = 0; i < height; ++i) {
      const Rows a = load(left[i] + k);
      for (std::size_t j = 0; j < width; ++j) {
        for (std::size_t v = 0; v < kVectors; ++v) sums[i * width + j][v] += a[v] * b[j][v];
      }
    }
  }

  Sums sums_{};
  std::array<std::array<double, width>, height> single_{};
};

/// Signals, and between which of the rows each is not zero.
struct Bounded {
  std::span<const Signal> signals;
  std::vector<Range> supports;  ///< numbers of rows' ranges
};

/// The ranges from the first to the last one that a signal has more than zeros in.
inline Range support_of(Signal signal, std::span<const Range> rows) {
  const auto silent = [&](const Range& range) {
    return std::all_of(signal + range.first, signal + range.end,
                       [](double value) { return value == 0.0; });
  };
  Range support{0, rows.size()};
  while (support.first < support.end && silent(rows[support.first])) ++support.first;
  while (support.first < support.end && silent(rows[support.end - 1])) --support.end;
  return support;
}

inline Bounded bounded(std::span<const Signal> signals, std::span<const Range> rows) {
  Bounded result{signals, {}};
  for (const Signal signal : signals) result.supports.push_back(support_of(signal, rows));
  return result;
}

/// Where any of a few signals from `first` on is not zero.
inline Range united(const Bounded& all, std::size_t first, std::size_t count) {
  Range support = all.supports[first];
  for (std::size_t i = first + 1; i < first + count; ++i) {
    support.first = std::min(support.first, all.supports[i].first);
    support.end = std::max(support.end, all.supports[i].end);
  }
  return support;
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
