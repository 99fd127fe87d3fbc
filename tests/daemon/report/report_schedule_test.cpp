#include "daemon/report/report_schedule.hpp"

#include <chrono>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <unistd.h>

#include "daemon/report/folder_lock.hpp"
#include "daemon/text/failure.hpp"
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

// Pages that may not be removed, of another user's in a sticky folder, stand for it.
TEST(ReportSchedule, OneThatCannotBeRemovedKeepsNoneOfTheOthers) {
  const tests::TemporaryFolder folder;
  const fs::path stays = folder.path() / "loopscope-2000-01-01T0000Z.html";
  fs::create_directories(stays / "full");
  const fs::path old = folder.path() / "loopscope-2026-03-01T0000Z.html";
  const fs::path newest = folder.path() / "loopscope-2026-03-03T0000Z.html";
  for (const fs::path& file : {old, newest}) touch(file);
  drop_old_reports(folder.path(), 1, "loopscope-2026-03-03T0000Z");
  EXPECT_TRUE(fs::exists(stays));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(newest));
}

TEST(ReportSchedule, NoneIsRemovedThroughALinkOfAnotherUser) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a link to another user";
  const tests::TemporaryFolder folder;
  const tests::TemporaryFolder other;
  const fs::path old = folder.path() / "loopscope-2026-03-01T0000Z.html";
  for (const fs::path& file : {old, folder.path() / "loopscope-2026-03-03T0000Z.html"}) touch(file);
  const fs::path link = other.path() / "reports";
  fs::create_directory_symlink(folder.path(), link);
  ASSERT_EQ(lchown(link.c_str(), 65534, 65534), 0);
  EXPECT_THROW(drop_old_reports(link, 1, "loopscope-2026-03-03T0000Z"), Failure);
  EXPECT_TRUE(fs::exists(old));
}

// Somebody holds the lock and writes no report.
TEST(ReportSchedule, ALockThatIsNeverFreeIsAFault) {
  const tests::TemporaryFolder folder;
  const FolderLock taken(folder.path());
  config::Settings settings;
  settings.report.folder = folder.path();
  settings.report.every_s = 0.2;
  Metrics metrics({"0.0", 0, "portable"});
  FaultLog faults(metrics);
  ReportSchedule schedule(std::make_shared<config::Settings>(settings), faults);
  const auto is_fault = [&] {
    return metrics.text().find("subject=\"report\"") != std::string::npos;
  };
  EXPECT_FALSE(is_fault());
  for (int looks = 0; looks < 100 && !is_fault(); ++looks) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    schedule.use(std::make_shared<config::Settings>(settings));
  }
  EXPECT_TRUE(is_fault());
}

}  // namespace
}  // namespace loopscope::daemon
