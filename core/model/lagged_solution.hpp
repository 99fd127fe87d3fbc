#pragma once

#include "core/model/lane_basis.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

inline constexpr std::size_t kTarget = kLaggedColumns;  ///< pv(k) stands after the columns
inline constexpr std::size_t kConstant = kOutputLags;
inline constexpr std::size_t kFirstInput = kOutputLags + 1;
/// Of a column's own sum of squares: less than this left is rounding, not information.
inline constexpr double kNegligible = 1e-9;

/// Lower triangle of the products of all columns and the target.
using Products = std::array<std::array<double, kLaggedColumns + 1>, kLaggedColumns + 1>;

/// Sums over the rows: by_output[i][j] of y(k-i) u(k-j), by_input[i][j] of u(k-i) u(k-j), i <= j.
struct InputProducts {
  std::array<std::array<double, kInputLags + 1>, kOutputLags + 1> by_output{};
  std::array<std::array<double, kInputLags + 1>, kInputLags + 1> by_input{};
  std::array<double, kInputLags + 1> sums{};
};

/// Products of a value with the `lags` values before a row, the farthest first, and sums of such.
/// They stand side by side by lag, so that no order of adding depends on the vectors.
template <typename Number, std::size_t lags>
class SumsByLag {
 public:
  void add(double value, const double* farthest) {
    for (std::size_t i = 0; i < kVectors; ++i) {
      Number past;
      std::memcpy(&past, farthest + i * kElements<Number>, sizeof(past));
      sums_[i] += value * past;
    }
  }
  [[nodiscard]] double at(std::size_t lag) const {
    return sums_[(lags - lag) / kElements<Number>][(lags - lag) % kElements<Number>];
  }

 private:
  static constexpr std::size_t kVectors = lags / kElements<Number>;
  NumberRow<Number, kVectors> sums_{};
};

/// The products that start each diagonal: y(k) u(k-j), u(k-1) u(k-j), y(k-i) u(k-1).
template <typename Number>
void first_products(const LaggedRows& rows, const double* u, InputProducts& products) {
  constexpr std::size_t kWhole = 8;  // as many lags of pv as fill vectors
  const double* y = rows.output.data();
  SumsByLag<Number, kInputLags> output, input;
  SumsByLag<Number, kWhole> past;
  double sum = 0.0;
  for (const auto [begin, end] : rows.runs) {
    for (std::size_t k = begin; k < end; ++k) {
      output.add(y[k], &u[k - kInputLags]);
      input.add(u[k - 1], &u[k - kInputLags]);
      past.add(u[k - 1], &y[k - kWhole]);
      sum += u[k - 1];
    }
  }
  for (std::size_t lag = 1; lag <= kInputLags; ++lag) {
    products.by_output[0][lag] = output.at(lag);
    products.by_input[1][lag] = input.at(lag);
  }
  for (std::size_t lag = 1; lag <= kOutputLags; ++lag) products.by_output[lag][1] = past.at(lag);
  products.sums[1] = sum;
}

/// What sums over the runs gain when their rows go back by one: a row more in front of every run,
/// one less at its end. by_output[i][j] of y(k-i) u(k-j-1), by_input[i][j] of u(k-i-1) u(k-j-1).
struct Edges {
  std::array<std::array<double, kInputLags>, kOutputLags> by_output{};
  std::array<std::array<double, kInputLags>, kInputLags> by_input{};
  std::array<double, kInputLags> sums{};
};

/// The last values before a row.
struct Before {
  Before(const LaggedRows& rows, const double* u, std::size_t row) {
    for (std::size_t i = 0; i < kOutputLags; ++i) output[i] = rows.output[row - 1 - i];
    for (std::size_t j = 0; j < kInputLags; ++j) input[j] = u[row - 2 - j];
  }
  std::array<double, kOutputLags> output;
  std::array<double, kInputLags> input;
};

