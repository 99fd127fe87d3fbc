#include "core/model/effects/external_oscillation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

using Phasor = std::complex<double>;

/// A line in a few thousand samples is a few tenths of a cycle over the record wide.
constexpr double kRecord = 4096.0;

/// Fewer over such a record are a drift, which belongs to the noise.
constexpr double kFewestCycles = 4.0;

struct Wave {
  Column sine, cosine;
};

/// Samples side by side: each waits for the one so many before it only.
constexpr std::size_t kTogether = 4;

Wave wave_of(double period, std::size_t samples) {
  const double turn = 2.0 * std::numbers::pi / period;
  const Phasor turns = std::polar(1.0, static_cast<double>(kTogether) * turn);
  std::array<double, kTogether> sine{}, cosine{};
  for (std::size_t i = 0; i < kTogether; ++i) {
    sine[i] = std::sin(static_cast<double>(i) * turn);
    cosine[i] = std::cos(static_cast<double>(i) * turn);
  }
  Wave wave{Column(samples), Column(samples)};
  for (std::size_t k = 0; k < samples; k += kTogether) {
    const std::size_t count = std::min(kTogether, samples - k);
    std::copy_n(sine.begin(), count, wave.sine.begin() + static_cast<std::ptrdiff_t>(k));
    std::copy_n(cosine.begin(), count, wave.cosine.begin() + static_cast<std::ptrdiff_t>(k));
    for (std::size_t i = 0; i < kTogether; ++i) {
      const double before = cosine[i];
      cosine[i] = before * turns.real() - sine[i] * turns.imag();
      sine[i] = before * turns.imag() + sine[i] * turns.real();
    }
  }
  return wave;
}

/// Under the hat of a knot: 1 at the knot, 0 at its neighbours.
Column under_hat(const Column& wave, std::size_t knot, std::size_t stretches) {
  Column result(wave.size(), 0.0);
  const double length = static_cast<double>(wave.size()) / static_cast<double>(stretches);
  const double middle = static_cast<double>(knot) * length;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(middle - length)));
  const auto end = std::min(wave.size(), static_cast<std::size_t>(std::ceil(middle + length)));
  for (std::size_t k = first; k < end; ++k) {
    result[k] = wave[k] * (1.0 - std::abs(static_cast<double>(k) - middle) / length);
  }
  return result;
}

/// Of the fundamental at its knots: its value at sample k is the real part of
/// phasor exp(i 2 pi k / period).
std::vector<Phasor> phasors_of(std::span<const double> coefficients, std::size_t knots) {
  std::vector<Phasor> phasors;
  for (std::size_t i = 0; i < knots; ++i) {
    phasors.emplace_back(coefficients[2 * i + 1], -coefficients[2 * i]);
  }
  return phasors;
}

/// Root of the mean square of the modulus along the straight lines between the knots.
double mean_amplitude(const std::vector<Phasor>& phasors) {
  if (phasors.size() == 1) return std::abs(phasors.front());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < phasors.size(); ++i) {
    const Phasor a = phasors[i], b = phasors[i + 1];
    sum += (std::norm(a) + std::norm(b) + std::real(a * std::conj(b))) / 3.0;
  }
  return std::sqrt(sum / static_cast<double>(phasors.size() - 1));
}

/// Radians from the first knot to the last.
double turned(const std::vector<Phasor>& phasors) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < phasors.size(); ++i) {
    sum += std::arg(phasors[i + 1] * std::conj(phasors[i]));
  }
  return sum;
}

}  // namespace

void ExternalOscillation::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  const std::size_t n = signals.flow.size();
  for (std::size_t harmonic = 1; harmonic <= harmonics_; ++harmonic) {
    Wave wave = wave_of(period_ / static_cast<double>(harmonic), n);
    for (std::size_t knot = 0; stretches_ > 0 && knot <= stretches_; ++knot) {
      columns.push_back(under_hat(wave.sine, knot, stretches_));
      columns.push_back(under_hat(wave.cosine, knot, stretches_));
    }
    if (stretches_ > 0) continue;
    columns.push_back(std::move(wave.sine));
    columns.push_back(std::move(wave.cosine));
  }
}

std::vector<EffectPtr> ExternalOscillation::neighbours(double scale) const {
  constexpr double kMove = 0.3;  // cycles over the record
  std::vector<EffectPtr> result;
  for (const double move : {-kMove * scale / kRecord, kMove * scale / kRecord}) {
    const double cycles = kRecord / period_ + move * kRecord;
    if (cycles < kFewestCycles && move < 0.0) continue;
    result.push_back(
        std::make_shared<ExternalOscillation>(kRecord / cycles, harmonics_, stretches_));
  }
  return result;
}

std::vector<EffectPtr> ExternalOscillation::with_knots(std::size_t samples,
                                                       std::size_t samples_per_row) const {
  // A stretch is seen by fit and score alike, whose blocks take turns.
  const double shortest = 100.0 * static_cast<double>(samples_per_row);
  std::vector<EffectPtr> result{std::make_shared<ExternalOscillation>(period_, harmonics_)};
  for (const std::size_t stretches : {4U, 8U, 16U, 32U}) {
    const double length = static_cast<double>(samples) / static_cast<double>(stretches);
    if (length < std::max(shortest, kFewestCycles * period_)) break;
    result.push_back(std::make_shared<ExternalOscillation>(period_, harmonics_, stretches));
  }
  return result;
}

std::vector<EffectPtr> ExternalOscillation::with_harmonics() const {
  constexpr std::size_t kMostHarmonics = 3;
  std::vector<EffectPtr> result;
  for (std::size_t multiple = 1; multiple <= kMostHarmonics; ++multiple) {
    if (multiple > 1 && kRecord < kFewestCycles * period_ * static_cast<double>(multiple)) break;
    for (std::size_t harmonics = multiple; harmonics <= kMostHarmonics; ++harmonics) {
      result.push_back(std::make_shared<ExternalOscillation>(
          period_ * static_cast<double>(multiple), harmonics, stretches_));
    }
  }
  return result;
}

std::vector<Parameter> ExternalOscillation::parameters(const LoopData& data,
                                                       std::span<const double> coefficients,
                                                       double) const {
  const std::vector<Phasor> phasors = phasors_of(coefficients, stretches_ + 1);
  const double cycles =
      static_cast<double>(data.samples()) / period_ + turned(phasors) / (2.0 * std::numbers::pi);
  const double period = stretches_ == 0 ? period_ : static_cast<double>(data.samples()) / cycles;
  return {{"period_s", "s", period * data.sample_interval_s, {}, {}},
          {"amplitude", "pv", mean_amplitude(phasors) * data.pv_scale, {}, {}}};
}

std::string ExternalOscillation::words(std::span<const Parameter> parameters) const {
  const std::string harmonics = harmonics_ > 1 ? " and with harmonics" : "";
  const std::string changes = stretches_ > 0 ? ", slowly changing," : "";
  return "An oscillation of period " + text::duration(parameters[0].value) + harmonics + changes +
         " reaches the loop from outside, amplitude " + text::units_of_pv(parameters[1].value) +
         ".";
}

}  // namespace loopscope::core::model
