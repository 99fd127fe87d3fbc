#include "core/model/residual_tests/statistics/spectral_lines.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/hos/transforms/record_fft.hpp"
#include "core/model/residual_tests/statistics/centred.hpp"
#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "core/signal/gaps.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kFewestCyclesOfALine = 6.0;
/// The bands of noise beside a line, in cycles per record: they begin outside the window's main
/// lobe and are at most so wide, and half the frequency, where the spectrum bends most.
constexpr double kGap = 2.0;
constexpr double kWidestBand = 24.0;
/// A loop near the edge of stability has a peak of several cycles: what does not stand out of its
/// nearest neighbours as well is no line.
constexpr double kNearBand = 4.0;
/// Independent frequencies over cycles per record: the peaks between the grid count too.
constexpr double kIndependent = 0.6;
/// The mean logarithm of an exponential variable of mean 1 is -0.5772, its variance pi^2 / 6; the
/// window correlates neighbours, which leaves 1 / 1.9 of them.
constexpr double kMeanLog = -std::numbers::egamma;
constexpr double kLogVariance = 1.9 * std::numbers::pi * std::numbers::pi / 6.0;

/// A drifting signal that misses samples at a regular pace would show the pace as a line: gaps of
/// up to so many samples are bridged.
constexpr std::size_t kLongestBridge = 20;

struct Tapered {
  std::vector<double> power;    ///< per bin
  std::vector<double> before;   ///< sum of the logarithms of the bins before
  double bins_per_cycle = 1.0;  ///< bins for each cycle per record
  double gain = 1.0;            ///< sum of the window over the recorded samples
};

void remove_line(Centred& signal, std::span<const double> recorded) {
  double weight = 0.0, time = 0.0, square = 0.0, product = 0.0;
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    const auto t = static_cast<double>(k);
    weight += recorded[k];
    time += recorded[k] * t;
    square += recorded[k] * t * t;
    product += signal.values[k] * t;
  }
  const double slope = product / (square - time * time / weight);
  for (std::size_t k = 0; k < recorded.size(); ++k)
    signal.values[k] -= recorded[k] * slope * (static_cast<double>(k) - time / weight);
}

Tapered taper(Centred signal, std::span<const double> recorded) {
  remove_line(signal, recorded);
  Tapered result;
  const std::size_t size = signal.values.size();
  result.gain = 0.0;
  for (std::size_t k = 0; k < size; ++k) {
    const double phase =
        2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(size);
    const double window = 0.5 - 0.5 * std::cos(phase);
    signal.values[k] *= window;
    result.gain += recorded[k] * window;
  }
  const std::size_t length = 2 * std::bit_ceil(size);
  result.bins_per_cycle = static_cast<double>(length) / static_cast<double>(size);
  result.before = {0.0};
  for (const auto& bin : hos::RecordFft::of_length(length).transform(std::move(signal.values))) {
    // Rounding noise where there is no power at all.
    result.power.push_back(std::norm(bin) + 1e-28 * result.gain * result.gain);
    result.before.push_back(result.before.back() + std::log(result.power.back()));
  }
  return result;
}

struct Noise {
  double power = 0.0;
  double shape = 0.0;  ///< of the gamma law of its reciprocal
};

/// A band of whole bins [first, last).
struct Bins {
  std::ptrdiff_t first = 0;
  std::ptrdiff_t last = 0;
  [[nodiscard]] std::ptrdiff_t count() const { return std::max<std::ptrdiff_t>(0, last - first); }
};

double mean_log(const Tapered& spectrum, Bins bins) {
  return (spectrum.before[static_cast<std::size_t>(bins.last)] -
          spectrum.before[static_cast<std::size_t>(bins.first)]) /
         static_cast<double>(bins.count());
}

Noise noise_within(const Tapered& spectrum, std::size_t bin, double widest) {
  const auto size = static_cast<std::ptrdiff_t>(spectrum.power.size());
  const auto at = static_cast<std::ptrdiff_t>(bin);
  const double cycles = static_cast<double>(bin) / spectrum.bins_per_cycle;
  const double width = std::min(widest, 0.5 * cycles);
  const auto gap = static_cast<std::ptrdiff_t>(kGap * spectrum.bins_per_cycle);
  const auto reach = gap + static_cast<std::ptrdiff_t>(width * spectrum.bins_per_cycle);
  const Bins below{at - reach, at - gap};
  const Bins above{std::min(size, at + gap + 1), std::min(size, at + reach + 1)};
  // Near the highest frequency the spectrum is flat: one side will do.
  const bool both = 2 * above.count() > below.count();
  const double level = both ? 0.5 * (mean_log(spectrum, below) + mean_log(spectrum, above))
                            : mean_log(spectrum, below);
  const double cells =
      static_cast<double>(below.count() + (both ? above.count() : 0)) / spectrum.bins_per_cycle;
  return {std::exp(level - kMeanLog), std::max(1.0, cells / kLogVariance)};
}

