#include "core/hos/coupling/coupling_tests.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "core/hos/coupling/combine_p.hpp"
#include "core/hos/coupling/nli_p.hpp"
#include "core/hos/coupling/null_laws.hpp"
#include "core/hos/coupling/quadratic_test.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

TEST(HosCouplingTests, AreThoseOfTheirStatistics) {
  const auto signal = tests::coloured(simulate::Innovation::laplace, 0.9, 3);
  Bicoherence bicoherence(Settings{});
  const TestedSpectra tested(signal, bicoherence, bicoherence.estimate(signal), Settings{});
  const HarmonicTest harmonics(30.0);
  const CouplingTests found = test_coupling(tested, &harmonics);
  const QuadraticTest test(tested.settings());
  const auto quadratic = test.measure(tested.bicoherence(), tested.bic2());
  const auto coherence = harmonics.measure(tested.signal());
  EXPECT_EQ(found.mean_p, test.mean_p(quadratic, tested.bicoherence().segments()));
  EXPECT_EQ(found.nli_p, nli_p(test, quadratic, coherence));
  EXPECT_EQ(found.cubic_p, p_of_evidence(coherence->cubic_evidence));
  EXPECT_FALSE(test_coupling(tested, nullptr).cubic_p.has_value());
}

TEST(HosCouplingTests, CombineByCauchy) {
  const CouplingTests all{.mean_p = 0.2, .nli_p = 0.01, .cubic_p = 0.5};
  EXPECT_DOUBLE_EQ(all.combined(), 0.87 * combine_p(std::array{0.2, 0.01, 0.5}));
  EXPECT_DOUBLE_EQ(all.quadratic(), combine_p(std::array{0.2, 0.01}));
  EXPECT_EQ(all.smallest(), 0.01);
  const CouplingTests two{.mean_p = 0.2, .nli_p = 0.3, .cubic_p = std::nullopt};
  EXPECT_DOUBLE_EQ(two.combined(), 0.87 * two.quadratic());
  EXPECT_EQ(two.smallest(), 0.2);
}

TEST(HosCouplingTests, NothingToEstimateFromSaysNothing) {
  std::vector<double> torn = tests::white_noise(1);
  for (std::size_t t = 0; t < torn.size(); t += 60) torn[t] = std::nan("");
  Bicoherence bicoherence(Settings{});
  const TestedSpectra tested(torn, bicoherence, Settings{});
  const CouplingTests found = test_coupling(tested, nullptr);
  EXPECT_EQ(found.mean_p, 1.0);
  EXPECT_EQ(found.smallest(), found.nli_p);
}

}  // namespace
}  // namespace loopscope::core::hos
