#include "tests/plants/network/criteria.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "core/hos/coupling/harmonic_filters.hpp"
#include "core/hos/coupling/harmonic_test.hpp"
#include "core/hos/slow/decimate.hpp"
#include "tests/plants/network/thornhill.hpp"

namespace loopscope::tests::network {
namespace {

using Complex = std::complex<double>;

/// A signal at about twelve samples a cycle.
struct Resampled {
  std::vector<double> values;
  double period = 0.0;
};

Resampled resample(const std::vector<double>& signal, double period) {
  const auto factor = static_cast<std::size_t>(std::max(1.0, period / 12.0));
  return {core::hos::decimate(signal, factor), period / static_cast<double>(factor)};
}

/// Power of the second and third harmonics that are locked to the fundamental, by its power.
double harmonic_content(const std::vector<double>& signal, double period) {
  const Resampled cycle = resample(signal, period);
  if (cycle.period < 8.0) return 0.0;
  const auto found = core::hos::HarmonicFilters(cycle.period).apply(cycle.values).harmonics;
  Complex second = 0.0, third = 0.0;
  double power = 0.0;
  for (std::size_t k = 0; k < found[0].size(); ++k) {
    const Complex turn = found[0][k] / std::max(std::abs(found[0][k]), 1e-300);
    second += found[1][k] * std::conj(turn * turn);
    third += found[2][k] * std::conj(turn * turn * turn);
    power += std::norm(found[0][k]);
  }
  const auto count = static_cast<double>(found[0].size());
  return power > 0.0 ? (std::norm(second) + std::norm(third)) / count / power : 0.0;
}

double coupling_evidence(const std::vector<double>& signal, double period) {
  const Resampled cycle = resample(signal, period);
  if (cycle.period < 8.0) return 0.0;
  const auto found = core::hos::harmonic_statistics(cycle.values, cycle.period);
  return found ? found->cubic_evidence : 0.0;
}

double in_decades(std::optional<double> p) {
  return -std::log10(std::max(p.value_or(1.0), 1e-300));
}

}  // namespace

const std::vector<std::string>& criterion_names() {
  static const std::vector<std::string> names = {"strength of the oscillation",
                                                 "phase lead",
                                                 "Thornhill's index N",
                                                 "harmonic content of the error",
                                                 "harmonic content of op",
                                                 "NGI (sum of squared bicoherence)",
                                                 "calibrated nonlinear_p",
                                                 "calibrated cubic_p",
                                                 "cubic coupling at the event's period",
                                                 "probability that the valve sticks or has play",
                                                 "net lead with all others known",
                                                 "error explained by a valve",
                                                 "net lead (Granger)",
                                                 "share of op's variance in the line",
                                                 "height of the line above the noise"};
  return names;
}

Criteria measure_criteria(const DiagnosedLoop& loop, double period_s,
                          const core::plant::SharingLoop& member,
                          const core::plant::SourceEvidence& evidence) {
  const double period = period_s / loop.interval_s;
  return {member.strength,
          -member.lag_s,
          thornhill_index(loop.error, period),
          harmonic_content(loop.error, period),
          harmonic_content(loop.op, period),
          loop.ngi,
          in_decades(loop.nonlinear_p),
          in_decades(loop.cubic_p),
          coupling_evidence(loop.error, period),
          evidence.friction_p,
          evidence.direct_lead,
          loop.valve_explained,
          evidence.net_lead,
          evidence.op_share,
          evidence.line_height};
}

}  // namespace loopscope::tests::network
