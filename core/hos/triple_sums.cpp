#include "core/hos/triple_sums.hpp"

#include "core/hos/principal_domain.hpp"

namespace loopscope::core::hos {
namespace {

TileRows rows_at(const Spectra& spectra, Bifrequency at) {
  const std::size_t sum = at.k1 + at.k2;
  return {{spectra.real(at.k1), spectra.real(at.k1 + 1)},
          {spectra.real(at.k2), spectra.real(at.k2 + 1)},
          {spectra.real(sum), spectra.real(sum + 1), spectra.real(sum + 2)},
          spectra.row_length()};
}

/// Tiles stick out of the domain at both ends of a row; what they hold there is dropped.
void store(const PrincipalDomain& domain, Bifrequency at, const TripleSum& sum, TripleSums& sums) {
  if (domain.contains(at)) {
    const std::size_t i = domain.index(at);
    sums.real[i] = sum.real;
    sums.imaginary[i] = sum.imaginary;
    sums.power12[i] = sum.power12;
  }
}

}  // namespace

void sum_triples(const Spectra& spectra, TripleSums& sums, const TileKernel& kernel) {
  const PrincipalDomain domain(spectra.settings().dft_length);
  sums.real.resize(domain.size());
  sums.imaginary.resize(domain.size());
  sums.power12.resize(domain.size());
  TileSums tile;
  for (std::size_t k2 = 1; k2 <= domain.rows(); k2 += 2) {
    for (std::size_t k1 = k2; k1 < k2 + domain.row_size(k2); k1 += 2) {
      kernel.sum(rows_at(spectra, {k1, k2}), tile);
      store(domain, {k1, k2}, tile[0], sums);
      store(domain, {k1 + 1, k2}, tile[1], sums);
      store(domain, {k1, k2 + 1}, tile[2], sums);
      store(domain, {k1 + 1, k2 + 1}, tile[3], sums);
    }
  }
}

}  // namespace loopscope::core::hos
