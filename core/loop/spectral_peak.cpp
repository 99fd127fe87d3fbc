#include "core/loop/spectral_peak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hos/numeric/distributions.hpp"
#include "core/loop/deviate_bound.hpp"

namespace loopscope::core::loop {
namespace {

// Bands as factors of the candidate's frequency. The side bands end short of the second harmonic
// (2) and of the fundamental of a candidate that is itself a second harmonic (1/2).
constexpr double kPeakFactor = 1.15;
constexpr double kSideNear = 1.3;
constexpr double kSideFar = 1.85;
constexpr double kGridFactor = 1.03;

/// Mean power of a band and the degrees of freedom of that mean.
struct BandPower {
  double mean = 0.0;
  double freedom = 0.0;
  double bins = 0.0;
};

/// Band averages in constant time.
class PowerSums {
 public:
  explicit PowerSums(const RecordSpectrum& spectrum)
      : bin_width_(spectrum.bin_width()),
        share_(spectrum.independent_share()),
        sums_(spectrum.power().size() + 1, 0.0) {
    for (std::size_t i = 0; i + 1 < sums_.size(); ++i)
      sums_[i + 1] = sums_[i] + spectrum.power()[i];
  }

  [[nodiscard]] BandPower mean(double low, double high) const {
    const std::size_t last_bin = sums_.size() - 2;
    const auto first = std::clamp<std::size_t>(rounded(low), 1, last_bin);
    const auto last = std::clamp<std::size_t>(rounded(high), first, last_bin);
    const auto bins = static_cast<double>(last - first + 1);
    return {(sums_[last + 1] - sums_[first]) / bins, std::max(2.0, 2.0 * bins * share_), bins};
  }

  /// No band of a recorded signal is emptier than its rounding; keeps ratios finite.
  [[nodiscard]] double floor() const {
    return sums_.back() * std::numeric_limits<double>::epsilon() /
           static_cast<double>(sums_.size());
  }

 private:
  [[nodiscard]] std::size_t rounded(double frequency) const {
    return static_cast<std::size_t>(std::lround(frequency / bin_width_));
  }

  double bin_width_;
  double share_;
  std::vector<double> sums_;
};

/// Geometric mean of the side bands: exact for every power law, so for white noise and for a
/// random walk alike.
BandPower background(const PowerSums& sums, double frequency) {
  const BandPower below = sums.mean(frequency / kSideFar, frequency / kSideNear);
  const BandPower above = sums.mean(frequency * kSideNear, frequency * kSideFar);
  const double mean = std::sqrt((below.mean + sums.floor()) * (above.mean + sums.floor()));
  return {mean, 4.0 * below.freedom * above.freedom / (below.freedom + above.freedom), 0.0};
}

struct Candidate {
  SpectralPeak peak;
  double excess = 0.0;  // power above the background
};

bool is_better(const Candidate& candidate, const Candidate& best) {
  const bool clear = candidate.peak.prominence >= kClearProminence;
  const bool best_clear = best.peak.prominence >= kClearProminence;
  if (clear != best_clear) return clear;
  return clear ? candidate.excess > best.excess : candidate.peak.prominence > best.peak.prominence;
}

/// Whether a candidate of that excess and at most so prominent may be better than the best so far.
bool may_win(double excess, double most_prominent, const std::optional<Candidate>& best) {
  if (!best) return true;
  if (best->peak.prominence >= kClearProminence)
    return excess > best->excess && !(most_prominent < kClearProminence);
  return !(most_prominent < best->peak.prominence);
}

}  // namespace

std::optional<SpectralPeak> find_spectral_peak(const RecordSpectrum& spectrum, Band range) {
  const PowerSums sums(spectrum);
  std::optional<Candidate> best;
  for (double f = range.low; f <= range.high; f *= kGridFactor) {
    const BandPower peak = sums.mean(f / kPeakFactor, f * kPeakFactor);
    const BandPower around = background(sums, f);
    const double ratio = (peak.mean + sums.floor()) / around.mean;
    const double excess = (peak.mean - around.mean) * peak.bins;
    if (!may_win(excess, f_deviate_bound(ratio, peak.freedom, around.freedom), best)) continue;
    const Candidate candidate{{f, hos::f_deviate(ratio, peak.freedom, around.freedom)}, excess};
    if (!best || is_better(candidate, *best)) best = candidate;
  }
  if (!best) return std::nullopt;
  return best->peak;
}

double share_above_background(const RecordSpectrum& spectrum, double frequency, Band band) {
  const PowerSums sums(spectrum);
  const BandPower inside = sums.mean(band.low, band.high);
  if (!(inside.mean > 0.0)) return 0.0;
  return std::clamp(1.0 - background(sums, frequency).mean / inside.mean, 0.0, 1.0);
}

}  // namespace loopscope::core::loop
