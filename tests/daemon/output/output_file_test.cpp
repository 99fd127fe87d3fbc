#include "daemon/output/output_file.hpp"

#include <fcntl.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "daemon/output/followed_path.hpp"
#include "daemon/text/failure.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;

/// What write_file_test.cpp shows of whole contents holds for pieces too.
class OutputFileTest : public testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "out.csv";
  fs::path victim_ = folder_.path() / "victim.txt";

  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), {}));
  }

  /// The one file of the folder that is neither out.csv nor victim.txt.
  [[nodiscard]] fs::path partial() const {
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      if (entry.path() != file_ && entry.path() != victim_) return entry.path();
    }
    return {};
  }

  void write(const std::string& text) {
    OutputFile output(file_);
    output.write(text);
    output.finish();
  }

  static std::string refusal_of(const fs::path& file) {
    try {
      const OutputFile output(file);
      return "opened";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::usage);
      return std::string(failure.what()) + " HINT: " + failure.hint();
    }
  }

  /// What a writer leaves that is killed in the middle.
  void die_while_writing() {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      OutputFile output(file_);
      output.write("half of it");
      _exit(0);
    }
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
  }
};

unsigned mode_of(const fs::path& file) {
  struct stat status {};
  return lstat(file.c_str(), &status) == 0 ? status.st_mode & 07777U : 0U;
}

/// For as long as it lives new files get what `mask` leaves.
class Umask {
 public:
  explicit Umask(mode_t mask) : former_(umask(mask)) {}
  ~Umask() { umask(former_); }
  Umask(const Umask&) = delete;
  Umask& operator=(const Umask&) = delete;

 private:
  mode_t former_;
};

