#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/response/row_kernel.hpp"

namespace loopscope::core::model {

/// The columns of a table, which has to outlive them.
[[nodiscard]] std::vector<Signal> columns_of(const Eigen::Ref<const Eigen::MatrixXd>& table);

/// Sums over the rows, which ascend, of the products of each signal of `left` with each of `right`.
/// Where signals begin or end with zeros, as columns that sit in one place do, nothing is summed.
[[nodiscard]] Eigen::MatrixXd products(std::span<const Signal> left, std::span<const Signal> right,
                                       std::span<const Range> rows);

/// The same of all signals with one another.
[[nodiscard]] Eigen::MatrixXd products(std::span<const Signal> signals,
                                       std::span<const Range> rows);

/// Sum of squares over the rows.
[[nodiscard]] double sum_of_squares(Signal signal, std::span<const Range> rows);

}  // namespace loopscope::core::model
