#include <gmock/gmock.h>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::SizeIs;

/// A login that may connect and nothing else. Advisory locks it has like everybody.
class OutsiderTest : public ViewsTest {
 protected:
  void SetUp() override {
    ViewsTest::SetUp();
    if (database) outsider.emplace(database->conninfo(database->make_login("")));
  }
  std::optional<tests::SqlConnection> outsider;
};

TEST_F(OutsiderTest, StopsNothingByAdvisoryLocks) {
  tell({{.loop = "a"}});
  // The keys that versions up to 0.1.0 locked: of the plant round, of migrations, of notices.
  outsider->run(
      "SELECT pg_advisory_lock(1819242352, 1), pg_advisory_lock(7310868735423867747),"
      " pg_advisory_lock(7310868735423867748)");
  EXPECT_NO_THROW(migrate(settings_for(*database)));
  EXPECT_NO_THROW(static_cast<void>(maintain(settings_for(*database), {.retention_months = 24})));
  PlantRounds rounds(settings_for(*database));
  EXPECT_EQ(rounds.take_turn(3600, "host/1", 60).wait_s, 0.0) << "nobody is at it";
  EXPECT_THAT(rounds.announce_flags().flagged, SizeIs(1));
}

}  // namespace
}  // namespace loopscope::storage
