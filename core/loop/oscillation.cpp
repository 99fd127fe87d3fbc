#include "core/loop/oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/loop/correlation.hpp"
#include "core/loop/if_finite.hpp"
#include "core/loop/oscillation_p.hpp"
#include "core/loop/record_spectrum.hpp"
#include "core/loop/spectral_peak.hpp"
#include "core/loop/zero_crossings.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {
namespace {

/// Thornhill, Huang and Zhang read the first eleven crossings: later ones sink into the noise of
/// the autocorrelation.
constexpr std::size_t kCrossings = 11;
/// Four intervals are the fewest whose spread says anything.
constexpr std::size_t kFewestCrossings = 5;
/// Intervals that agree to a third of a percent: beyond this, differences are those of the
/// interpolation.
constexpr double kMaxRegularity = 100.0;
/// The band kept around the peak, an octave to each side: wide enough that filtered noise still
/// crosses zero irregularly, narrow enough for drift and sampling noise to go.
constexpr double kBandFactor = 2.0;
/// Shortest record, in samples, worth a spectrum.
constexpr double kFewestSamples = 32.0;
/// Standard deviations of noise that the first peak of the autocorrelation has to exceed.
constexpr double kPeakSignificance = 2.0;
/// A response that keeps less than a quarter of itself over one period is the classic well-tuned
/// loop (quarter decay), not an oscillation.
constexpr double kQuarterDecay = 0.25;
/// Persistence compares the first peak of the autocorrelation with the fourth.
constexpr int kPersistencePeriods = 4;

struct Intervals {
  double mean = 0.0;  // samples
  double std = 0.0;
};

std::optional<Intervals> measure_intervals(const std::vector<double>& acf) {
  std::vector<double> crossings = find_zero_crossings(acf);
  if (crossings.size() < kFewestCrossings) return std::nullopt;
  crossings.resize(std::min(crossings.size(), kCrossings));
  const auto count = static_cast<double>(crossings.size() - 1);
  const double mean = (crossings.back() - crossings.front()) / count;
  double squares = 0.0;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const double deviation = crossings[i] - crossings[i - 1] - mean;
    squares += deviation * deviation;
  }
  return Intervals{mean, std::sqrt(squares / (count - 1.0))};
}

double regularity_of(const Intervals& intervals) {
  const double largest_ratio = 3.0 * kMaxRegularity;
  if (intervals.mean >= largest_ratio * intervals.std) return kMaxRegularity;
  return intervals.mean / (3.0 * intervals.std);
}

/// Highest value within half a period of `periods` periods; nullopt beyond the last lag.
std::optional<double> peak_after(const std::vector<double>& acf, double period, double periods) {
  const auto first = static_cast<std::size_t>((periods - 0.5) * period);
  const auto last = static_cast<std::size_t>((periods + 0.5) * period);
  if (static_cast<std::size_t>(periods * period) >= acf.size()) return std::nullopt;
  return *std::max_element(acf.begin() + static_cast<std::ptrdiff_t>(first),
                           acf.begin() + static_cast<std::ptrdiff_t>(std::min(last, acf.size())));
}

/// Noise of the pass band (bandwidth 1.5 / period) has an autocorrelation with standard deviation
/// 1 / sqrt(2 * 1.5 * cycles) away from lag 0 (Bartlett).
double band_noise(double cycles) {
  const double bandwidth_periods = kBandFactor - 1.0 / kBandFactor;
  return 1.0 / std::sqrt(2.0 * bandwidth_periods * cycles);
}

bool comes_back(double peak, double cycles) {
  return peak > std::max(kQuarterDecay, kPeakSignificance * band_noise(cycles));
}

