#include "daemon/catalogue/maintenance_csv.hpp"

#include <gmock/gmock.h>
#include <stdexcept>

#include "tests/daemon/data_failure.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

std::string maintenance_failure(const std::string& csv) {
  return data_failure([&] { return parse_maintenance(parse_csv(csv, "work.csv"), {}); }).what();
}

TEST(MaintenanceCsv, ColumnsStandInAnyOrder) {
  const auto entries = parse_maintenance(
      parse_csv("kind,at,description,loop\nvalve,2026-03-01T12:00:00+01:00,\"new, seat\",FIC 1\n"
                "tuning, 2026-03-01 11:00 , retuned ,LIC2\n",
                "work.csv"),
      {});
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].loop_name, "FIC 1");
  EXPECT_EQ(entries[0].kind, "valve");
  EXPECT_EQ(entries[0].description, "new, seat");
  EXPECT_EQ(entries[0].done_at_us, entries[1].done_at_us);
  EXPECT_EQ(entries[1].description, "retuned");
}

TEST(MaintenanceCsv, FaultsNameTheirLine) {
  EXPECT_EQ(maintenance_failure("loop,at,kind,description\na,2026-03-01,valve,x\na,soon,valve,x\n"),
            "work.csv, line 3: \"soon\" is not a time (write ISO 8601 in the years 1 to 9999, e.g. "
            "2026-03-01T12:00:00Z)");
  EXPECT_EQ(maintenance_failure("loop,at,kind,description\na,2026-03-01,vlave,x\n"),
            "work.csv, line 2: no kind of work \"vlave\", did you mean valve (one of valve, "
            "sensor, tuning, "
            "process, other)");
  EXPECT_EQ(maintenance_failure("loop,at,kind,description\na,2026-03-01,valve,\n"),
            "work.csv, line 2: what was done is not said");
  EXPECT_EQ(maintenance_failure("loop,at,kind\na,2026-03-01,valve\n"),
            "work.csv, line 1: the columns, separated by commas, are loop, at, kind");
  EXPECT_THAT(maintenance_failure("loop,at,kind,description,who\n"),
              HasSubstr("line 1: the columns"));
}

TEST(MaintenanceEntry, WithoutAnOffsetIsMeantInThePlantsZone) {
  const auto done_at = [](const char* at, const TimeZone& zone) {
    return maintenance_entry("a", at, "valve", "x", zone).done_at_us;
  };
  EXPECT_EQ(done_at("2026-03-01 12:00", {}), done_at("2026-03-01T12:00:00Z", {}));
  EXPECT_EQ(done_at("2026-03-01 12:00", TimeZone("Asia/Kolkata")),
            done_at("2026-03-01T06:30:00Z", {}));
  EXPECT_THROW((void)done_at("", {}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::daemon
