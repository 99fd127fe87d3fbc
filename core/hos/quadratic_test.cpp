#include "core/hos/quadratic_test.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/hos/coherence_test.hpp"
#include "core/hos/null_laws.hpp"
#include "core/hos/segments.hpp"

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

/// The standard deviation of the mean over the cells, measured over the one of Overlap: its
/// normalisation by the cells' own powers takes some of the variation away (README, "The triangle").
constexpr double kSpreadOfRatio = 0.97;
/// Cells looked at one by one: the largest conditional evidence is among the largest bic2.
constexpr std::size_t kExamined = 16;
/// Independent cells per correlated one at small p, measured for a DFT of twice the segment.
constexpr double kIndependentShare = 0.62;

}  // namespace

QuadraticTest::QuadraticTest(const Settings& settings)
    : settings_(settings), overlap_(settings), cells_(settings) {}

double QuadraticTest::independent_cells() const {
  return std::max(1.0, kIndependentShare * static_cast<double>(cells_.count()));
}

QuadraticStatistics QuadraticTest::measure(const Bicoherence& bicoherence,
                                           std::span<const double> bic2) const {
  const PrincipalDomain& domain = bicoherence.domain();
  std::vector<std::size_t> tested;
  tested.reserve(cells_.count());
  double sum = 0.0;
  for (std::size_t k2 = 1, i = 0; k2 <= domain.rows(); ++k2) {
    for (std::size_t k1 = k2; k1 < k2 + domain.row_size(k2); ++k1, ++i) {
      if (!cells_.contains({k1, k2})) continue;
      sum += bic2[i];
      tested.push_back(i);
    }
  }
  if (tested.empty()) return {1.0, 0.0};
  const auto examined = static_cast<std::ptrdiff_t>(std::min(kExamined, tested.size()));
  std::partial_sort(tested.begin(), tested.begin() + examined, tested.end(),
                    [&](std::size_t a, std::size_t b) { return bic2[a] > bic2[b]; });
  QuadraticStatistics found;
  found.mean =
      static_cast<double>(bicoherence.segments()) * sum / static_cast<double>(tested.size());
  for (auto cell = tested.begin(); cell != tested.begin() + examined; ++cell) {
    found.largest = std::max(found.largest, evidence(bicoherence, domain.at(*cell)));
  }
  return found;
}

double QuadraticTest::evidence(const Bicoherence& bicoherence, Bifrequency at) const {
  const Spectra& spectra = bicoherence.spectra();
  const auto bin = [&](std::size_t k, std::size_t s) {
    return Complex(spectra.real(k)[s], spectra.imaginary(k)[s]);
  };
  std::vector<Complex> products(spectra.segments());
  std::vector<Complex> values(spectra.segments());
  for (std::size_t s = 0; s < products.size(); ++s) {
    products[s] = bin(at.k1, s) * bin(at.k2, s);
    values[s] = bin(at.k1 + at.k2, s);
  }
  const double turn = -2.0 * std::numbers::pi * static_cast<double>(at.k1 + at.k2) *
                      static_cast<double>(segment_hop(settings_)) /
                      static_cast<double>(settings_.dft_length);
  std::vector<Complex> correlation(overlap_.lags() + 1);
  for (std::size_t d = 0; d < correlation.size(); ++d) {
    correlation[d] = std::polar(overlap_.correlation()[d], turn * static_cast<double>(d));
  }
  return coherence_evidence({products, values, spectra.positions(), correlation});
}

double QuadraticTest::mean_p(const QuadraticStatistics& found, std::size_t segments) const {
  if (cells_.count() == 0) return 1.0;
  const double few_segments = 1.0 - 2.0 / static_cast<double>(segments);
  const double std = kSpreadOfRatio * std::sqrt(few_segments * overlap_.correlated_cells() /
                                                static_cast<double>(cells_.count()));
  return mean_law_upper(found.mean, overlap_.mean(), std);
}

double QuadraticTest::largest_p(const QuadraticStatistics& found) const {
  const double level = std::max(0.0, found.mean / overlap_.mean() - 1.0);
  return smallest_of(cell_law_upper(found.largest, level), independent_cells());
}

std::optional<double> QuadraticTest::peak_p(const Bicoherence& bicoherence, Bifrequency at) const {
  if (!cells_.contains(at)) return std::nullopt;
  return smallest_of(p_of_evidence(evidence(bicoherence, at)), independent_cells());
}

}  // namespace loopscope::core::hos
