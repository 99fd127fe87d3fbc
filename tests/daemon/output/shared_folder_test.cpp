#include <fcntl.h>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "daemon/output/output_file.hpp"
#include "daemon/text/failure.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kNobody = 65534;
constexpr unsigned kUsers = 100;

/// Output where other users are near: of the files, of the folder, of what was handed over. Root
/// alone can make such.
class SharedFolder : public testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
    umask(022);
    fs::permissions(folder.path(), fs::perms(0777));
  }

  [[nodiscard]] fs::path old_file(unsigned user, unsigned group, mode_t mode) const {
    const fs::path file = folder.path() / "out.csv";
    std::ofstream(file) << "old";
    EXPECT_EQ(chown(file.c_str(), user, group), 0);
    EXPECT_EQ(chmod(file.c_str(), mode), 0);
    return file;
  }

  /// Exit code of a process of the user nobody, who is in no other group.
  static int as_nobody(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
      // Else its own /proc/self would be root's.
      if (setgroups(0, nullptr) != 0 || setgid(kNobody) != 0 || setuid(kNobody) != 0 ||
          prctl(PR_SET_DUMPABLE, 1) != 0)
        _exit(2);
      try {
        work();
      } catch (const Failure& failure) {
        fprintf(stderr, "%s\n", failure.what());
        _exit(1);
      }
      _exit(0);
    }
    int status = -1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  static std::string refusal_of(const fs::path& file) {
    try {
      write_file(file, "text");
      return "written";
    } catch (const Failure& failure) {
      return std::string(failure.what()) + " HINT: " + failure.hint();
    }
  }

  tests::TemporaryFolder folder;
};

struct stat attributes_of(const fs::path& file) {
  struct stat status {};
  EXPECT_EQ(lstat(file.c_str(), &status), 0);
  return status;
}

unsigned permissions_of(const fs::path& file) {
  return attributes_of(file).st_mode & 07777U;
}

TEST_F(SharedFolder, AReplacedFileKeepsItsGroup) {
  const fs::path file = old_file(0, kUsers, 0640);
  write_file(file, "new");
  EXPECT_EQ(attributes_of(file).st_gid, kUsers);
  EXPECT_EQ(permissions_of(file), 0640U);
}

// Its writer's own group has not been given anything.
TEST_F(SharedFolder, AGroupThatCannotBeKeptIsNoGain) {
  const fs::path file = old_file(kNobody, kUsers, 0640);
  EXPECT_EQ(as_nobody([&] { write_file(file, "new"); }), 0);
  EXPECT_EQ(attributes_of(file).st_gid, kNobody);
  EXPECT_EQ(permissions_of(file), 0600U);
  const fs::path open_file = old_file(kNobody, kUsers, 0664);
  EXPECT_EQ(as_nobody([&] { write_file(open_file, "new"); }), 0);
  EXPECT_EQ(permissions_of(open_file), 0644U);
}

TEST_F(SharedFolder, NorIsTheGroupOfAnotherUsersFile) {
  const fs::path file = old_file(kNobody, kUsers, 0640);
  write_file(file, "new");
  EXPECT_EQ(permissions_of(file), 0600U);
}

// With a list the bits of the group are the most that anybody in the list has.
TEST_F(SharedFolder, NorIsAnAccessList) {
  const fs::path file = old_file(0, kUsers, 0600);
  // Version 2; user rw, user 100 r, group nothing, mask r, others nothing.
  constexpr unsigned char kList[] = {
      2, 0,   0,    0,    1,    0,    6,  0, 0xff, 0xff, 0xff, 0xff, 2,    0,   4,
      0, 100, 0,    0,    0,    4,    0,  0, 0,    0xff, 0xff, 0xff, 0xff, 16,  0,
      4, 0,   0xff, 0xff, 0xff, 0xff, 32, 0, 0,    0,    0xff, 0xff, 0xff, 0xff};
  if (setxattr(file.c_str(), "system.posix_acl_access", kList, sizeof kList, 0) != 0)
    GTEST_SKIP() << "no access lists on this file system";
  ASSERT_EQ(permissions_of(file), 0640U);
  write_file(file, "new");
  EXPECT_EQ(permissions_of(file), 0600U);
}

// Who may write into the folder can rename a link of its writer's to the name of the output.
TEST_F(SharedFolder, ALinkThatOthersMayRenameIsRefused) {
  const fs::path victim = folder.path() / "inner" / "victim.txt";
  fs::create_directory(victim.parent_path());
  std::ofstream(victim) << "secret";
  const fs::path link = folder.path() / "link";
  const fs::path on_the_way = folder.path() / "way";
  fs::create_symlink(victim, link);
  fs::create_directory_symlink("inner", on_the_way);
  const auto expect_refused = [&](const std::string& why) {
    for (const fs::path& file : {link, on_the_way / "victim.txt"})
      EXPECT_THAT(refusal_of(file), testing::AllOf(testing::HasSubstr("is a link that others"),
                                                   testing::HasSubstr("HINT: name what")))
          << why;
    EXPECT_EQ(tests::content_of(victim), "secret") << why;
  };
  expect_refused("everybody may write");
  fs::permissions(folder.path(), fs::perms(0775));
  ASSERT_EQ(chown(folder.path().c_str(), 0, kUsers), 0);
  expect_refused("another group may write");
  fs::permissions(folder.path(), fs::perms(01755));
  ASSERT_EQ(chown(folder.path().c_str(), kNobody, 0), 0);
  expect_refused("another user has the folder");
}

TEST_F(SharedFolder, ALinkThatNobodyElseMayRenameIsFollowed) {
  const fs::path link = folder.path() / "link";
  fs::create_symlink("out.csv", link);
  for (const auto mode : {01777U, 01775U, 0775U, 0700U}) {
    fs::permissions(folder.path(), fs::perms(mode));
    EXPECT_EQ(refusal_of(link), "written") << mode;
  }
}

// Of `sudo -u`, whose caller has made the pipe.
TEST_F(SharedFolder, WhatAnotherUserHasHandedOverOpenIsWritten) {
  int pipe[2];
  ASSERT_EQ(pipe2(pipe, O_CLOEXEC), 0);
  const fs::path file = old_file(0, 0, 0600);
  const int opened = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  const auto write_to = [](int number) {
    return as_nobody([&] { write_file("/dev/fd/" + std::to_string(number), "text"); });
  };
  EXPECT_EQ(write_to(pipe[1]), 0);
  EXPECT_EQ(write_to(opened), 0);
  close(pipe[1]);
  char text[10];
  EXPECT_EQ(read(pipe[0], text, sizeof text), 4);
  EXPECT_EQ(tests::content_of(file).substr(0, 4), "text");
  close(pipe[0]);
  close(opened);
}

// In a user namespace without root his /proc seems to be another user's.
TEST_F(SharedFolder, AnOpenFileIsFoundWhereRootHasNoNumber) {
  const fs::path file = old_file(kNobody, kNobody, 0600);
  const int opened = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  const int code = as_nobody([&] {
    if (unshare(CLONE_NEWUSER) != 0) _exit(77);
    std::ofstream("/proc/self/uid_map") << "1000 65534 1";
    write_file("/proc/self/fd/" + std::to_string(opened), "text");
  });
  close(opened);
  if (code == 77) GTEST_SKIP() << "no user namespaces";
  EXPECT_EQ(code, 0);
  EXPECT_EQ(tests::content_of(file), "text");
}

}  // namespace
}  // namespace loopscope::daemon
