#include "core/hos/slow/decimate.hpp"

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace loopscope::core::hos {
namespace {

/// Cut-off in cycles per kept sample: the middle between the passband's end and 0.5.
constexpr double kCutOff = 0.5 * (kDecimationPassband + 0.5);
/// Kaiser's formulas for 65 dB, 5 dB to spare: beta = 0.1102 (A - 8.7), and (A - 7.95) / 14.36 =
/// 3.97 for the product of support (24 kept samples) and transition (1/6).
constexpr double kKaiserBeta = 0.1102 * (65.0 - 8.7);
/// What may be missing of a kept sample's absolute weights: the error that this leaves is about a
/// twentieth of the signal's swing within two cycles.
constexpr double kMissingShare = 0.05;

using Vector = Eigen::VectorXd;

double sinc(double x) {
  const double turn = std::numbers::pi * x;
  return x == 0.0 ? 1.0 : std::sin(turn) / turn;
}

struct LowPass {
  explicit LowPass(std::size_t factor);
  Vector weights;  ///< sum 1
  Vector shares;   ///< their magnitudes, sum 1
};

LowPass::LowPass(std::size_t factor) {
  const auto half = static_cast<Eigen::Index>(kDecimationHalfSupport * factor);
  weights.resize(2 * half + 1);
  for (Eigen::Index n = -half; n <= half; ++n) {
    const double place = static_cast<double>(n) / static_cast<double>(half);
    const double taper = std::cyl_bessel_i(0.0, kKaiserBeta * std::sqrt(1.0 - place * place));
    const double kept = static_cast<double>(n) / static_cast<double>(factor);
    weights[n + half] = taper * sinc(2.0 * kCutOff * kept);
  }
  weights /= weights.sum();
  shares = weights.cwiseAbs() / weights.cwiseAbs().sum();
}

/// The signal with zeros for what is missing, and ones there.
struct Masked {
  explicit Masked(std::span<const double> signal);
  Vector recorded;
  Vector missing;
};

Masked::Masked(std::span<const double> signal)
    : recorded(Vector::Zero(static_cast<Eigen::Index>(signal.size()))),
      missing(Vector::Zero(recorded.size())) {
  for (Eigen::Index k = 0; k < recorded.size(); ++k) {
    const double value = signal[static_cast<std::size_t>(k)];
    const bool finite = std::isfinite(value);
    (finite ? recorded : missing)[k] = finite ? value : 1.0;
  }
}

/// The weighted mean of what was recorded from `first` on; missing when too little was.
double kept_sample(const Masked& signal, const LowPass& filter, Eigen::Index first) {
  const Eigen::Index support = filter.weights.size();
  const auto missing = signal.missing.segment(first, support);
  const double sum = filter.weights.dot(signal.recorded.segment(first, support));
  const double share = filter.shares.dot(missing);
  if (share > kMissingShare) return std::numeric_limits<double>::quiet_NaN();
  return share > 0.0 ? sum / (1.0 - filter.weights.dot(missing)) : sum;
}

}  // namespace

std::vector<double> decimate(std::span<const double> signal, std::size_t factor) {
  if (factor == 0) throw std::invalid_argument("decimate: the factor is 0");
  if (factor == 1) return {signal.begin(), signal.end()};
  const std::size_t support = 2 * kDecimationHalfSupport * factor + 1;
  std::vector<double> kept;
  if (signal.size() < support) return kept;
  const LowPass filter(factor);
  const Masked masked(signal);
  kept.reserve((signal.size() - support) / factor + 1);
  for (std::size_t first = 0; first + support <= signal.size(); first += factor) {
    kept.push_back(kept_sample(masked, filter, static_cast<Eigen::Index>(first)));
  }
  return kept;
}

}  // namespace loopscope::core::hos
