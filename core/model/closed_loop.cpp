#include "core/model/closed_loop.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace loopscope::core::model {
namespace {

using Complex = std::complex<double>;

/// Eigenvalues of larger matrices cost more than the rest of the analysis (cubic in the delay).
constexpr std::size_t kMostDelay = 25;
/// Poles this close to the unit circle are on it: rounding moves them by about so much.
constexpr double kOnCircle = 1e-7;
/// Frequencies of the sensitivity from kLowest pi to pi, evenly in their logarithm: 4 % apart, so
/// that a peak of damping 0.02 is met before it is refined to 1e-5 of its frequency.
constexpr int kFrequencies = 180;
constexpr double kLowest = 1e-3;
constexpr int kRefinements = 20;
/// An integral time below this share of a sample cannot be told from pure integral action, and 0
/// would read as none.
constexpr double kShortestIntegralTime = 0.01;

Polynomial delayed(const Polynomial& polynomial, std::size_t samples) {
  Polynomial result(samples, 0.0);
  result.insert(result.end(), polynomial.begin(), polynomial.end());
  return result;
}

/// The controller without its lag: numerator over 1 - z^-1, or over 1 without integral action.
Polynomial controller_numerator(const ControllerLaw& law) {
  if (law.integral == 0.0) return {law.gain + law.derivative, -law.derivative};
  return {law.gain + law.integral + law.derivative, -law.gain - 2.0 * law.derivative,
          law.derivative};
}

Polynomial controller_denominator(const ControllerLaw& law) {
  return law.integral == 0.0 ? Polynomial{1.0} : Polynomial{1.0, -1.0};
}

bool integrates(const SampledProcess& process) {
  return std::abs(value(process.denominator, 1.0)) < kOnCircle;
}

/// Numerator of pv's answer to a step of the load, over the characteristic polynomial.
Polynomial answer_to_load(const SampledProcess& process) {
  return integrates(process) ? process.numerator : process.denominator;
}

/// Energy of a pole's part of the answer: |residue|^2 / (1 - |pole|^2).
double energy(Complex pole, const Polynomial& answer, const std::vector<Complex>& poles) {
  Complex residue = value(answer, 1.0 / pole);
  for (const Complex& other : poles) {
    if (other != pole) residue /= 1.0 - other / pole;
  }
  return std::norm(residue) / (1.0 - std::norm(pole));
}

Complex dominant(const std::vector<Complex>& poles, const Polynomial& answer) {
  return *std::ranges::max_element(
      poles, {}, [&](const Complex& pole) { return energy(pole, answer, poles); });
}

double sensitivity(const SampledProcess& process, const ControllerLaw& law, double w) {
  return 1.0 / std::abs(1.0 + response(process, w) * response(law, w));
}

/// The two eigenvalues of a 2 x 2 block.
std::array<Complex, 2> eigenvalues_of_block(const Eigen::Matrix2d& block) {
  const double half = 0.5 * (block(0, 0) - block(1, 1));
  const Complex root = std::sqrt(Complex(half * half + block(0, 1) * block(1, 0)));
  const double middle = 0.5 * (block(0, 0) + block(1, 1));
  return {middle + root, middle - root};
}

/// A companion matrix has Hessenberg form, so the first half of a general solver is saved.
std::vector<Complex> eigenvalues_of_hessenberg(const Eigen::MatrixXd& matrix) {
  Eigen::RealSchur<Eigen::MatrixXd> schur(matrix.rows());
  schur.computeFromHessenberg(matrix, matrix, false);
  const Eigen::MatrixXd& t = schur.matrixT();
  std::vector<Complex> values;
  for (Eigen::Index i = 0; i < t.rows(); ++i) {
    const bool pair = i + 1 < t.rows() && t(i + 1, i) != 0.0;
    if (!pair) {
      values.emplace_back(t(i, i));
      continue;
    }
    const auto both = eigenvalues_of_block(t.block<2, 2>(i, i));
    values.insert(values.end(), both.begin(), both.end());
    ++i;
  }
  return values;
}

/// Damping and period of a pair of poles; a positive real pole has damping 1 and no period.
void describe_pole(Complex pole, double interval_s, ClosedLoop& loop) {
  const Complex s = std::log(pole);
  const bool oscillates = std::abs(s.imag()) > kOnCircle;
  loop.damping = oscillates ? -s.real() / std::abs(s) : (s.real() < 0.0 ? 1.0 : -1.0);
  loop.period_s = oscillates ? 2.0 * std::numbers::pi / std::abs(s.imag()) * interval_s : 0.0;
}

/// The loop seen every `factor` samples.
ControllerLaw coarser(ControllerLaw law, double factor) {
  law.integral *= factor;
  law.derivative /= factor;
  return law;
}

double integral_time(const ControllerLaw& law, double interval_s) {
  if (law.integral == 0.0) return 0.0;
  return std::max(law.gain / law.integral, kShortestIntegralTime) * interval_s;
}

}  // namespace

