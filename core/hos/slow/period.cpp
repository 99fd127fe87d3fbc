#include "core/hos/slow/period.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "core/hos/numeric/magnitude.hpp"
#include "core/hos/transforms/record_fft.hpp"

namespace loopscope::core::hos {
namespace {

/// Bands are 8 % wide to either side, their neighbourhood reaches from 1.3 to 1.9 times their
/// frequency on both sides: clear of the band, short of the next harmonic.
constexpr double kBand = 1.08;
constexpr double kNear = 1.3;
constexpr double kFar = 1.9;
/// Next band; bands overlap so that no peak falls between two.
constexpr double kStep = 1.02;
/// Standard deviations of the logarithm of a band's mean power that make it clear.
constexpr double kClear = 4.0;
/// Mean of -ln of a periodogram ordinate of noise over its expectation (Euler's constant).
constexpr double kLogBias = 0.5772;

/// Running sums of a periodogram and of its logarithm.
class Periodogram {
 public:
  Periodogram(const std::vector<std::complex<double>>& spectrum, std::size_t length)
      : power_(used(length) + 1), log_power_(used(length) + 1), length_(length) {
    for (std::size_t k = 0; k + 1 < power_.size(); ++k) {
      const double power = std::norm(spectrum[k]);
      power_[k + 1] = power_[k] + power;
      log_power_[k + 1] = log_power_[k] + std::log(power + std::numeric_limits<double>::min());
    }
  }

  [[nodiscard]] std::size_t bin(double frequency) const {
    const auto k =
        static_cast<std::size_t>(std::floor(frequency * static_cast<double>(length_) + 0.5));
    return std::clamp<std::size_t>(k, 1, power_.size() - 1);
  }
  [[nodiscard]] double frequency(double bin) const { return bin / static_cast<double>(length_); }
  [[nodiscard]] double power(std::size_t k) const { return power_[k + 1] - power_[k]; }
  [[nodiscard]] double mean(std::size_t first, std::size_t last) const {
    return (power_[last] - power_[first]) / static_cast<double>(last - first);
  }
  /// Logarithm of the expected power, from the mean logarithm: lines in it count little.
  [[nodiscard]] double background(double low, double high) const {
    const std::size_t first = bin(low);
    const std::size_t last = std::max(first + 2, bin(high));
    return (log_power_[last] - log_power_[first]) / static_cast<double>(last - first) + kLogBias;
  }

 private:
  /// Bins up to the far end of the highest band's neighbourhood.
  static std::size_t used(std::size_t length) {
    return static_cast<std::size_t>(kFar / kShortestPeriod * static_cast<double>(length)) + 3;
  }

  std::vector<double> power_;
  std::vector<double> log_power_;
  std::size_t length_;
};

/// Mean and slow drift removed, ends tapered, gaps left at zero; `length` values, zeros at the end.
std::vector<double> tapered(std::span<const double> signal, std::size_t length,
                            const Kernels& kernels) {
  Centring line;
  line.factor = 1.0 / power_of_two_below(kernels.scan(signal).largest);
  line.first = first_finite(signal) * line.factor;
  const TrendSums sums = kernels.sum_trend(signal, line);
  const double determinant = sums.count * sums.place_square - sums.place * sums.place;
  line.slope =
      determinant > 0.0 ? (sums.count * sums.moment - sums.place * sums.value) / determinant : 0.0;
  line.centre = (sums.value - line.slope * sums.place) / std::max(sums.count, 1.0);
  std::vector<double> result(length, 0.0);
  kernels.taper_record(signal, line, result.data());
  return result;
}

struct BandScore {
  double score = 0.0;  ///< power per octave
  bool clear = false;
  double frequency = 0.0;

  [[nodiscard]] bool better_than(const BandScore& other) const {
    return clear != other.clear ? clear : score > other.score;
  }
};

BandScore score_band(const Periodogram& periodogram, double frequency, double independent) {
  const std::size_t first = periodogram.bin(frequency / kBand);
  const std::size_t last = std::max(first + 3, periodogram.bin(frequency * kBand));
  const double mean = periodogram.mean(first, last);
  const double background = 0.5 * (periodogram.background(frequency / kFar, frequency / kNear) +
                                   periodogram.background(frequency * kNear, frequency * kFar));
  const double deviation =
      (std::log(mean) - background) * std::sqrt(static_cast<double>(last - first) * independent);
  const bool clear = deviation > kClear;
  const double excess = clear ? mean - std::exp(background) : mean;
  return {excess * frequency, clear, frequency};
}

/// Centre of power around the highest bin of a band.
double refined(const Periodogram& periodogram, double frequency) {
  std::size_t peak = periodogram.bin(frequency / kBand);
  for (std::size_t k = peak; k <= periodogram.bin(frequency * kBand); ++k) {
    if (periodogram.power(k) > periodogram.power(peak)) peak = k;
  }
  constexpr std::size_t kBinsAround = 3;
  double power = 0.0;
  double moment = 0.0;
  for (std::size_t k = peak > kBinsAround ? peak - kBinsAround : 1; k <= peak + kBinsAround; ++k) {
    power += periodogram.power(k);
    moment += periodogram.power(k) * static_cast<double>(k);
  }
  return periodogram.frequency(moment / power);
}

}  // namespace

std::optional<double> dominant_period(std::span<const double> signal, const Kernels& kernels) {
  const auto count = static_cast<double>(signal.size());
  if (count < kFewestCycles * kShortestPeriod) return std::nullopt;
  const std::size_t length = std::bit_ceil(signal.size());
  const Periodogram periodogram(
      RecordFft::of_length(length).transform(tapered(signal, length, kernels)), length);
  BandScore best;
  for (double f = kFewestCycles / count; f <= 1.0 / kShortestPeriod; f *= kStep) {
    const BandScore next = score_band(periodogram, f, count / static_cast<double>(length));
    if (next.better_than(best)) best = next;
  }
  const double frequency = best.frequency > 0.0 ? refined(periodogram, best.frequency) : 0.0;
  if (!(frequency > 0.0)) return std::nullopt;
  return std::clamp(1.0 / frequency, kShortestPeriod, count / kFewestCycles);
}

}  // namespace loopscope::core::hos