/// Where the lags hold fewer than four periods, the decay per period that they show is carried on.
std::optional<double> persistence_of(const std::vector<double>& acf, double period) {
  const auto held = static_cast<int>(static_cast<double>(acf.size() - 1) / period);
  const int periods = std::min(held, kPersistencePeriods);
  if (periods < 2) return std::nullopt;
  const double first = peak_after(acf, period, 1.0).value_or(0.0);
  const double later = peak_after(acf, period, periods).value_or(0.0);
  if (!(first > 0.0)) return std::nullopt;
  const double ratio = std::clamp(later / first, 0.0, 1.0);
  return std::pow(ratio, (kPersistencePeriods - 1.0) / (periods - 1.0));
}

/// What the band around a spectral peak shows.
struct BandEvidence {
  double prominence = 0.0;
  double share = 0.0;  // of the band's power above the background
  double component_std = 0.0;
  std::vector<double> acf;
  Intervals intervals;
};

std::optional<BandEvidence> gather_evidence(std::span<const double> signal,
                                            const signal::Spread& spread, Band range) {
  RealTransform transform(transform_length(signal.size()));
  RecordSpectrum spectrum(signal, spread, transform);
  const std::optional<SpectralPeak> peak = find_spectral_peak(spectrum, range);
  if (!peak) return std::nullopt;
  const Band band{peak->frequency / kBandFactor, peak->frequency * kBandFactor};
  const auto quarter_period = static_cast<std::size_t>(0.25 / peak->frequency);
  const signal::Samples component = spectrum.component(band, quarter_period);
  std::vector<double> acf = autocorrelate(component, signal.size() / 2, transform);
  const std::optional<Intervals> intervals = measure_intervals(acf);
  if (!intervals) return std::nullopt;
  return BandEvidence{peak->prominence, share_above_background(spectrum, peak->frequency, band),
                      signal::measure_spread(component)->std, std::move(acf), *intervals};
}

double first_return(const BandEvidence& evidence) {
  return peak_after(evidence.acf, 2.0 * evidence.intervals.mean, 1.0).value_or(0.0);
}

bool is_present(const BandEvidence& evidence, double cycles, const OscillationSettings& settings) {
  const double half_period = evidence.intervals.mean;
  return evidence.prominence >= kClearProminence &&
         regularity_of(evidence.intervals) > settings.min_regularity &&
         half_period >= settings.min_half_period_samples && cycles >= settings.min_cycles &&
         comes_back(first_return(evidence), cycles);
}

/// How far the record comes back beyond the decay of a well-tuned loop, in standard deviations of
/// band noise. A product of the autocorrelation needs both its samples, so that gaps count twice.
double return_deviate(const BandEvidence& evidence, double cycles, double recorded_share) {
  return (first_return(evidence) - kQuarterDecay) / band_noise(cycles * recorded_share);
}

}  // namespace

Oscillation find_oscillation(std::span<const double> signal, double sample_interval_s,
                             const OscillationSettings& settings) {
  const auto recorded = static_cast<double>(
      std::count_if(signal.begin(), signal.end(), [](double v) { return std::isfinite(v); }));
  const std::optional<signal::Spread> spread = signal::measure_spread(signal);
  if (recorded < kFewestSamples || spread->constant()) return {};

  const Band range{settings.min_cycles / recorded, 0.5 / settings.min_half_period_samples};
  const std::optional<BandEvidence> evidence = gather_evidence(signal, *spread, range);
  Oscillation result;
  result.p = 1.0;
  if (!evidence) return result;

  const double period = 2.0 * evidence->intervals.mean;
  result.period_s = if_finite(period * sample_interval_s);
  result.regularity = if_finite(regularity_of(evidence->intervals));
  result.amplitude = if_finite(evidence->component_std * std::sqrt(2.0 * evidence->share));
  result.persistence = persistence_of(evidence->acf, period);
  result.present = is_present(*evidence, recorded / period, settings);
  if (result.present) {
    const double share = recorded / static_cast<double>(signal.size());
    result.p = oscillation_p(oscillation_strength(
        evidence->prominence, return_deviate(*evidence, recorded / period, share)));
  }
  return result;
}

}  // namespace loopscope::core::loop
