#include "core/hos/coupling/quadratic_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/hos/coupling/coherence_test.hpp"
#include "core/hos/coupling/null_laws.hpp"
#include "core/hos/transforms/segments.hpp"

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

/// The standard deviation of the mean over the cells, measured over the one of Overlap: its
/// normalisation by the cells' own powers takes some of the variation away (README, "The
/// triangle").
constexpr double kSpreadOfRatio = 0.97;
/// Cells looked at one by one: the largest conditional evidence is among the largest bic2.
constexpr std::size_t kExamined = 16;
/// Independent cells per correlated one at small p, measured for a DFT of twice the segment.
constexpr double kIndependentShare = 0.62;

/// The largest values that it has been shown, and where they are.
class Largest {
 public:
  void show(double value, Bifrequency at) {
    if (count_ == kExamined && !(value > found_[count_ - 1].value)) return;
    std::size_t place = count_ < kExamined ? count_++ : count_ - 1;
    for (; place > 0 && found_[place - 1].value < value; --place) found_[place] = found_[place - 1];
    found_[place] = {value, at};
  }
  struct Found {
    double value;
    Bifrequency at;
  };
  [[nodiscard]] std::span<const Found> found() const { return std::span(found_).first(count_); }

 private:
  std::array<Found, kExamined> found_{};
  std::size_t count_ = 0;
};

}  // namespace

/// Memory for what coherence_evidence() looks at.
struct QuadraticTest::Segments {
  std::vector<Complex> products;
  std::vector<Complex> values;
  std::vector<Complex> correlation;
};

QuadraticTest::QuadraticTest(const Settings& settings)
    : settings_(settings), overlap_(&Overlap::of(settings)), cells_(settings) {}

double QuadraticTest::independent_cells() const {
  return std::max(1.0, kIndependentShare * static_cast<double>(cells_.count()));
}

QuadraticStatistics QuadraticTest::measure(const Bicoherence& bicoherence,
                                           std::span<const double> bic2) const {
  if (cells_.count() == 0) return {1.0, 0.0};
  const PrincipalDomain& domain = bicoherence.domain();
  Largest largest;
  double sum = 0.0;
  for (std::size_t k2 = 1; k2 <= domain.rows(); ++k2) {
    const TestableCells::Range range = cells_.row(k2);
    for (std::size_t k1 = range.begin; k1 < range.end; ++k1) {
      const double value = bic2[domain.index({k1, k2})];
      sum += value;
      largest.show(value, {k1, k2});
    }
  }
  QuadraticStatistics found;
  found.mean =
      static_cast<double>(bicoherence.segments()) * sum / static_cast<double>(cells_.count());
  Segments segments;
  for (const Largest::Found& cell : largest.found()) {
    found.largest = std::max(found.largest, evidence(bicoherence, cell.at, segments));
  }
  return found;
}

double QuadraticTest::evidence(const Bicoherence& bicoherence, Bifrequency at,
                               Segments& segments) const {
  const Spectra& spectra = bicoherence.spectra();
  const double* const a_re = spectra.real(at.k1);
  const double* const a_im = spectra.imaginary(at.k1);
  const double* const b_re = spectra.real(at.k2);
  const double* const b_im = spectra.imaginary(at.k2);
  const double* const c_re = spectra.real(at.k1 + at.k2);
  const double* const c_im = spectra.imaginary(at.k1 + at.k2);
  segments.products.resize(spectra.segments());
  segments.values.resize(spectra.segments());
  for (std::size_t s = 0; s < spectra.segments(); ++s) {
    segments.products[s] = {a_re[s] * b_re[s] - a_im[s] * b_im[s],
                            a_re[s] * b_im[s] + a_im[s] * b_re[s]};
    segments.values[s] = {c_re[s], c_im[s]};
  }
  const double turn = -2.0 * std::numbers::pi * static_cast<double>(at.k1 + at.k2) *
                      static_cast<double>(segment_hop(settings_)) /
                      static_cast<double>(settings_.dft_length);
  segments.correlation.resize(overlap_->lags() + 1);
  for (std::size_t d = 0; d < segments.correlation.size(); ++d) {
    segments.correlation[d] = std::polar(overlap_->correlation()[d], turn * static_cast<double>(d));
  }
  return coherence_evidence(
      {segments.products, segments.values, spectra.positions(), segments.correlation});
}

double QuadraticTest::mean_p(const QuadraticStatistics& found, std::size_t segments) const {
  if (cells_.count() == 0) return 1.0;
  const double few_segments = 1.0 - 2.0 / static_cast<double>(segments);
  const double std = kSpreadOfRatio * std::sqrt(few_segments * overlap_->correlated_cells() /
                                                static_cast<double>(cells_.count()));
  return mean_law_upper(found.mean, overlap_->mean(), std);
}

double QuadraticTest::largest_p(const QuadraticStatistics& found) const {
  const double level = std::max(0.0, found.mean / overlap_->mean() - 1.0);
  return smallest_of(cell_law_upper(found.largest, level), independent_cells());
}

std::optional<double> QuadraticTest::peak_p(const Bicoherence& bicoherence, Bifrequency at) const {
  if (!cells_.contains(at)) return std::nullopt;
  Segments segments;
  return smallest_of(p_of_evidence(evidence(bicoherence, at, segments)), independent_cells());
}

}  // namespace loopscope::core::hos
