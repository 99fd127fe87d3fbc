#include "daemon/report/folder_lock.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "daemon/text/failure.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

class FolderLockTest : public testing::Test {
 protected:
  tests::TemporaryFolder folder;
  fs::path file = folder.path() / ".loopscope-report.lock";
};

TEST_F(FolderLockTest, OneHoldsItUntilHeIsGone) {
  {
    const FolderLock first(folder.path());
    EXPECT_TRUE(first.held());
    EXPECT_FALSE(FolderLock(folder.path()).held());
  }
  EXPECT_TRUE(FolderLock(folder.path()).held());
}

TEST_F(FolderLockTest, WhoeverMayWriteIntoTheFolderMayTakeIt) {
  fs::permissions(folder.path(), fs::perms(0770));
  const FolderLock lock(folder.path());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0660));
}

// Who can open it, for reading alone, can hold it for ever.
TEST_F(FolderLockTest, NobodyElseMayTakeIt) {
  fs::permissions(folder.path(), fs::perms(0755));
  const FolderLock lock(folder.path());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0600));
  fs::permissions(folder.path(), fs::perms(0775));
  const FolderLock second(folder.path());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0660));
  fs::permissions(folder.path(), fs::perms(0757));
  const FolderLock third(folder.path());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0666));
}

TEST_F(FolderLockTest, TheGroupIsTheFoldersAndNotItsMakers) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder to any group";
  ASSERT_EQ(chown(folder.path().c_str(), 65534, 100), 0);
  fs::permissions(folder.path(), fs::perms(0770));
  const FolderLock lock(folder.path());
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_gid, 100U);
}

// Under fs.protected_regular, which systemd sets, nobody may open it there as if to make it.
TEST_F(FolderLockTest, OneOfAnotherUserInAStickyFolderIsTaken) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
  fs::permissions(folder.path(), fs::perms(01777));
  std::ofstream stream(file);
  ASSERT_EQ(chown(file.c_str(), 65534, 65534), 0);
  EXPECT_TRUE(FolderLock(folder.path()).held());
}

TEST_F(FolderLockTest, APlantedLinkIsNotFollowed) {
  const fs::path victim = folder.path() / "victim";
  fs::create_symlink(victim, file);
  try {
    const FolderLock lock(folder.path());
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
  fs::create_directory_symlink(folder.path(), link);
  EXPECT_TRUE(FolderLock(link).held());
  fs::remove(file);
  ASSERT_EQ(lchown(link.c_str(), 65534, 65534), 0);
  EXPECT_THROW(FolderLock{link}, Failure);
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(FolderLockTest, SaysWhereItCannotBe) {
  EXPECT_THROW(FolderLock(folder.path() / "none"), Failure);
}

}  // namespace
}  // namespace loopscope::daemon
