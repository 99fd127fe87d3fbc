#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "daemon/output/output_file.hpp"
#include "daemon/text/failure.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class WriteFile : public testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }

  static std::string content_of(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  [[nodiscard]] std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(folder_.path()), {});
  }

  static std::string failure_of(const fs::path& file) {
    try {
      write_file(file, "text");
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::usage);
      EXPECT_FALSE(failure.hint().empty());
      EXPECT_THAT(failure.what(), HasSubstr(file.string()));
      return failure.what();
    }
    return "written";
  }

  tests::TemporaryFolder folder_;
};

/// Files of this process may hold `bytes` at most: the nearest to a full disk that needs no rights.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : former_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &former_);
    const rlimit limit{bytes, former_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &former_);
    std::signal(SIGXFSZ, former_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*former_handler_)(int);
  rlimit former_{};
};

TEST_F(WriteFile, ReplacesAFileAndLeavesNothingBeside) {
  write_file(path("out.csv"), "the first, longer one");
  fs::permissions(path("out.csv"), fs::perms::owner_read | fs::perms::owner_write);
  write_file(path("out.csv"), "second");
  EXPECT_EQ(content_of(path("out.csv")), "second");
  EXPECT_EQ(fs::status(path("out.csv")).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(entries(), 1);
}

TEST_F(WriteFile, ANameAsLongAsTheSystemAllows) {
  const fs::path file = path(std::string(255, 'n'));
  write_file(file, "text");
  EXPECT_EQ(content_of(file), "text");
}

TEST_F(WriteFile, ReplacesWhatALinkPointsTo) {
  fs::create_directory(path("inner"));
  write_file(path("inner/out.csv"), "first");
  fs::create_symlink("inner/out.csv", path("link"));
  fs::create_symlink(path("link"), path("link_to_link"));
  write_file(path("link_to_link"), "second");
  EXPECT_TRUE(fs::is_symlink(path("link")) && fs::is_symlink(path("link_to_link")));
  EXPECT_EQ(content_of(path("inner/out.csv")), "second");
}

TEST_F(WriteFile, MakesTheFileThatALinkPromises) {
  fs::create_symlink("later.csv", path("link"));
  write_file(path("link"), "text");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content_of(path("later.csv")), "text");
}

TEST_F(WriteFile, WritesIntoAPipeInsteadOfReplacingIt) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const int reader = open(path("pipe").c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_file(path("pipe"), "through the pipe");
  std::string got(100, '\0');
  const ssize_t size = read(reader, got.data(), got.size());
  close(reader);
  EXPECT_EQ(got.substr(0, static_cast<std::size_t>(std::max<ssize_t>(size, 0))),
            "through the pipe");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(WriteFile, AnOpenFileWithoutANameIsWrittenThroughItsDescriptor) {
  const int file = open(path("gone").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(file, 0);
  fs::remove(path("gone"));
  write_file("/proc/self/fd/" + std::to_string(file), "text");
  struct stat status {};
  ASSERT_EQ(fstat(file, &status), 0);
  close(file);
  EXPECT_EQ(status.st_size, 4);
  EXPECT_EQ(entries(), 0);
}

TEST_F(WriteFile, ADeviceThatTakesNothingIsReported) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "/dev/full is not there";
  fs::create_symlink("/dev/full", path("full"));
  EXPECT_THAT(failure_of(path("full")), HasSubstr("No space left on device"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_TRUE(fs::is_symlink(path("full")));
}

TEST_F(WriteFile, AFailedWriteLeavesTheOldFile) {
  write_file(path("out.csv"), "old");
  std::string problem;
  {
    const FileSizeLimit limit(2);
    problem = failure_of(path("out.csv"));
  }
  EXPECT_THAT(problem, HasSubstr("File too large"));
  EXPECT_EQ(content_of(path("out.csv")), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(WriteFile, SaysWhyAFileCannotBeWritten) {
  EXPECT_THAT(failure_of(path("missing/out.csv")), HasSubstr("No such file or directory"));
  fs::create_directory(path("taken"));
  EXPECT_THAT(failure_of(path("taken")), HasSubstr("Is a directory"));
  fs::create_symlink("loop", path("loop"));
  EXPECT_THAT(failure_of(path("loop")), HasSubstr("Too many levels of symbolic links"));
  EXPECT_EQ(entries(), 2);
}

}  // namespace
}  // namespace loopscope::daemon
