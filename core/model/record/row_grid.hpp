#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// On which samples of op the rows of pv fall: on every one, or where the sensor is renewed less
/// often on every `samples_per_row`-th.
struct RowGrid {
  std::size_t samples_per_row = 1;  ///< >= 1
  std::size_t first_sample = 0;     ///< of the first row; < samples_per_row

  [[nodiscard]] bool every_sample() const { return samples_per_row == 1; }
  /// Rows in a record of so many samples.
  [[nodiscard]] std::size_t rows_in(std::size_t samples) const;
  [[nodiscard]] std::size_t sample_of(std::size_t row) const {
    return first_sample + row * samples_per_row;
  }
  /// The first row that lies at a sample or after it.
  [[nodiscard]] std::size_t row_from(std::size_t sample) const;
};

/// What a signal of samples is at the rows, all of it `later` samples later; before the record as
/// in its first sample.
[[nodiscard]] std::vector<double> at_rows(const RowGrid& grid, std::span<const double> signal,
                                          std::size_t later = 0);

/// The same in place.
void keep_rows(const RowGrid& grid, std::vector<double>& signal);

}  // namespace loopscope::core::model
