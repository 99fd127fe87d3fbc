#include "daemon/report/folder_lock.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "daemon/failure.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

class FolderLockTest : public testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  fs::path file_ = folder_.path() / ".loopscope-report.lock";
};

TEST_F(FolderLockTest, OneHoldsItUntilHeIsGone) {
  {
    const FolderLock first(folder_.path());
    EXPECT_TRUE(first.held());
    EXPECT_FALSE(FolderLock(folder_.path()).held());
  }
  EXPECT_TRUE(FolderLock(folder_.path()).held());
}

TEST_F(FolderLockTest, WhoeverMayWriteIntoTheFolderMayTakeIt) {
  fs::permissions(folder_.path(), fs::perms(0770));
  const FolderLock lock(folder_.path());
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms(0660));
}

TEST_F(FolderLockTest, APlantedLinkIsNotFollowed) {
  const fs::path victim = folder_.path() / "victim";
  fs::create_symlink(victim, file_);
  try {
    const FolderLock lock(folder_.path());
    FAIL() << "the link was followed";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_THAT(failure.hint(), testing::HasSubstr("link"));
  }
  EXPECT_FALSE(fs::exists(victim));
}

TEST_F(FolderLockTest, NorALinkToTheFolderThatAnotherUserHasMade) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a link to another user";
  const tests::TemporaryFolder other;
  const fs::path link = other.path() / "reports";
  fs::create_directory_symlink(folder_.path(), link);
  EXPECT_TRUE(FolderLock(link).held());
  fs::remove(file_);
  ASSERT_EQ(lchown(link.c_str(), 65534, 65534), 0);
  EXPECT_THROW(FolderLock{link}, Failure);
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(FolderLockTest, SaysWhereItCannotBe) {
  EXPECT_THROW(FolderLock(folder_.path() / "none"), Failure);
}

}  // namespace
}  // namespace loopscope::daemon
