#include "core/model/limit_cycle/half_cycles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace loopscope::core::model {
namespace {

/// Points of a half cycle: nine to a cycle of the seventh harmonic.
constexpr std::size_t kPoints = 32;
constexpr std::size_t kFewestHalves = 4;
constexpr double kShortestHalf = 3.0;
using HalfCycle = std::array<double, kPoints>;

HalfCycle draw(std::span<const double> signal, double from, double length) {
  HalfCycle drawn;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double place = from + (static_cast<double>(i) + 0.5) / kPoints * length;
    const std::size_t before = std::min(static_cast<std::size_t>(place), signal.size() - 2);
    const double share = place - static_cast<double>(before);
    drawn[i] = signal[before] + share * (signal[before + 1] - signal[before]);
  }
  return drawn;
}

double square(const HalfCycle& wave) {
  double sum = 0.0;
  for (const double value : wave) sum += value * value;
  return sum;
}

/// Harmonic of the wave that goes on with its own negative.
std::complex<double> harmonic(const HalfCycle& wave, double order) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / kPoints;
    sum += wave[i] * std::polar(1.0, -order * angle);
  }
  return sum;
}

double third_harmonic_of(const HalfCycle& wave) {
  const std::complex<double> first = harmonic(wave, 1.0);
  const double size = std::norm(first);
  if (!(size > 0.0)) return 0.0;
  const std::complex<double> back = std::conj(first);
  return -(harmonic(wave, 3.0) * back * back * back).real() / (size * size);
}

/// Sines or triangles with their peaks at one of the points each.
struct Shapes {
  static constexpr std::size_t kFirstPeak = kPoints / 8;
  static constexpr std::size_t kCount = kPoints - 2 * kFirstPeak;
  std::array<std::array<double, kCount>, kPoints> at{};  ///< all shapes at one point
  std::array<double, kCount> size{};                     ///< squares

  template <typename QuarterWave>
  explicit Shapes(QuarterWave quarter_wave) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      for (std::size_t k = 0; k < kCount; ++k) {
        const std::size_t peak = kFirstPeak + k;
        const double rise = static_cast<double>(i + 1) / static_cast<double>(peak + 1);
        const double fall = static_cast<double>(kPoints - i) / static_cast<double>(kPoints - peak);
        at[i][k] = quarter_wave(std::min(rise, fall));
        size[k] += at[i][k] * at[i][k];
      }
    }
  }
};

/// Squares that the best of the shapes leaves.
double misfit(const HalfCycle& wave, const Shapes& shapes) {
  std::array<double, Shapes::kCount> cross{};
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (std::size_t k = 0; k < Shapes::kCount; ++k) cross[k] += shapes.at[i][k] * wave[i];
  }
  double best = 0.0;
  for (std::size_t k = 0; k < Shapes::kCount; ++k)
    best = std::max(best, cross[k] * cross[k] / shapes.size[k]);
  return std::max(0.0, square(wave) - best);
}

}  // namespace

std::vector<double> crossings_of(std::span<const double> signal) {
  constexpr double kGate = 0.15;
  double sum = 0.0;
  for (const double value : signal) sum += value * value;
  const double gate = kGate * std::sqrt(sum / static_cast<double>(signal.size()));
  std::vector<double> crossings;
  double last = 0.0;
  int side = 0;
  for (std::size_t k = 1; k < signal.size(); ++k) {
    if ((signal[k - 1] < 0.0) != (signal[k] < 0.0)) {
      last = static_cast<double>(k - 1) + signal[k - 1] / (signal[k - 1] - signal[k]);
    }
    const int now = signal[k] > gate ? 1 : signal[k] < -gate ? -1 : 0;
    if (now == 0 || now == side) continue;
    if (side != 0) crossings.push_back(last);
    side = now;
  }
  return crossings;
}

std::optional<MeanHalfCycle> mean_half_cycle(std::span<const double> signal,
                                             std::span<const OpTurn> turns) {
  HalfCycle mean{};
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const auto from = static_cast<double>(turns[i - 1].sample);
    const double length = static_cast<double>(turns[i].sample) - from;
    if (length < kShortestHalf) continue;
    const HalfCycle drawn = draw(signal, from, length);
    for (std::size_t p = 0; p < kPoints; ++p) mean[p] += turns[i - 1].direction * drawn[p];
    squares += square(drawn);
    ++count;
  }
  if (count < kFewestHalves || !(squares > 0.0)) return std::nullopt;
  const double coherence = square(mean) / (static_cast<double>(count) * squares);
  return MeanHalfCycle{coherence, third_harmonic_of(mean)};
}

std::optional<double> triangle_share(std::span<const double> signal, double period) {
  static const Shapes sines([](double x) { return std::sin(0.5 * std::numbers::pi * x); });
  static const Shapes triangles([](double x) { return x; });
  if (signal.size() < 2) return std::nullopt;
  const std::vector<double> crossings = crossings_of(signal);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const double length = crossings[i] - crossings[i - 1];
    if (length < 0.2 * period || length > period) continue;
    const HalfCycle wave = draw(signal, crossings[i - 1], length);
    const double sine = misfit(wave, sines);
    const double triangle = misfit(wave, triangles);
    if (!(sine + triangle > 0.0)) continue;
    sum += sine / (sine + triangle);
    ++count;
  }
  if (count < kFewestHalves) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace loopscope::core::model
