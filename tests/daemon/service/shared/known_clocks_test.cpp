#include "daemon/service/shared/known_clocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

using storage::ServerClock;
using testing::HasSubstr;

constexpr std::int64_t kResultsStart = 1;
constexpr std::int64_t kHistorianStart = 2;

class ClockBookTest : public testing::Test {
 protected:
  /// All clocks that run rightly go on.
  void pass(std::int64_t us) {
    now_us += us;
    elapsed += std::chrono::microseconds(us);
  }
  [[nodiscard]] bool believes(std::int64_t results_us) {
    try {
      book.check()({results_us, kResultsStart});
      return true;
    } catch (const storage::DatabaseError& error) {
      EXPECT_EQ(error.remedy(), storage::Remedy::retry) << "it may be set right";
      said = error.what();
      return false;
    }
  }

  std::int64_t now_us = kNoon_us;
  KnownClocks::Steady::time_point elapsed{};
  KnownClocks book{{[this] { return now_us; }, [this] { return elapsed; }}};
  std::string said;
};

TEST_F(ClockBookTest, ServerAndHostThatAgreeNeedNoWitness) {
  EXPECT_TRUE(believes(kNoon_us + 60 * kSecond_us));
  EXPECT_FALSE(book.is_wrong("plant"));
}

TEST_F(ClockBookTest, AHistorianReadBeforeIsAWitnessOfAJump) {
  book.note_historian("plant", {kNoon_us, kHistorianStart});
  pass(3 * kHour_us);
  EXPECT_FALSE(believes(now_us + 30 * 24 * kHour_us));
  EXPECT_THAT(said, testing::StartsWith(
                        "nothing is claimed or written, because the clock of the results server is "
                        "wrong; compared with it: historian plant (30 d 0 h behind), host "));
  EXPECT_TRUE(believes(now_us)) << "back again";
  now_us -= 5 * kHour_us;
  EXPECT_TRUE(believes(now_us + 5 * kHour_us)) << "it is the host's that has jumped";
}

TEST_F(ClockBookTest, WithoutAWitnessNobodyIsBelieved) {
  EXPECT_FALSE(believes(kNoon_us + 5 * kHour_us));
  EXPECT_THAT(said, HasSubstr("nobody confirms"));
  book.accept({{book.note_results({kNoon_us, kResultsStart}).host.clock, -5.0 * 3600.0}});
  EXPECT_TRUE(believes(kNoon_us + 5 * kHour_us)) << "a person has said so";
  EXPECT_FALSE(believes(kNoon_us + 900 * 24 * kHour_us)) << "but not of this";
}

TEST_F(ClockBookTest, AHistorianOnTheResultsServerIsNoWitness) {
  book.note_historian("plant", {kNoon_us + 5 * kHour_us, kResultsStart});
  EXPECT_FALSE(believes(kNoon_us + 5 * kHour_us));
}

TEST_F(ClockBookTest, AHistorianThatIsWrongIsNamed) {
  book.note_historian("plant", {kNoon_us - 2 * kHour_us, kHistorianStart});
  EXPECT_FALSE(book.is_wrong("plant")) << "nothing to compare with yet";
  EXPECT_TRUE(believes(kNoon_us));
  EXPECT_TRUE(book.is_wrong("plant"));
  EXPECT_FALSE(book.is_wrong("other"));
  book.note_historian("plant", {kNoon_us, kHistorianStart});
  EXPECT_FALSE(book.is_wrong("plant"));
}

TEST_F(ClockBookTest, HistoriansOfFormerSettingsAreNoWitnesses) {
  book.note_historian("plant", {kNoon_us, kHistorianStart});
  book.keep_historians({"other"});
  EXPECT_FALSE(believes(kNoon_us + 5 * kHour_us));
  EXPECT_THAT(said, HasSubstr("nobody confirms"));
}

}  // namespace
}  // namespace loopscope::daemon
