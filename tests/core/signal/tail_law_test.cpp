#include "core/signal/tail_law.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/simulate/innovations.hpp"

namespace loopscope::core::signal {
namespace {

std::vector<double> sizes(simulate::Innovation law, std::uint64_t seed) {
  std::vector<double> values = simulate::innovations(law, 4096, seed);
  for (double& value : values) value = std::abs(value);
  return values;
}

TEST(TailLaw, ExpectsWhatALaplacianTailHolds) {
  double expected = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    expected += TailLaw::of(sizes(simulate::Innovation::laplace, seed))->expected_beyond(5.0) / 100;
  }
  EXPECT_NEAR(expected, 4096.0 * std::exp(-5.0 * std::sqrt(2.0)), 0.8);
}

TEST(TailLaw, GoesALittleBeyondAGaussianTail) {
  const auto law = TailLaw::of(sizes(simulate::Innovation::gaussian, 1));
  EXPECT_GT(law->expected_beyond(4.0), 4096.0 * std::erfc(4.0 / std::sqrt(2.0)));
  EXPECT_LT(law->expected_beyond(6.0), 0.02);
}

TEST(TailLaw, FewOutliersLengthenItLittle) {
  std::vector<double> values = sizes(simulate::Innovation::gaussian, 2);
  for (std::size_t k = 0; k < values.size(); k += 50) values[k] = 100.0;
  EXPECT_LT(TailLaw::of(values)->expected_beyond(8.0), 0.2);
}

TEST(TailLaw, NothingToTellATailFrom) {
  EXPECT_FALSE(TailLaw::of({}));
  EXPECT_FALSE(TailLaw::of(std::vector<double>(100, 0.0)));
  EXPECT_FALSE(TailLaw::of(std::vector<double>(100, 1.0)));
}

}  // namespace
}  // namespace loopscope::core::signal
