#include "core/model/selection/nominate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hos/transforms/record_fft.hpp"
#include "core/model/effects/curvature.hpp"
#include "core/model/effects/exponential_trim.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/effects/square_root_outflow.hpp"
#include "core/model/fit/load_signatures.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

/// Half the way that op travels, > 0.
double reach_of(const LoopData& data) {
  // A rare excursion must not lie so many reaches away that an exponential overflows.
  constexpr double kFarthest = 20.0;
  const auto [low, high] = std::ranges::minmax(data.op);
  const double usual = (quantile(data.op, 0.98) - quantile(data.op, 0.02)) / 2.0;
  const double reach = std::max(usual, (high - low) / (2.0 * kFarthest));
  return reach > 0.0 ? reach : 1.0;
}

std::vector<std::complex<double>> spectrum_of(const std::vector<double>& signal) {
  std::size_t length = 1;
  while (length < 2 * signal.size()) length *= 2;  // twice: lines between the frequencies show too
  return hos::RecordFft::of_length(length).transform(signal);
}

void add_peaks(const std::vector<double>& signal, std::size_t count, std::vector<double>& periods) {
  const auto spectrum = spectrum_of(signal);
  const auto length = static_cast<double>(2 * (spectrum.size() - 1));
  std::vector<double> power(spectrum.size());
  std::transform(spectrum.begin(), spectrum.end(), power.begin(),
                 [](const auto& x) { return std::norm(x); });
  // At least four cycles in the record, at least three samples a cycle.
  const auto first = static_cast<std::size_t>(4.0 * length / static_cast<double>(signal.size()));
  for (std::size_t found = 0; found < count; ++found) {
    const auto peak = std::max_element(power.begin() + static_cast<long>(first),
                                       power.begin() + static_cast<long>(length / 3.0));
    const auto at = static_cast<std::size_t>(peak - power.begin());
    if (*peak <= 0.0 || at + 1 >= power.size()) return;
    // The vertex of the parabola through the peak.
    const double left = power[at - 1], middle = power[at], right = power[at + 1];
    const double bend = left - 2.0 * middle + right;
    const double shift = bend == 0.0 ? 0.0 : std::clamp(0.5 * (left - right) / bend, -0.5, 0.5);
    periods.push_back(length / (static_cast<double>(at) + shift));
    for (std::size_t k = at > 6 ? at - 6 : 0; k < std::min(power.size(), at + 7); ++k)
      power[k] = 0.0;
  }
}

/// What happened before the record, of which the model knows nothing, is in pv until the lags have
/// forgotten it to a twentieth, three time constants: a load at the start looks the same. At most
/// an eighth of the record; what a vessel never forgets is a level like any other.
std::size_t rows_under_the_past(const LoopData& data, const Fit& fit) {
  constexpr double kMostOfRecord = 0.125;
  const ProcessShape& process = fit.structure.process;
  auto samples = static_cast<double>(LoadStep::kEarliest + process.delay_samples);
  for (const double pole : {process.integrating ? 0.0 : process.pole, process.second_pole}) {
    if (pole > 0.0) samples += 3.0 / -std::log(pole);
  }
  const double rows = samples / static_cast<double>(data.grid.samples_per_row);
  return static_cast<std::size_t>(
      std::min(rows, kMostOfRecord * static_cast<double>(fit.innovations.size())));
}

std::vector<EffectPtr> waves_asked_for(const std::vector<Nomination>& asked, const LoopData& data) {
  const auto samples_per_row = static_cast<double>(data.grid.samples_per_row);
  std::vector<EffectPtr> result;
  for (const Nomination& nomination : asked) {
    if (nomination.period_samples)
      result.push_back(
          std::make_shared<ExternalOscillation>(samples_per_row * *nomination.period_samples));
  }
  return result;
}

}  // namespace

