#include "daemon/report/report_schedule.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& file) {
  std::ofstream stream(file);
}

TEST(ReportSchedule, NamesReportsByTheEndOfTheirSpan) {
  EXPECT_EQ(report_name(1'772'366'400'000'000), "loopscope-2026-03-01T1200Z");
}

TEST(ReportSchedule, KeepsTheNewestAndTouchesNothingElse) {
  const tests::TemporaryFolder folder;
  for (const char* name : {"loopscope-2026-03-01T0000Z.html", "loopscope-2026-03-01T0000Z.pdf",
                           "loopscope-2026-03-02T0000Z.html", "loopscope-2026-03-03T0000Z.html",
                           "loopscope-2026-03-03T0000Z.pdf", "loopscope-2026-03-03T0000Z.html.bak",
                           "loopscope.html", "report.html"})
    touch(folder.path() / name);
  drop_old_reports(folder.path(), 2, "loopscope-2026-03-03T0000Z");
  EXPECT_FALSE(fs::exists(folder.path() / "loopscope-2026-03-01T0000Z.html"));
  EXPECT_FALSE(fs::exists(folder.path() / "loopscope-2026-03-01T0000Z.pdf"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 6);
  drop_old_reports(folder.path(), 5, "loopscope-2026-03-03T0000Z");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 6);
}

// The newest one would else be written and removed again at every look.
TEST(ReportSchedule, OnesOfTheFutureTakeNoPlaceOfTheNewest) {
  const tests::TemporaryFolder folder;
  const fs::path before = folder.path() / "loopscope-2026-03-02T0000Z.html";
  const fs::path newest = folder.path() / "loopscope-2026-03-03T0000Z.html";
  const fs::path future = folder.path() / "loopscope-2026-04-12T0000Z.html";
  for (const fs::path& file : {before, newest, future}) touch(file);
  drop_old_reports(folder.path(), 1, "loopscope-2026-03-03T0000Z");
  EXPECT_FALSE(fs::exists(before));
  EXPECT_TRUE(fs::exists(newest));
  EXPECT_TRUE(fs::exists(future));
}

}  // namespace
}  // namespace loopscope::daemon
