#include "tests/core/hos/rejections.hpp"

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/literature/fackrell.hpp"
#include "core/hos/literature/hinich.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::hos::tests {

int records(int full) {
  return static_cast<int>(loopscope::tests::records(static_cast<std::size_t>(full)));
}

Rejections rejections(const Draw& draw, const Settings& settings, double level, int records) {
  Bicoherence bicoherence(settings);
  Rejections shares;
  const double share = 1.0 / records;
  for (int seed = 1; seed <= records; ++seed) {
    const auto bic2 = bicoherence.estimate(draw(static_cast<std::uint64_t>(seed)));
    const HinichTest by_hinich = hinich(bic2, bicoherence.segments());
    const FackrellTest by_fackrell = fackrell(bic2, bicoherence.segments(), 0.05);
    shares.gaussianity += by_hinich.gaussianity_p <= level ? share : 0.0;
    shares.linearity += by_hinich.linearity_p <= level ? share : 0.0;
    shares.fackrell_count += by_fackrell.count_p <= level ? share : 0.0;
    shares.fackrell_some += by_fackrell.smallest_p <= level ? share : 0.0;
  }
  return shares;
}

}  // namespace loopscope::core::hos::tests
