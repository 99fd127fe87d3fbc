#include "core/hos/bicoherence/triple_sums.hpp"

#include "core/hos/kernels/principal_domain.hpp"

namespace loopscope::core::hos {

void sum_triples(const Spectra& spectra, TripleSums& sums) {
  const PrincipalDomain domain(spectra.settings().dft_length);
  sums.real.resize(domain.size());
  sums.imaginary.resize(domain.size());
  sums.power12.resize(domain.size());
  spectra.kernels().sum_triples(spectra.rows(),
                                {sums.real.data(), sums.imaginary.data(), sums.power12.data()});
}

}  // namespace loopscope::core::hos
