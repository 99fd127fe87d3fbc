#include "core/model/fit/load_signatures.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::model {
namespace {

constexpr std::size_t kOutputLength = 48;
/// The lags of most processes are over by then.
constexpr std::size_t kInputLength = 96;
/// Rows that lie apart see the lags in a few of them, and a record has too few to spare.
constexpr std::size_t kApartLength = 12;

std::size_t rows_of_mark(const RowGrid& grid, std::size_t length) {
  return grid.every_sample() ? length : kApartLength;
}

/// A step after one sample of rest, so that filters start from rest.
std::vector<double> step_of(std::size_t length) {
  std::vector<double> step(length + 1, 1.0);
  step.front() = 0.0;
  return step;
}

LoadSignature whitened(const NoiseModel& noise, std::vector<double> load) {
  whiten(noise, load, load);
  load.erase(load.begin());
  return load;
}

/// The size of the product at every row at which the whole mark has room. Before the first ones the
/// innovations still know of the start of the record.
std::vector<double> match_of(const LoadSignature& mark, const std::vector<double>& innovations,
                             std::size_t first) {
  std::vector<double> match(innovations.size(), 0.0);
  for (std::size_t k = first; k + mark.size() < innovations.size(); ++k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < mark.size(); ++j) sum += mark[j] * innovations[k + j];
    match[k] = std::abs(sum);
  }
  return match;
}

}  // namespace

LoadSignature output_load_signature(const NoiseModel& noise, const RowGrid& grid) {
  return whitened(noise, step_of(rows_of_mark(grid, kOutputLength)));
}

LoadSignature input_load_signature(const Structure& structure, const RowGrid& grid) {
  ProcessShape undelayed = structure.process;
  undelayed.delay_samples = 0;
  const std::size_t samples = rows_of_mark(grid, kInputLength) * grid.samples_per_row;
  return whitened(structure.noise,
                  at_rows({grid.samples_per_row, 0}, answer(undelayed, step_of(samples))));
}

std::vector<std::size_t> places_of(const LoadSignature& mark,
                                   const std::vector<double>& innovations, const RowGrid& grid,
                                   std::size_t earliest_row) {
  constexpr std::size_t kPlaces = 3;
  constexpr std::ptrdiff_t kApart = 20;
  const std::size_t warm_up = warm_up_rows(grid, innovations.size());
  std::vector<double> match = match_of(mark, innovations, std::max(warm_up, earliest_row));
  std::vector<std::size_t> places;
  while (places.size() < kPlaces) {
    const auto best = std::ranges::max_element(match);
    if (best == match.end() || *best <= 0.0) break;
    places.push_back(static_cast<std::size_t>(best - match.begin()));
    std::fill(best - std::min(kApart, best - match.begin()),
              best + std::min(kApart, match.end() - best), 0.0);
  }
  return places;
}

}  // namespace loopscope::core::model