TEST_F(OutputFileTest, AppearsWhenItIsFinished) {
  OutputFile output(file_);
  output.write("a\n");
  output.write("b\n");
  EXPECT_FALSE(fs::exists(file_));
  output.finish();
  EXPECT_EQ(tests::content_of(file_), "a\nb\n");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(OutputFileTest, LeavesTheOldOneWhereItIsGivenUp) {
  std::ofstream(file_) << "old";
  { OutputFile(file_).write("new"); }
  EXPECT_EQ(tests::content_of(file_), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(OutputFileTest, SaysWhichFileCannotBeWritten) {
  EXPECT_THROW(OutputFile(folder_.path() / "none" / "x"), Failure);
  OutputFile full("/dev/full");
  EXPECT_THROW(
      {
        full.write("x");
        full.finish();
      },
      Failure);
}

TEST_F(OutputFileTest, MorePiecesThanItHoldsInMemory) {
  const std::string piece(1000, 'x');
  OutputFile output(file_);
  for (int k = 0; k < 200; ++k) output.write(piece);
  output.finish();
  EXPECT_EQ(fs::file_size(file_), 200'000U);
}

// Whoever owns the folder may plant links in it, and the number of a process is soon guessed.
TEST_F(OutputFileTest, ALinkPlantedUnderAGuessedNameLeadsNowhere) {
  std::ofstream(victim_) << "secret";
  fs::create_symlink(victim_,
                     folder_.path() / (".loopscope-" + std::to_string(getpid()) + ".partial"));
  write("text");
  EXPECT_EQ(tests::content_of(victim_), "secret");
  EXPECT_EQ(tests::content_of(file_), "text");
  EXPECT_FALSE(fs::is_symlink(file_));
}

TEST_F(OutputFileTest, AnotherNameForEachWriter) {
  OutputFile first(file_);
  const fs::path name = partial();
  OutputFile second(folder_.path() / "second.csv");
  EXPECT_EQ(entries(), 2U);
  EXPECT_THAT(name.filename().string(),
              testing::MatchesRegex(R"(\.loopscope-[0-9a-f]{16}\.partial)"));
}

TEST_F(OutputFileTest, ALinkOfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a link to another user";
  std::ofstream(victim_) << "secret";
  fs::create_symlink(victim_, file_);
  ASSERT_EQ(lchown(file_.c_str(), 65534, 65534), 0);
  try {
    write("text");
    FAIL() << "the link was followed";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_THAT(failure.what(), testing::HasSubstr(file_.string()));
    EXPECT_THAT(failure.hint(), testing::HasSubstr("link"));
  }
  EXPECT_EQ(tests::content_of(victim_), "secret");
}

// In a folder of root's that its owner could not enter otherwise.
TEST_F(OutputFileTest, ALinkOfAnotherUserToAFolderIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a link to another user";
  const fs::path inner = folder_.path() / "inner";
  fs::create_directory(inner);
  std::ofstream(inner / "out.csv") << "secret";
  const fs::path planted = folder_.path() / "planted";
  fs::create_directory_symlink(inner, planted);
  ASSERT_EQ(lchown(planted.c_str(), 65534, 65534), 0);
  fs::create_directory_symlink(planted, folder_.path() / "own");
  for (const fs::path& file : {planted / "out.csv", planted / "new.csv", planted / "." / "out.csv",
                               folder_.path() / "own" / "out.csv"})
    EXPECT_THAT(refusal_of(file),
                testing::AllOf(testing::HasSubstr(file.string() + ": planted is a link"),
                               testing::HasSubstr("HINT: name what the link leads to")));
  EXPECT_THROW(make_folders(planted / "reports"), Failure);
  EXPECT_FALSE(fs::exists(inner / "reports"));
  EXPECT_EQ(tests::content_of(inner / "out.csv"), "secret");
  EXPECT_FALSE(fs::exists(inner / "new.csv"));
}

TEST_F(OutputFileTest, LinksOfItsOwnToFoldersAreFollowed) {
  fs::create_directories(folder_.path() / "inner" / "deep");
  fs::create_directory_symlink("inner/deep/", folder_.path() / "relative");
  fs::create_directory_symlink(folder_.path() / "relative", folder_.path() / "absolute");
  make_folders(folder_.path() / "absolute" / "a" / "b" / "");
  EXPECT_TRUE(fs::is_directory(folder_.path() / "inner" / "deep" / "a" / "b"));
  file_ = folder_.path() / "absolute" / ".." / "out.csv";
  write("text");
  EXPECT_EQ(tests::content_of(folder_.path() / "inner" / "out.csv"), "text");
}

TEST_F(OutputFileTest, LinksInACircleAndFilesAsFoldersAreRefused) {
  fs::create_symlink("two", folder_.path() / "one");
  fs::create_symlink("one", folder_.path() / "two");
  std::ofstream(victim_) << "secret";
  EXPECT_THAT(refusal_of(folder_.path() / "one"), testing::HasSubstr("symbolic links"));
  EXPECT_THAT(refusal_of(folder_.path() / "one" / "x"), testing::HasSubstr("symbolic links"));
  EXPECT_THAT(refusal_of(victim_ / "x"), testing::HasSubstr("Not a directory"));
  EXPECT_THAT(refusal_of(folder_.path() / ""), testing::HasSubstr("Is a directory"));
  EXPECT_THAT(refusal_of(""), testing::HasSubstr("No such file"));
}

TEST_F(OutputFileTest, AFolderBelowProcIsEnteredAsItIs) {
  const int folder = open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_GE(folder, 0);
  file_ = "/dev/fd/" + std::to_string(folder) + "/out.csv";
  write("text");
  close(folder);
  EXPECT_EQ(tests::content_of(folder_.path() / "out.csv"), "text");
}

TEST_F(OutputFileTest, APipeThatNobodyReadsIsRefusedAtOnce) {
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(refusal_of(file_),
              testing::AllOf(testing::HasSubstr("it is a pipe that nobody reads"),
                             testing::HasSubstr("HINT: start its reader")));
}

TEST_F(OutputFileTest, APipeOfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a pipe to another user";
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  ASSERT_EQ(chown(file_.c_str(), 65534, 65534), 0);
  const int reader = open(file_.c_str(), O_RDONLY | O_NONBLOCK);
  EXPECT_THAT(refusal_of(file_), testing::HasSubstr("it is a pipe that another user"));
  close(reader);
}

TEST_F(OutputFileTest, IsItsWritersAloneUntilItIsThere) {
  const Umask mask(022);
  OutputFile output(file_);
  output.write("text");
  EXPECT_EQ(mode_of(partial()), 0600U);
  output.finish();
  EXPECT_EQ(mode_of(file_), 0644U);
}

TEST_F(OutputFileTest, HasWhatTheMaskLeaves) {
  const Umask mask(027);
  write("text");
  EXPECT_EQ(mode_of(file_), 0640U);
}

TEST_F(OutputFileTest, KeepsThePermissionsButNoRightToRunAsItsOwner) {
  std::ofstream(file_) << "old";
  ASSERT_EQ(chmod(file_.c_str(), 06750), 0);
  write("new");
  EXPECT_EQ(mode_of(file_), 0750U);
}

TEST_F(OutputFileTest, AFileOfAnotherUserMakesItNoWiderThanANewOne) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
  const Umask mask(022);
  std::ofstream(file_) << "old";
  ASSERT_EQ(chmod(file_.c_str(), 0666), 0);
  ASSERT_EQ(chown(file_.c_str(), 65534, 65534), 0);
  write("new");
  EXPECT_EQ(mode_of(file_), 0644U);
}

TEST_F(OutputFileTest, RemovesWhatADeadWriterHasLeft) {
  die_while_writing();
  ASSERT_EQ(entries(), 1U);
  write("text");
  EXPECT_EQ(entries(), 1U);
  EXPECT_EQ(tests::content_of(file_), "text");
}

TEST_F(OutputFileTest, LeavesAloneWhatIsStillWritten) {
  OutputFile slow(file_);
  slow.write("slow");
  const fs::path other = folder_.path() / "other.csv";
  {
    OutputFile quick(other);
    quick.write("quick");
    quick.finish();
  }
  slow.finish();
  EXPECT_EQ(tests::content_of(file_), "slow");
  EXPECT_EQ(tests::content_of(other), "quick");
}

TEST_F(OutputFileTest, RemovesNothingThatOnlyLooksLikeOne) {
  const fs::path looks = folder_.path() / ".loopscope-0123456789abcdef.partial";
  std::ofstream(victim_) << "secret";
  fs::create_symlink(victim_, looks);
  fs::create_directory(folder_.path() / ".loopscope-00000000000000aa.partial");
  std::ofstream(folder_.path() / ".loopscope-notes.partial") << "a person's";
  write("text");
  EXPECT_EQ(entries(), 5U);
  EXPECT_EQ(tests::content_of(victim_), "secret");
}

}  // namespace
}  // namespace loopscope::daemon
