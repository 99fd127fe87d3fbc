#include "core/hos/kernels/principal_domain.hpp"

namespace loopscope::core::hos {

Bifrequency PrincipalDomain::at(std::size_t index) const {
  std::size_t k2 = 1;
  while (index >= row_begin(k2 + 1)) {
    ++k2;
  }
  return {k2 + (index - row_begin(k2)), k2};
}

}  // namespace loopscope::core::hos
