#include "core/model/lagged_rows.hpp"

#include <cmath>

namespace loopscope::core::model {
namespace {

double mean_of_known(std::span<const double> values) {
  double sum = 0.0;
  std::size_t known = 0;
  for (const double value : values) {
    if (!std::isnan(value)) {
      sum += value;
      ++known;
    }
  }
  return known > 0 ? sum / static_cast<double>(known) : 0.0;
}

bool most(std::span<const std::uint8_t> flags) {
  std::size_t set = 0;
  for (const std::uint8_t flag : flags) {
    set += flag != 0 ? 1U : 0U;
  }
  return 4 * set >= 3 * flags.size();
}

/// Rows whose pv and op are known, and which of them may be fitted.
struct Usable {
  std::vector<std::uint8_t> pv, op, fit;
};

bool lags_known(const Usable& usable, std::size_t row) {
  bool known = usable.pv[row] != 0;
  for (std::size_t lag = 1; lag <= kOutputLags; ++lag) {
    known = known && usable.pv[row - lag] != 0;
  }
  for (std::size_t lag = 1; lag <= kInputLags; ++lag) {
    known = known && usable.op[row - lag] != 0;
  }
  return known;
}

void collect_runs(LaggedRows& rows, const Usable& usable) {
  rows.counted.assign(rows.output.size(), 0);
  // One row more than the lags: sums slide back by one row at the edges of a run.
  for (std::size_t row = kInputLags + 1; row < rows.output.size(); ++row) {
    if (usable.fit[row] == 0 || !lags_known(usable, row)) {
      continue;
    }
    rows.counted[row] = 1;
    ++rows.rows;
    if (rows.runs.empty() || rows.runs.back().end != row) {
      rows.runs.push_back({row, row});
    }
    rows.runs.back().end = row + 1;
  }
}

void sum_outputs(LaggedRows& rows) {
  const double* y = rows.output.data();
  for (std::size_t i = 0; i <= kOutputLags; ++i) {
    for (const auto [begin, end] : rows.runs) {
      for (std::size_t k = begin; k < end; ++k) {
        rows.sums[i] += y[k - i];
        for (std::size_t j = 0; j <= i; ++j) {
          rows.products[i][j] += y[k - i] * y[k - j];
        }
      }
    }
  }
}

}  // namespace

LaggedRows lagged_rows(std::span<const double> pv, std::span<const std::uint8_t> fit,
                       std::span<const std::uint8_t> op_known, std::size_t samples_per_row) {
  LaggedRows rows;
  rows.samples_per_row = samples_per_row;
  const std::size_t count = pv.size() / samples_per_row;
  const double level = mean_of_known(pv);
  Usable usable;
  for (std::size_t row = 0; row < count; ++row) {
    const std::size_t first = row * samples_per_row;
    const auto samples = pv.subspan(first, samples_per_row);
    std::size_t known = 0;
    for (const double value : samples) {
      known += std::isnan(value) ? 0U : 1U;
    }
    rows.output.push_back(known > 0 ? mean_of_known(samples) - level : 0.0);
    usable.pv.push_back(4 * known >= 3 * samples_per_row ? 1 : 0);
    usable.op.push_back(most(op_known.subspan(first, samples_per_row)) ? 1 : 0);
    usable.fit.push_back(most(fit.subspan(first, samples_per_row)) ? 1 : 0);
  }
  collect_runs(rows, usable);
  sum_outputs(rows);
  return rows;
}

}  // namespace loopscope::core::model
