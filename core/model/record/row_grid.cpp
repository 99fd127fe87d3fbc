#include "core/model/record/row_grid.hpp"

namespace loopscope::core::model {

std::size_t RowGrid::rows_in(std::size_t samples) const {
  return samples <= first_sample ? 0 : (samples - first_sample - 1) / samples_per_row + 1;
}

std::size_t RowGrid::row_from(std::size_t sample) const {
  return sample <= first_sample ? 0 : (sample - first_sample - 1) / samples_per_row + 1;
}

std::vector<double> at_rows(const RowGrid& grid, std::span<const double> signal,
                            std::size_t later) {
  if (grid.every_sample() && later == 0) return {signal.begin(), signal.end()};
  std::vector<double> result(grid.rows_in(signal.size()));
  for (std::size_t row = 0; row < result.size(); ++row) {
    const std::size_t sample = grid.sample_of(row);
    result[row] = signal[sample < later ? 0 : sample - later];
  }
  return result;
}

void keep_rows(const RowGrid& grid, std::vector<double>& signal) {
  if (grid.every_sample()) return;
  const std::size_t rows = grid.rows_in(signal.size());
  for (std::size_t row = 0; row < rows; ++row) signal[row] = signal[grid.sample_of(row)];
  signal.resize(rows);
}

}  // namespace loopscope::core::model