std::vector<EffectPtr> nominate_trims(const LoopData& data) {
  std::vector<EffectPtr> result;
  if (!data.without.keeps(Mechanism::exponential_trim)) return result;
  for (const double growth : {-0.4, 0.4}) {
    result.push_back(std::make_shared<ExponentialTrim>(growth, reach_of(data)));
  }
  return result;
}

std::vector<EffectPtr> nominate_static(EffectKind kind, const LoopData& data) {
  std::vector<EffectPtr> result;
  if (kind == EffectKind::valve_saturation) {
    for (const double share : {0.03, 0.08, 0.15, 0.25, 0.4, 0.55}) {
      result.push_back(std::make_shared<Saturation>(quantile(data.op, share), kNone));
      result.push_back(std::make_shared<Saturation>(-kNone, quantile(data.op, 1.0 - share)));
    }
  } else if (kind == EffectKind::valve_characteristic) {
    result = nominate_trims(data);
    result.push_back(std::make_shared<ValveCharacteristic>());
  } else if (kind == EffectKind::process_nonlinearity) {
    result.push_back(std::make_shared<ProcessNonlinearity>());
    if (!data.without.keeps(Mechanism::root_outflow)) return result;
    // A shallow vessel and a deep one; deeper ones are straight.
    for (const double reaches : {1.0, 2.5})
      result.push_back(std::make_shared<SquareRootOutflow>(reaches * reach_of(data)));
  }
  return result;
}

std::vector<EffectPtr> nominate(EffectKind kind, const LoopData& data, const Fit& fit,
                                const std::vector<Nomination>& asked) {
  std::vector<EffectPtr> result;
  if (kind == EffectKind::gain_change)
    result = nominate_gain_changes(data, fit);
  else if (kind == EffectKind::load_step)
    result = nominate_load_steps(data, fit);
  else if (kind == EffectKind::external_oscillation)
    result = asked.empty() ? nominate_oscillations(data, fit) : waves_asked_for(asked, data);
  else
    result = nominate_static(kind, data);
  return result;
}

std::vector<EffectPtr> nominate_gain_changes(const LoopData& data, const Fit& fit) {
  constexpr std::size_t kPlaces = 24;
  std::vector<EffectPtr> result;
  const std::size_t n = data.samples();
  for (std::size_t i = 3; i + 2 < kPlaces; ++i) {
    result.push_back(std::make_shared<GainChange>(i * n / kPlaces, i * n / kPlaces));
  }
  result.push_back(std::make_shared<GainChange>(0, n));
  result.push_back(std::make_shared<GainChange>(n / 4, 3 * n / 4));
  for (const LoadSignature& mark : {input_load_signature(fit.structure, data.grid),
                                    output_load_signature(fit.structure.noise, data.grid)}) {
    for (const std::size_t row : places_of(mark, fit.innovations, data.grid)) {
      const std::size_t at = data.grid.sample_of(row);
      if (at >= GainChange::kEarliest) result.push_back(std::make_shared<GainChange>(at, at));
    }
  }
  return result;
}

std::vector<EffectPtr> nominate_load_steps(const LoopData& data, const Fit& fit) {
  const LoadSignature mark = output_load_signature(fit.structure.noise, data.grid);
  std::vector<EffectPtr> result;
  const std::size_t earliest = rows_under_the_past(data, fit);
  for (const std::size_t row : places_of(mark, fit.innovations, data.grid, earliest)) {
    result.push_back(
        std::make_shared<LoadStep>(data.grid.sample_of(row), data.grid.samples_per_row));
  }
  return result;
}

std::vector<EffectPtr> nominate_oscillations(const LoopData& data, const Fit& fit) {
  std::vector<double> periods;
  add_peaks(fit.innovations, 2, periods);
  add_peaks(data.pv, 2, periods);
  const auto samples_per_row = static_cast<double>(data.grid.samples_per_row);
  std::vector<EffectPtr> result;
  result.reserve(periods.size());
  for (const double period : periods)
    result.push_back(std::make_shared<ExternalOscillation>(samples_per_row * period));
  return result;
}

}  // namespace loopscope::core::model
