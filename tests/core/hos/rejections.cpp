#include "tests/core/hos/rejections.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/hos/bicoherence.hpp"
#include "core/hos/fackrell.hpp"
#include "core/hos/hinich.hpp"

namespace loopscope::core::hos::tests {

int records_or(int records) {
  const char* const text = std::getenv("LOOPSCOPE_RECORDS");
  return text != nullptr ? std::max(1, std::atoi(text)) : records;
}

double four_errors(double rate, int records) {
  return 4.0 * std::sqrt(rate * (1.0 - rate) / records);
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