/// The higher of two levels, of the wide band and of the near one.
Noise noise_beside(const Tapered& spectrum, std::size_t bin) {
  Noise noise = noise_within(spectrum, bin, kWidestBand);
  noise.power = std::max(noise.power, noise_within(spectrum, bin, kNearBand).power);
  return noise;
}

/// Share of a line's power that the window leaves `cycles` beside it, from above.
double leakage(double cycles) {
  const double d = std::abs(cycles);
  if (d < kGap) return 1.0;
  const double amplitude = 1.0 / (std::numbers::pi * d * (d * d - 1.0));
  return amplitude * amplitude;
}

struct Found {
  std::size_t bin = 0;
  double power = 0.0;
  double p = 1.0;
};

double leaked(const std::vector<Found>& stronger, const Tapered& spectrum, std::size_t bin) {
  double power = 0.0;
  for (const Found& line : stronger)
    power += line.power * leakage((static_cast<double>(bin) - static_cast<double>(line.bin)) /
                                  spectrum.bins_per_cycle);
  return power;
}

/// Below this ratio of power to noise no bin is worth its p: one in five of noise exceeds it.
constexpr double kWorthwhile = 1.5;

/// p that noise alone has this power, its level being known from so many cells; the
/// gamma-exponential mixture is Lomax's law.
double p_at(const Tapered& spectrum, std::size_t bin, const std::vector<Found>& stronger) {
  const Noise noise = noise_beside(spectrum, bin);
  if (spectrum.power[bin] < kWorthwhile * noise.power) return 1.0;
  const double ratio = spectrum.power[bin] / (noise.power + 2.0 * leaked(stronger, spectrum, bin));
  return std::pow(1.0 + ratio / noise.shape, -noise.shape);
}

Found strongest(const Tapered& spectrum, const std::vector<Found>& stronger) {
  Found found;
  const auto first =
      static_cast<std::size_t>(std::ceil(kFewestCyclesOfALine * spectrum.bins_per_cycle));
  for (std::size_t bin = first; bin + 1 < spectrum.power.size(); ++bin) {
    const double power = spectrum.power[bin];
    if (power < spectrum.power[bin - 1] || power < spectrum.power[bin + 1]) continue;
    const double p = p_at(spectrum, bin, stronger);
    if (p < found.p) found = {bin, power, p};
  }
  const double cells =
      kIndependent * static_cast<double>(spectrum.power.size() - first) / spectrum.bins_per_cycle;
  found.p = std::clamp(-std::expm1(cells * std::log1p(-found.p)), 1e-300, 1.0);
  return found;
}

SpectralLine line_of(const Found& found, const Tapered& spectrum, double unit) {
  const double left = std::log(spectrum.power[found.bin - 1]);
  const double middle = std::log(spectrum.power[found.bin]);
  const double right = std::log(spectrum.power[found.bin + 1]);
  const double bend = left - 2.0 * middle + right;
  const double offset = bend < 0.0 ? 0.5 * (left - right) / bend : 0.0;
  const double length = 2.0 * static_cast<double>(spectrum.power.size() - 1);
  return {found.p, length / (static_cast<double>(found.bin) + offset),
          2.0 * unit * std::sqrt(found.power) / spectrum.gain};
}

}  // namespace

LineSearch find_lines(std::span<const double> signal) {
  signal::Samples bridged(signal.begin(), signal.end());
  signal::discard_infinite(bridged);
  signal::bridge_gaps(bridged, kLongestBridge);
  const std::optional<Centred> about = centred(bridged, kFewestAsked);
  if (!about) return {};
  std::vector<double> recorded(bridged.size());
  std::transform(bridged.begin(), bridged.end(), recorded.begin(),
                 [](double value) { return std::isfinite(value) ? 1.0 : 0.0; });
  const Tapered spectrum = taper(*about, recorded);
  LineSearch result;
  std::vector<Found> found;
  while (found.size() < kMostLines) {
    const Found next = strongest(spectrum, found);
    if (found.empty()) result.p = next.p;
    if (next.p > kSignificant) break;
    found.push_back(next);
    result.lines.push_back(line_of(next, spectrum, about->std));
  }
  return result;
}

}  // namespace loopscope::core::model
