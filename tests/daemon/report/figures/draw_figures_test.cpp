#include "daemon/report/figures/draw_figures.hpp"

#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/figures/gnuplot_text.hpp"
#include "daemon/report/figures/history_figures.hpp"
#include "daemon/report/programs/run_child.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

std::optional<std::filesystem::path> gnuplot() {
  return find_program("gnuplot", "/usr/local/bin:/usr/bin:/bin");
}

std::vector<storage::HistoryPoint> history(std::size_t slots) {
  std::vector<storage::HistoryPoint> points(slots);
  for (std::size_t k = 0; k < slots; ++k) {
    points[k].slot_end_us = 1'772'366'400'000'000 + static_cast<std::int64_t>(k) * 3'600'000'000;
    points[k].ngi = 0.01 * static_cast<double>(k);
    if (k % 3 != 0) points[k].harris_low = 0.4;
  }
  return points;
}

TEST(DrawFigures, OnePictureForEachFigure) {
  if (!gnuplot()) GTEST_SKIP() << "no gnuplot (package gnuplot-nox)";
  const Figure line{"a title", "words", "plot sin(x)\n"};
  std::vector<Figure> figures = history_figures(history(30), {});
  ASSERT_EQ(figures.size(), 1U);
  figures.push_back(line);
  const std::vector<Picture> pictures = draw_figures(figures, *gnuplot());
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_TRUE(pictures[0].svg.starts_with("<svg "));
  EXPECT_THAT(pictures[0].svg, HasSubstr("time (UTC), 2026-03-01 to 2026-03-02"));
  EXPECT_EQ(pictures[1].title, "a title");
  EXPECT_EQ(pictures[1].height, 320);
}

TEST(DrawFigures, SaysWhatGnuplotSays) {
  if (!gnuplot()) GTEST_SKIP() << "no gnuplot (package gnuplot-nox)";
  try {
    (void)draw_figures(std::vector<Figure>{{"", "", "plot nonsense(x)\n"}}, *gnuplot());
    FAIL() << "a script that is none was drawn";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("undefined function"));
    EXPECT_THAT(failure.hint(), HasSubstr("gnuplot-nox"));
  }
}

TEST(DrawFigures, ALoopWithoutAPastHasNoPictureOfIt) {
  EXPECT_TRUE(history_figures(history(1), {}).empty());
  EXPECT_TRUE(history_figures({}, {}).empty());
}

}  // namespace
}  // namespace loopscope::daemon
