#include "daemon/report/figures/event_figures.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/figures/draw_figures.hpp"
#include "daemon/report/figures/event_pictures.hpp"
#include "daemon/report/programs/run_child.hpp"
#include "tests/daemon/report/event_rows.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(EventFigures, TrendsAndSpectraOfTheSameLoops) {
  const std::vector<Figure> figures = event_figures(sample_event(10), {});
  ASSERT_THAT(figures, SizeIs(2));
  for (const Figure& figure : figures) {
    EXPECT_THAT(figure.script, HasSubstr("$row7 << EOD"));
    EXPECT_THAT(figure.script, Not(HasSubstr("$row8")));
    EXPECT_THAT(figure.script, HasSubstr("set label '8' at graph"));
  }
  EXPECT_THAT(figures[0].script, HasSubstr("one period, 40 s"));
  EXPECT_THAT(figures[1].script, HasSubstr("period 40 s"));
  EXPECT_THAT(figures[1].script, HasSubstr("'1 min' 60"));
  EXPECT_GT(figures[0].height, event_figures(sample_event(2), {})[0].height);
}

TEST(EventFigures, ACurveIsNumberedAsInTheListOfMembers) {
  storage::PlantOscillationRow event = sample_event(3);
  std::swap(event.members[1], event.members[2]);
  event.traces.erase(event.traces.begin() + 1);  // of L2, which is the third now
  const std::string script = event_figures(event, {})[0].script;
  EXPECT_THAT(script, HasSubstr("set label '1' at"));
  EXPECT_THAT(script, HasSubstr("set label '2' at"));
  EXPECT_THAT(script, Not(HasSubstr("set label '3' at")));
}

TEST(EventFigures, WithoutTracesThereAreNone) {
  storage::PlantOscillationRow event = sample_event(3);
  event.traces.clear();
  EXPECT_THAT(event_figures(event, {}), IsEmpty());
  EXPECT_THAT(event_album({&event, 1}, {}).figures, IsEmpty());
}

TEST(EventFigures, WhatCannotBeDrawnIsLeftOut) {
  storage::PlantOscillationRow event = sample_event(4);
  event.traces[0].error.assign(240, 5.0);
  event.traces[1].error.assign(240, NAN);
  event.traces[2].power.clear();
  event.traces[3].loop_id = 99;
  const std::vector<Figure> figures = event_figures(event, {});
  ASSERT_THAT(figures, SizeIs(2));
  EXPECT_THAT(figures[0].script, Not(HasSubstr("$row1")));
  EXPECT_THAT(figures[1].script, Not(HasSubstr("$row2")));
}

/// A script may hold no text that somebody typed.
TEST(EventFigures, NoNameComesIntoAScript) {
  for (const auto& [about, name] : tests::hostile_names()) {
    storage::PlantOscillationRow event = sample_event(3);
    for (auto& member : event.members) member.loop_name = name;
    event.source_name = event.statement = name;
    EXPECT_EQ(event_figures(event, {})[0].script, event_figures(sample_event(3), {})[0].script)
        << about;
  }
}

TEST(EventFigures, GnuplotDrawsThem) {
  const auto gnuplot = find_program("gnuplot", "/usr/local/bin:/usr/bin:/bin");
  if (!gnuplot) GTEST_SKIP() << "no gnuplot (package gnuplot-nox)";
  storage::PlantOscillationRow gaps = sample_event(1);
  for (std::size_t k = 50; k < 70; ++k) gaps.traces[0].error[k] = NAN;
  gaps.number = 2;
  const std::vector<storage::PlantOscillationRow> events = {sample_event(8), gaps};
  EventAlbum album = event_album(events, {});
  album.pictures = draw_figures(album.figures, *gnuplot);
  EXPECT_THAT(album.of_event(1), SizeIs(2));
  EXPECT_THAT(album.of_event(2), SizeIs(2));
  EXPECT_THAT(album.of_event(3), IsEmpty());
  EXPECT_THAT(album.of_event(2)[1].svg, HasSubstr("period 40 s"));
}

TEST(EventAlbum, ShowsTheSameWhileTheRoundIsTheSame) {
  std::vector<storage::PlantOscillationRow> events = {sample_event(4)};
  const EventAlbum before = event_album(events, {});
  EXPECT_TRUE(event_album(events, {}).shows_the_same(before));
  events[0].traces[1].error[7] += 1.0;
  EXPECT_FALSE(event_album(events, {}).shows_the_same(before));
  EXPECT_FALSE(event_album({}, {}).shows_the_same(before));
}

}  // namespace
}  // namespace loopscope::daemon
