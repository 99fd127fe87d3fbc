#include "core/hos/coupling/testable_cells.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::hos {
namespace {

TEST(HosTestableCells, OfThePapersSettingsAre714) {
  EXPECT_EQ(TestableCells{Settings{}}.count(), 714U);
}

TEST(HosTestableCells, KeepALobeFromEveryEdge) {
  // A Hann window's main lobe is 4 bins of 128 to either side.
  const TestableCells cells{Settings{}};
  EXPECT_TRUE(cells.contains({9, 4}));
  EXPECT_FALSE(cells.contains({8, 4}));   // one line could fill all three
  EXPECT_FALSE(cells.contains({20, 3}));  // X(k1) and X(k1 + k2) share a lobe
  EXPECT_TRUE(cells.contains({30, 30}));
  EXPECT_TRUE(cells.contains({56, 4}));
  EXPECT_FALSE(cells.contains({57, 4}));  // the spectrum meets its mirror image
  EXPECT_FALSE(cells.contains({31, 30}));
}

TEST(HosTestableCells, CountIsWhatTheDomainContains) {
  for (const Settings& settings :
       {Settings{}, Settings{.dft_length = 64}, Settings{.window = WindowShape::rectangular},
        Settings{.segment_length = 32, .dft_length = 64}, Settings{.segment_length = 48},
        Settings{.dft_length = 130}, Settings{.segment_length = 16, .dft_length = 16}}) {
    const TestableCells cells(settings);
    const PrincipalDomain domain(settings.dft_length);
    std::size_t count = 0;
    for (std::size_t i = 0; i < domain.size(); ++i) count += cells.contains(domain.at(i)) ? 1U : 0U;
    EXPECT_EQ(cells.count(), count) << settings.segment_length << ' ' << settings.dft_length;
  }
}

TEST(HosTestableCells, RowsAreWhatIsContained) {
  for (const Settings& settings :
       {Settings{}, Settings{.dft_length = 64}, Settings{.window = WindowShape::rectangular},
        Settings{.segment_length = 48}, Settings{.segment_length = 16, .dft_length = 16}}) {
    const TestableCells cells(settings);
    const PrincipalDomain domain(settings.dft_length);
    for (std::size_t i = 0; i < domain.size(); ++i) {
      const Bifrequency at = domain.at(i);
      const TestableCells::Range k1 = cells.row(at.k2);
      EXPECT_EQ(at.k1 >= k1.begin && at.k1 < k1.end, cells.contains(at)) << at.k1 << ' ' << at.k2;
    }
  }
}

TEST(HosTestableCells, NoneIsLeftOfVeryShortSegments) {
  EXPECT_EQ((TestableCells{{.segment_length = 16, .dft_length = 16}}.count()), 0U);
}

}  // namespace
}  // namespace loopscope::core::hos
