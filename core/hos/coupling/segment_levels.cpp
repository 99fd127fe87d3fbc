#include "core/hos/coupling/segment_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/hos/transforms/segments.hpp"
#include "core/hos/transforms/window.hpp"

namespace loopscope::core::hos {
namespace {

/// Segments on either side that enter a level: nine are 320 samples of the paper's settings.
constexpr std::size_t kReach = 4;

/// Mean over bins of power over mean power, per segment.
std::vector<double> relative_powers(const Spectra& spectra) {
  const Settings& settings = spectra.settings();
  const auto first = static_cast<std::size_t>(
      std::ceil(main_lobe_half_width(settings.window) * static_cast<double>(settings.dft_length) /
                static_cast<double>(settings.segment_length)));
  std::vector<double> weights(spectra.frequencies() - first, 0.0);
  double bins = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(spectra.total_power(first + i) > 0.0)) continue;
    weights[i] = static_cast<double>(spectra.segments()) / spectra.total_power(first + i);
    bins += 1.0;
  }
  const SpectrumRows rows = spectra.rows();
  std::vector<double> result(spectra.row_length());
  spectra.kernels().weigh_rows(
      {spectra.power(first), rows.stride(), rows.row_length, weights.size()}, weights.data(),
      result.data());
  result.resize(spectra.segments());
  for (double& value : result) value = bins > 0.0 ? value / bins : 1.0;
  return result;
}

std::vector<double> running_median(const std::vector<double>& values) {
  std::vector<double> result(values.size());
  std::array<double, 2 * kReach + 1> sorted{};
  std::size_t count = 0;
  for (std::size_t next = 0, s = 0; s < values.size(); ++s) {
    if (s > kReach) {
      auto* const oldest =
          std::lower_bound(sorted.begin(), sorted.begin() + count, values[s - kReach - 1]);
      std::copy(oldest + 1, sorted.begin() + count, oldest);
      --count;
    }
    for (; next < std::min(values.size(), s + kReach + 1); ++next, ++count) {
      auto* const place = std::upper_bound(sorted.begin(), sorted.begin() + count, values[next]);
      std::copy_backward(place, sorted.begin() + count, sorted.begin() + count + 1);
      *place = values[next];
    }
    result[s] = sorted[count / 2];
  }
  return result;
}

/// Power over the running median: 0.2 is its standard deviation for noise. What exceeds the second
/// figure is an upset, what exceeds the first is no noise either.
constexpr double kRaised = 2.0;
constexpr double kUpset = 4.0;
/// An upset shows in two or three segments. Up to a thirtieth of the segments, two upsets in a
/// window of 4096, may be left out; the ten jumps of a slow limit cycle may not, of which some are
/// upsets and all are raised.
constexpr std::size_t kOneUpset = 3;
constexpr std::size_t kSegmentsPerUpset = 30;

std::vector<std::size_t> find_upsets(const std::vector<double>& powers,
                                     const std::vector<double>& levels) {
  std::vector<std::size_t> found;
  std::size_t raised = 0;
  for (std::size_t s = 0; s < powers.size(); ++s) {
    if (powers[s] > kRaised * levels[s]) ++raised;
    if (powers[s] > kUpset * levels[s]) found.push_back(s);
  }
  const bool few = raised <= std::max(kOneUpset, powers.size() / kSegmentsPerUpset);
  return few ? found : std::vector<std::size_t>{};
}

/// Standard deviation of the logarithms.
double log_spread(const std::vector<double>& values) {
  double mean = 0.0;
  double square = 0.0;
  for (const double value : values) {
    const double logarithm = std::log(value);
    mean += logarithm;
    square += logarithm * logarithm;
  }
  const auto count = static_cast<double>(values.size());
  mean /= count;
  return std::sqrt(std::max(0.0, square / count - mean * mean));
}

/// What log_spread() of the levels of a record of constant variance stays below in 999 of 1000 long
/// records: 1.7 times the expected one, which is that of a median over the independent segments
/// among nine (1.67 of them for every segment length, measured) and a mean over independent bins
/// (a third of the segment's length under a Hann taper).
double largest_spread(const Settings& settings) {
  constexpr double kMedianVariance = std::numbers::pi / 2.0;
  constexpr double kPerLength = 1.67;
  constexpr double kSafety = 1.7;
  const auto length = static_cast<double>(settings.segment_length);
  const auto span = static_cast<double>((2 * kReach + 1) * segment_hop(settings));
  const double segments = std::max(1.0, kPerLength * span / length);
  return kSafety * std::sqrt(kMedianVariance / (segments * length / 3.0));
}

}  // namespace

SegmentLevels::SegmentLevels(const Spectra& spectra) {
  constexpr double kQuietest = 1e-6;
  const std::vector<double> powers = relative_powers(spectra);
  std::vector<double> levels = running_median(powers);
  upsets_ = find_upsets(powers, levels);
  for (double& level : levels) level = std::max(level, kQuietest);
  vary_ = log_spread(levels) > largest_spread(spectra.settings());
  factors_.reserve(levels.size());
  for (const double level : levels) factors_.push_back(1.0 / std::sqrt(level));
}

}  // namespace loopscope::core::hos
