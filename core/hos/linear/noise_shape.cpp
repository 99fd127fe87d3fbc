#include "core/hos/linear/noise_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::hos {
namespace {

/// Kurtosis of normal values over the local scale that they enter themselves: those of three blocks
/// and the prior's share the square, 3 m / (m + 2) for m of them.
constexpr double kScaled =
    3.0 * static_cast<double>(Innovations::kBlock) + Innovations::kPriorSamples;
constexpr double kNormalKurtosis = 3.0 * kScaled / (kScaled + 2.0);

/// The kurtosis `b2` of n normal values as a standard normal deviate.
double kurtosis_deviate(double b2, double n) {
  const double mean = 3.0 * (n - 1.0) / (n + 1.0);
  const double variance =
      24.0 * n * (n - 2.0) * (n - 3.0) / ((n + 1.0) * (n + 1.0) * (n + 3.0) * (n + 5.0));
  const double skewness = 6.0 * (n * n - 5.0 * n + 2.0) / ((n + 7.0) * (n + 9.0)) *
                          std::sqrt(6.0 * (n + 3.0) * (n + 5.0) / (n * (n - 2.0) * (n - 3.0)));
  const double a =
      6.0 + 8.0 / skewness * (2.0 / skewness + std::sqrt(1.0 + 4.0 / (skewness * skewness)));
  const double x = (b2 - mean) / std::sqrt(variance);
  const double ratio = (1.0 - 2.0 / a) / std::max(1.0 + x * std::sqrt(2.0 / (a - 4.0)), 1e-3);
  return (1.0 - 2.0 / (9.0 * a) - std::cbrt(ratio)) / std::sqrt(2.0 / (9.0 * a));
}

/// The known innovations one after another.
struct Known {
  std::vector<double> scaled;  // over their local scale
  std::vector<double> magnitudes;
  std::vector<std::size_t> places;

  explicit Known(const Innovations& innovations) {
    const std::vector<double>& values = innovations.values();
    scaled.reserve(values.size());
    magnitudes.reserve(values.size());
    places.reserve(values.size());
    for (std::size_t first = 0; first < values.size(); first += Innovations::kBlock) {
      const double inverse = 1.0 / innovations.scale()[first];
      const std::size_t end = std::min(values.size(), first + Innovations::kBlock);
      for (std::size_t t = first; t < end; ++t) {
        if (!std::isfinite(values[t])) continue;
        scaled.push_back(values[t] * inverse);
        magnitudes.push_back(std::abs(values[t]));
        places.push_back(t);
      }
    }
  }
};

void judge_tails(const std::vector<double>& values, const Kernels& kernels, NoiseShape& shape) {
  const PowerSums raw = kernels.sum_powers(values, {});
  const PowerSums sums = kernels.sum_powers(values, {.centre = raw.first / raw.count});
  const double n = sums.count;
  const double variance = sums.second / n;
  if (!(variance > 0.0)) return;
  const double kurtosis = 3.0 / kNormalKurtosis * sums.fourth / (n * variance * variance);
  const double deviate = kurtosis_deviate(kurtosis, n);
  shape.excess_kurtosis = kurtosis - 3.0;
  shape.tails_p = above_zero(normal_upper(deviate));
  shape.light_tails_p = above_zero(normal_upper(-deviate));
  const double skewness = sums.third / (n * variance * std::sqrt(variance));
  shape.skewness_p = 2.0 * above_zero(normal_upper(std::abs(skewness) * std::sqrt(n / 6.0)));
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of as many neighbours each as go into `length`.
std::vector<double> block_means(const std::vector<double>& values, std::size_t length) {
  std::vector<double> means(values.size() / length);
  for (std::size_t b = 0; b < means.size(); ++b) {
    for (std::size_t i = 0; i < length; ++i) means[b] += values[b * length + i];
    means[b] /= static_cast<double>(length);
  }
  return means;
}

struct MeanAndVariance {
  double mean = 0.0;
  double variance = 0.0;

  explicit MeanAndVariance(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double value : values) {
      mean += value;
      squares += value * value;
    }
    mean /= static_cast<double>(values.size());
    variance = squares / static_cast<double>(values.size()) - mean * mean;
  }
};

/// p of means over `length` values each that scatter as these do, were the values independent; chi
/// squared by Wilson and Hilferty's cube root.
double scatter_p(const std::vector<double>& means, std::size_t length, const MeanAndVariance& all) {
  if (means.size() < 2 || !(all.variance > 0.0)) return 1.0;
  double squares = 0.0;
  for (const double mean : means) squares += (mean - all.mean) * (mean - all.mean);
  const double freedom = static_cast<double>(means.size()) - 1.0;
  const double ratio = squares * static_cast<double>(length) / (all.variance * freedom);
  const double unit = 2.0 / (9.0 * freedom);
  return above_zero(normal_upper((std::cbrt(ratio) - (1.0 - unit)) / std::sqrt(unit)));
}

void judge_variance(const std::vector<double>& magnitudes, NoiseShape& shape) {
  constexpr std::size_t kShortest = 16;
  constexpr std::array<std::size_t, 3> kTimes = {1, 4, 16};
  const MeanAndVariance all(magnitudes);
  const std::vector<double> shortest = block_means(magnitudes, kShortest);
  for (const std::size_t times : kTimes) {
    const double p = scatter_p(block_means(shortest, times), times * kShortest, all);
    shape.variance_p = std::min(shape.variance_p, static_cast<double>(kTimes.size()) * p);
  }
}

constexpr std::size_t kLoudnessBlock = 32;

/// The run of blocks in which the excess over one and a half times the usual adds up to most.
void find_loudest(const std::vector<double>& loudness, double usual,
                  const std::vector<std::size_t>& places, NoiseShape& shape) {
  constexpr double kLoud = 1.5;
  double most = 0.0;
  double sum = 0.0;
  std::size_t first = 0;
  for (std::size_t b = 0; b < loudness.size(); ++b) {
    if (sum <= 0.0) {
      sum = 0.0;
      first = b;
    }
    sum += loudness[b] / usual - kLoud;
    if (sum <= most) continue;
    most = sum;
    shape.loudest_first = places[first * kLoudnessBlock];
    shape.loudest_size = places[(b + 1) * kLoudnessBlock - 1] + 1 - shape.loudest_first;
    shape.loudest_ratio = kLoud + sum / static_cast<double>(b + 1 - first);
  }
}

}  // namespace

NoiseShape noise_shape(const Innovations& innovations, const Kernels& kernels) {
  NoiseShape shape;
  Known known(innovations);
  if (known.scaled.size() < LinearModel::kFewestResiduals) return shape;
  judge_tails(known.scaled, kernels, shape);
  const std::vector<double> loudness = block_means(known.magnitudes, kLoudnessBlock);
  const double usual = median_of(loudness);
  if (!(usual > 0.0)) return shape;
  find_loudest(loudness, usual, known.places, shape);
  // Magnitudes of normal noise have a mean of 0.8 of its standard deviation.
  constexpr double kFarthest = 3.5 / 0.8;
  for (double& value : known.magnitudes) value = std::min(value, kFarthest * usual);
  judge_variance(known.magnitudes, shape);
  return shape;
}

}  // namespace loopscope::core::hos
