#include "daemon/catalogue/maintenance_csv.hpp"

#include <gmock/gmock.h>
#include <stdexcept>

#include "daemon/failure.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

std::string failure_of(const std::string& csv) {
  try {
    static_cast<void>(parse_maintenance(parse_csv(csv, "work.csv")));
    return "";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::unusable_data);
    EXPECT_FALSE(failure.hint().empty());
    return failure.what();
  }
}

TEST(MaintenanceCsv, ColumnsStandInAnyOrder) {
  const auto entries = parse_maintenance(
      parse_csv("kind,at,description,loop\nvalve,2026-03-01T12:00:00+01:00,\"new, seat\",FIC 1\n"
                "tuning, 2026-03-01 11:00 , retuned ,LIC2\n",
                "work.csv"));
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].loop_name, "FIC 1");
  EXPECT_EQ(entries[0].kind, "valve");
  EXPECT_EQ(entries[0].description, "new, seat");
  EXPECT_EQ(entries[0].done_at_us, entries[1].done_at_us);
  EXPECT_EQ(entries[1].description, "retuned");
}

TEST(MaintenanceCsv, FaultsNameTheirLine) {
  EXPECT_THAT(failure_of("loop,at,kind,description\na,2026-03-01,valve,x\na,soon,valve,x\n"),
              HasSubstr("work.csv, line 3: \"soon\" is no time"));
  EXPECT_THAT(failure_of("loop,at,kind,description\na,2026-03-01,vlave,x\n"),
              HasSubstr("no kind of work \"vlave\", did you mean valve (one of valve, sensor,"));
  EXPECT_THAT(failure_of("loop,at,kind,description\na,2026-03-01,valve,\n"),
              HasSubstr("line 2: what was done is not said"));
  EXPECT_THAT(failure_of("loop,at,kind\na,2026-03-01,valve\n"), HasSubstr("line 1: the columns"));
  EXPECT_THAT(failure_of("loop,at,kind,description,who\n"), HasSubstr("line 1: the columns"));
}

TEST(MaintenanceEntry, WithoutAZoneIsUtc) {
  EXPECT_EQ(maintenance_entry("a", "2026-03-01 12:00", "valve", "x").done_at_us,
            maintenance_entry("a", "2026-03-01T12:00:00Z", "valve", "x").done_at_us);
  EXPECT_THROW(static_cast<void>(maintenance_entry("a", "", "valve", "x")), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::daemon
