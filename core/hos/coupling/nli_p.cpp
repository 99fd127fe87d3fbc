#include "core/hos/coupling/nli_p.hpp"

#include <array>

#include "core/hos/coupling/combine_p.hpp"
#include "core/hos/coupling/null_laws.hpp"

namespace loopscope::core::hos {

double nli_p(const QuadraticTest& test, const QuadraticStatistics& found,
             const std::optional<HarmonicStatistics>& harmonics) {
  const double cells = test.largest_p(found);
  if (!harmonics) return cells;
  return combine_p(std::array{cells, p_of_evidence(harmonics->quadratic_evidence)});
}

}  // namespace loopscope::core::hos
