#pragma once

#include <cstddef>
#include <span>

#include "core/model/record/loop_data.hpp"

namespace loopscope::core::model {

/// Signals of one record by their first samples.
using Signal = const double*;

/// Sums over rows, for one kind of processor. Four rows of a range go side by side everywhere, and
/// no product is added without rounding it first: all kinds give the same results, to the last
/// digit.
struct RowKernel {
  /// sums[i * stride + j] += the product of left[i] and right[j] over the rows.
  void (*add_products)(std::span<const Signal> left, std::span<const Signal> right,
                       std::span<const Range> rows, double* sums, std::size_t stride);
  /// from[j][r] -= the sum over i of coefficients[j * columns.size() + i] * columns[i][r], r <
  /// rows.
  void (*subtract)(std::span<const Signal> columns, const double* coefficients, std::size_t rows,
                   std::span<double* const> from);
};

/// The fastest that this processor can run.
[[nodiscard]] const RowKernel& best_row_kernel();

}  // namespace loopscope::core::model
