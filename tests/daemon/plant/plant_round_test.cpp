#include "daemon/plant/plant_round.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(RoundText, SaysHowManyLoopsWereComparedAndWhatTheyShare) {
  storage::PlantRoundRecord round;
  EXPECT_EQ(round_text(round), "0 loops compared, 0 of them oscillating; 0 shared oscillations");
  round.loops = 6;
  round.oscillating = 4;
  round.events.resize(1);
  round.events[0].statement = "4 loops take part.";
  EXPECT_EQ(round_text(round),
            "6 loops compared, 4 of them oscillating; 1 shared oscillation; 4 loops take part.");
}

}  // namespace
}  // namespace loopscope::daemon
