// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_RESPONSE_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_RESPONSE_SUMS_INL
#undef LOOPSCOPE_MODEL_RESPONSE_SUMS_INL
#else
#define LOOPSCOPE_MODEL_RESPONSE_SUMS_INL
#endif

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <hwy/highway.h>
#include <span>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/valve_law/valve_lanes-inl.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// Sums over the rows of a fit of whitened answers, side by side, with columns that they share and
/// with themselves, while the answers come by in stretches. Rows are added up in the digits of
/// Number a range at a time, and the ranges in full.
template <typename Number, std::size_t count>
class AnswerSums {
 public:
  using Element = typename ElementOf<Number>::type;
  using Numbers = NumberRow<Number, count>;

  /// `rows`, ascending, and `columns` have to outlive this; one or two taps, the second a sample
  /// later.
  AnswerSums(std::span<const Range> rows, std::span<const std::vector<Element>> columns,
             std::size_t taps)
      : rows_(rows), columns_(columns), taps_(taps), sums_(taps * (columns.size() + taps)) {}

  /// The answers x[1] to x[samples] at the samples from `first` on; x[0] is the one before.
  /// Stretches come one after the other.
  void add(std::size_t first, std::size_t samples, const Numbers* x) {
    for (; range_ < rows_.size(); ++range_) {
      const Range& range = rows_[range_];
      const std::size_t from = std::max(range.first, first);
      const std::size_t end = std::min(range.end, first + samples);
      if (from < end) add_rows(from, end - from, x + 1 + (from - first));
      if (range.end > first + samples) return;
    }
  }

  /// Of one of them: taps x (columns + taps).
  [[nodiscard]] Eigen::MatrixXd products(std::size_t lane) const {
    const auto steady = static_cast<Eigen::Index>(columns_.size());
    const auto taps = static_cast<Eigen::Index>(taps_);
    Eigen::MatrixXd result(taps, steady + taps);
    std::size_t at = 0;
    for (Eigen::Index tap = 0; tap < taps; ++tap) {
      for (Eigen::Index j = 0; j < steady; ++j) result(tap, j) = sums_[at++][lane];
      for (Eigen::Index j = 0; j <= tap; ++j) {
        result(tap, steady + j) = result(j, steady + tap) = sums_[at++][lane];
      }
    }
    return result;
  }

 private:
  static constexpr std::size_t kTogether = sizeof(Number) / sizeof(Element);
  static constexpr std::size_t kLanes = kTogether * count;

  void add_rows(std::size_t row, std::size_t samples, const Numbers* x) {
    std::size_t at = 0;
    for (std::size_t tap = 0; tap < taps_; ++tap) {
      const Numbers* answer = x - tap;
      for (const std::vector<Element>& column : columns_) {
        add_to(at++, samples, answer, [&](std::size_t k, std::size_t) { return column[row + k]; });
      }
      for (std::size_t j = 0; j <= tap; ++j) {
        // By reference: a lambda does not belong to the kind of processor, and must pass no
        // vectors.
        add_to(at++, samples, answer,
               [&](std::size_t k, std::size_t i) -> const Number& { return (x - j)[k][i]; });
      }
    }
  }

  /// Even and odd rows apart, so that a sum does not wait for itself at every row.
  template <typename Other>
  void add_to(std::size_t at, std::size_t samples, const Numbers* x, Other other) {
    Numbers even{}, odd{};
    std::size_t k = 0;
    for (; k + 2 <= samples; k += 2) {
      for (std::size_t i = 0; i < count; ++i) {
        even[i] += other(k, i) * x[k][i];
        odd[i] += other(k + 1, i) * x[k + 1][i];
      }
    }
    for (; k < samples; ++k) {
      for (std::size_t i = 0; i < count; ++i) even[i] += other(k, i) * x[k][i];
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = lane / kTogether, j = lane % kTogether;
      sums_[at][lane] += static_cast<double>(even[i][j] + odd[i][j]);
    }
  }

  std::span<const Range> rows_;
  std::span<const std::vector<Element>> columns_;
  std::size_t taps_;
  std::vector<std::array<double, kLanes>> sums_;
  std::size_t range_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_RESPONSE_SUMS_INL
