#include "core/model/load_marks.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::model {
namespace {

constexpr std::size_t kOutputLength = 48;
/// The lags of most processes are over by then.
constexpr std::size_t kInputLength = 96;
/// Before that the innovations still know of the start of the record.
constexpr std::size_t kFirst = 40;

/// A step after one sample of rest, so that filters start from rest.
std::vector<double> step_of(std::size_t length) {
  std::vector<double> step(length + 1, 1.0);
  step.front() = 0.0;
  return step;
}

LoadMark whitened(const NoiseModel& noise, std::vector<double> load) {
  whiten(noise, load, load);
  load.erase(load.begin());
  return load;
}

/// The size of the product at every sample at which the whole mark has room.
std::vector<double> match_of(const LoadMark& mark, const std::vector<double>& innovations) {
  std::vector<double> match(innovations.size(), 0.0);
  for (std::size_t k = kFirst; k + mark.size() < innovations.size(); ++k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < mark.size(); ++j) sum += mark[j] * innovations[k + j];
    match[k] = std::abs(sum);
  }
  return match;
}

}  // namespace

LoadMark output_load_mark(const NoiseModel& noise) {
  return whitened(noise, step_of(kOutputLength));
}

LoadMark input_load_mark(const Structure& structure) {
  ProcessShape undelayed = structure.process;
  undelayed.delay_samples = 0;
  return whitened(structure.noise, answer(undelayed, step_of(kInputLength)));
}

std::vector<std::size_t> places_of(const LoadMark& mark, const std::vector<double>& innovations) {
  constexpr std::size_t kPlaces = 3;
  constexpr std::ptrdiff_t kApart = 20;
  std::vector<double> match = match_of(mark, innovations);
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