inline Edges edges_of(const LaggedRows& rows, const double* u) {
  Edges edges;
  for (const auto [begin, end] : rows.runs) {
    const Before more(rows, u, begin);
    const Before less(rows, u, end);
    // Whole rows of twelve: the compiler makes vectors of them, half of by_input or not.
    for (std::size_t i = 0; i < kOutputLags; ++i) {
      for (std::size_t j = 0; j < kInputLags; ++j) {
        edges.by_output[i][j] += more.output[i] * more.input[j] - less.output[i] * less.input[j];
      }
    }
    for (std::size_t i = 0; i < kInputLags; ++i) {
      for (std::size_t j = i / 2 * 2; j < kInputLags; ++j) {
        edges.by_input[i][j] += more.input[i] * more.input[j] - less.input[i] * less.input[j];
      }
    }
    for (std::size_t j = 0; j < kInputLags; ++j) edges.sums[j] += more.input[j] - less.input[j];
  }
  return edges;
}

template <typename Number>
InputProducts input_products(const LaggedRows& rows, const double* u) {
  InputProducts products;
  first_products<Number>(rows, u, products);
  const Edges edges = edges_of(rows, u);
  for (std::size_t j = 1; j < kInputLags; ++j) {
    for (std::size_t i = 0; i < kOutputLags; ++i) {
      products.by_output[i + 1][j + 1] = products.by_output[i][j] + edges.by_output[i][j - 1];
    }
    for (std::size_t i = 1; i <= j; ++i) {
      products.by_input[i + 1][j + 1] = products.by_input[i][j] + edges.by_input[i - 1][j - 1];
    }
    products.sums[j + 1] = products.sums[j] + edges.sums[j - 1];
  }
  return products;
}

inline void place_outputs(const LaggedRows& rows, Products& all) {
  for (std::size_t i = 0; i < kOutputLags; ++i) {
    std::copy_n(&rows.products[i + 1][1], i + 1, all[i].begin());
    all[kConstant][i] = rows.sums[i + 1];
    all[kTarget][i] = rows.products[i + 1][0];
  }
  all[kConstant][kConstant] = static_cast<double>(rows.rows);
  all[kTarget][kConstant] = rows.sums[0];
  all[kTarget][kTarget] = rows.products[0][0];
}

inline void place_inputs(const InputProducts& products, Products& all) {
  for (std::size_t j = 1; j <= kInputLags; ++j) {
    auto& row = all[kFirstInput + j - 1];
    for (std::size_t i = 1; i <= kOutputLags; ++i) {
      row[i - 1] = products.by_output[i][j];
    }
    row[kConstant] = products.sums[j];
    for (std::size_t i = 1; i <= j; ++i) {
      row[kFirstInput + i - 1] = products.by_input[i][j];
    }
    all[kTarget][kFirstInput + j - 1] = products.by_output[0][j];
  }
}

/// Cholesky factor in place; a diagonal entry becomes its reciprocal, 0 for a column that adds
/// nothing.
inline void factorise(Products& all) {
  for (std::size_t j = 0; j < kLaggedColumns; ++j) {
    double left = all[j][j];
    for (std::size_t l = 0; l < j; ++l) {
      left -= all[j][l] * all[j][l];
    }
    all[j][j] = left > kNegligible * all[j][j] ? 1.0 / std::sqrt(left) : 0.0;
    for (std::size_t i = j + 1; i <= kTarget; ++i) {
      double sum = all[i][j];
      for (std::size_t l = 0; l < j; ++l) {
        sum -= all[i][l] * all[j][l];
      }
      all[i][j] = sum * all[j][j];
    }
  }
}

inline LaggedModel solve(const Products& factor) {
  LaggedModel model;
  const double total = factor[kTarget][kTarget];
  model.residual = total;
  for (std::size_t j = kLaggedColumns; j-- > 0;) {
    model.residual -= factor[kTarget][j] * factor[kTarget][j];
    double sum = factor[kTarget][j];
    for (std::size_t i = j + 1; i < kLaggedColumns; ++i) {
      sum -= factor[i][j] * model.weights[i];
    }
    model.weights[j] = sum * factor[j][j];
  }
  // Rounding must not make a perfect fit better than perfect.
  model.residual = std::max(model.residual, 1e-12 * total);
  return model;
}

/// fit_lagged(), so many sums at a time. Number is of two or four doubles.
template <typename Number>
LaggedModel fitted(const LaggedRows& rows, std::span<const double> input) {
  Products all{};
  place_outputs(rows, all);
  place_inputs(input_products<Number>(rows, input.data()), all);
  factorise(all);
  return solve(all);
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
