#include "core/hos/surrogates/slow_wander.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/hos/numeric/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

constexpr std::size_t kSamplesPerCosine = 256;
constexpr std::size_t kSamplesPerBlock = 16;

/// Calls visit(k, cos(k angle)) for k = 0 .. last.
template <typename Visit>
void for_each_cosine(double angle, std::size_t last, Visit visit) {
  const double twice = 2.0 * std::cos(angle);
  double before = std::cos(angle);
  double cosine = 1.0;
  for (std::size_t k = 0; k <= last; ++k) {
    visit(k, cosine);
    const double next = twice * cosine - before;
    before = cosine;
    cosine = next;
  }
}

/// Sums over blocks: what is slow is the same all over one.
std::vector<double> block_sums(std::span<const double> signal, double mean) {
  std::vector<double> sums((signal.size() + kSamplesPerBlock - 1) / kSamplesPerBlock);
  for (std::size_t t = 0; t < signal.size(); ++t) {
    if (std::isfinite(signal[t])) sums[t / kSamplesPerBlock] += signal[t] - mean;
  }
  return sums;
}

/// The sum of cosines that is nearest to the signal, at the centre of each block. Where samples are
/// missing the cosines are not quite orthogonal, which leaves some of the wander.
std::vector<double> wander_of(const std::vector<double>& sums, std::size_t samples, double count) {
  const std::size_t last = samples / kSamplesPerCosine;
  const double step =
      std::numbers::pi * static_cast<double>(kSamplesPerBlock) / static_cast<double>(samples);
  const auto angle = [step](std::size_t b) { return (static_cast<double>(b) + 0.5) * step; };
  std::vector<double> weights(last + 1);
  for (std::size_t b = 0; b < sums.size(); ++b) {
    for_each_cosine(angle(b), last,
                    [&](std::size_t k, double cosine) { weights[k] += cosine * sums[b]; });
  }
  weights[0] /= 2.0;
  std::vector<double> wander(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b) {
    for_each_cosine(angle(b), last, [&](std::size_t k, double cosine) {
      wander[b] += 2.0 / count * cosine * weights[k];
    });
  }
  return wander;
}

/// Along straight lines from centre to centre, level beyond the outer ones.
double between_centres(const std::vector<double>& wander, std::size_t t) {
  const double place = (static_cast<double>(t) + 0.5) / static_cast<double>(kSamplesPerBlock) - 0.5;
  const double held = std::clamp(place, 0.0, static_cast<double>(wander.size() - 1));
  const auto before = static_cast<std::size_t>(held);
  const std::size_t after = std::min(before + 1, wander.size() - 1);
  return std::lerp(wander[before], wander[after], held - static_cast<double>(before));
}

}  // namespace

std::vector<double> without_slow_wander(std::span<const double> signal) {
  const FiniteMean finite = finite_mean(signal);
  const std::vector<double> wander =
      wander_of(block_sums(signal, finite.mean), signal.size(), std::max(finite.count, 1.0));
  std::vector<double> left(signal.begin(), signal.end());
  for (std::size_t t = 0; t < left.size(); ++t) left[t] -= finite.mean + between_centres(wander, t);
  return left;
}

}  // namespace loopscope::core::hos