Polynomial characteristic(const SampledProcess& process, const ControllerLaw& law) {
  const Polynomial open = product(process.denominator, controller_denominator(law));
  const Polynomial back = product(process.numerator, controller_numerator(law));
  return sum(open, delayed(back, process.delay_samples + law.lag));
}

std::vector<Complex> zeros(const Polynomial& polynomial) {
  Polynomial p = polynomial;
  while (p.size() > 1 && p.back() == 0.0) p.pop_back();
  const auto n = static_cast<Eigen::Index>(p.size()) - 1;
  if (n < 1) return {};
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  for (Eigen::Index i = 0; i < n; ++i) companion(0, i) = -p[static_cast<std::size_t>(i) + 1] / p[0];
  std::vector<Complex> result = eigenvalues_of_hessenberg(companion);
  std::erase_if(result, [](const Complex& z) { return std::abs(z) < kOnCircle; });
  return result;
}

double peak_sensitivity(const SampledProcess& process, const ControllerLaw& law) {
  const double step = -std::log(kLowest) / (kFrequencies - 1);
  const auto at = [&](double place) {
    return sensitivity(process, law, std::numbers::pi * kLowest * std::exp(step * place));
  };
  int best = 0;
  double peak = 0.0;
  for (int i = 0; i < kFrequencies; ++i) {
    const double s = at(i);
    if (s <= peak) continue;
    peak = s;
    best = i;
  }
  double low = std::max(0, best - 1);
  double high = std::min(kFrequencies - 1, best + 1);
  for (int i = 0; i < kRefinements; ++i) {
    const double third = (high - low) / 3.0;
    if (at(low + third) < at(high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  return std::max({1.0, peak, at(0.5 * (low + high))});
}

ClosedLoop close_loop(const SampledProcess& process, const ControllerLaw& law, double interval_s) {
  if (!(interval_s > 0.0)) throw std::invalid_argument("closed loop: interval has to be > 0");
  ClosedLoop loop;
  loop.controller_gain = law.gain;
  loop.integral_time_s = integral_time(law, interval_s);
  loop.controller_fit = law.explained;
  const std::vector<Complex> poles = zeros(characteristic(process, law));
  const Complex slowest =
      poles.empty() ? Complex{} : *std::ranges::max_element(poles, {}, [](const Complex& pole) {
        return std::abs(pole);
      });
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  constexpr double kTwoPercent = 0.02;
  if (std::abs(slowest) >= 1.0 - kOnCircle) {
    loop.peak_sensitivity = loop.settling_s = kInfinite;
    describe_pole(slowest, interval_s, loop);
    return loop;
  }
  loop.peak_sensitivity = peak_sensitivity(process, law);
  if (poles.empty()) return loop;
  loop.settling_s = std::log(kTwoPercent) / std::log(std::abs(slowest)) * interval_s;
  describe_pole(dominant(poles, answer_to_load(process)), interval_s, loop);
  return loop;
}

ClosedLoop close_loop(const ProcessFit& fit, const ControllerLaw& law, double interval_s) {
  const double factor = std::max(1.0, std::ceil(fit.delay_s / (interval_s * kMostDelay)));
  ClosedLoop loop = close_loop(sample_process(fit, factor * interval_s), coarser(law, factor),
                               factor * interval_s);
  loop.integral_time_s = integral_time(law, interval_s);
  return loop;
}

}  // namespace loopscope::core::model
