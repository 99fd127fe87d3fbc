#include "core/hos/kernels/principal_domain.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::hos {
namespace {

TEST(HosPrincipalDomain, PaperSettingsGive1024) {
  EXPECT_EQ(PrincipalDomain(128).size(), 1024U);
}

TEST(HosPrincipalDomain, IndexNumbersItsBifrequenciesInOrder) {
  for (const std::size_t dft_length : {16U, 18U, 20U, 22U, 128U, 130U}) {
    const PrincipalDomain domain(dft_length);
    std::size_t next = 0;
    for (std::size_t k2 = 0; k2 <= dft_length / 2; ++k2) {
      for (std::size_t k1 = 0; k1 <= dft_length / 2; ++k1) {
        const Bifrequency at{k1, k2};
        const bool inside = k2 >= 1 && k2 <= k1 && k1 + k2 <= dft_length / 2;
        ASSERT_EQ(domain.contains(at), inside);
        if (inside) {
          ASSERT_EQ(domain.index(at), next);
          ASSERT_EQ(domain.at(next), at);
          ++next;
        }
      }
    }
    EXPECT_EQ(next, domain.size()) << dft_length;
  }
}

}  // namespace
}  // namespace loopscope::core::hos
