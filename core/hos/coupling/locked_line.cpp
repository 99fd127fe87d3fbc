#include "core/hos/coupling/locked_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/hos/coupling/overlap.hpp"
#include "core/hos/transforms/segments.hpp"

namespace loopscope::core::hos {
namespace {

/// Correlation of overlapping segments times how many pairs of them there are per segment; by lag,
/// in hops from 1.
std::vector<double> correlated_pairs(const Spectra& spectra) {
  const std::vector<double> correlation =
      segment_correlation(spectra.window(), segment_hop(spectra.settings()));
  const std::vector<std::size_t>& positions = spectra.positions();
  std::vector<double> pairs(correlation.size() - 1, 0.0);
  for (std::size_t s = 0; s < positions.size(); ++s) {
    for (std::size_t t = s + 1; t < positions.size(); ++t) {
      const std::size_t lag = positions[t] - positions[s];
      if (lag > pairs.size()) break;
      pairs[lag - 1] += correlation[lag] / static_cast<double>(positions.size());
    }
  }
  return pairs;
}

/// Expectation for noise. Where overlap lowers it below 1 there is so little left that what leaks
/// from a strong line would count: 1 is held there.
double expected_lock(const std::vector<double>& pairs, double turn_per_hop) {
  double expected = 1.0;
  for (std::size_t d = 0; d < pairs.size(); ++d) {
    expected += 2.0 * pairs[d] * std::cos(turn_per_hop * static_cast<double>(d + 1));
  }
  return std::max(1.0, expected);
}

}  // namespace

double line_lock(const Spectra& spectra) {
  const std::vector<double> pairs = correlated_pairs(spectra);
  const double turn = 2.0 * std::numbers::pi *
                      static_cast<double>(segment_hop(spectra.settings())) /
                      static_cast<double>(spectra.settings().dft_length);
  const std::vector<double> real = spectra.sums(0);
  const std::vector<double> imaginary = spectra.sums(1);
  double largest = 0.0;
  for (std::size_t k = 1; k < spectra.frequencies(); ++k) {
    const double power = spectra.total_power(k);
    const double coherent = real[k] * real[k] + imaginary[k] * imaginary[k];
    // What is expected is at least 1 and takes a cosine: most bins are out without.
    if (!(power > 0.0) || coherent <= largest * power) continue;
    const double expected = expected_lock(pairs, turn * static_cast<double>(k));
    largest = std::max(largest, coherent / (power * expected));
  }
  return largest;
}

bool has_locked_line(const Spectra& spectra) {
  constexpr double kFalse = 1e-3;
  return line_lock(spectra) > std::log(static_cast<double>(spectra.frequencies()) / kFalse);
}

}  // namespace loopscope::core::hos
