#include "config/read_bounded.hpp"

#include <chrono>
#include <fcntl.h>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "tests/support/source_dir.hpp"

namespace loopscope::config::tests {
namespace {

using loopscope::tests::TemporaryFolder;
using testing::HasSubstr;

constexpr std::size_t kMost = 1000;

std::string refusal(const std::filesystem::path& file, int patience_s = 1) {
  try {
    static_cast<void>(read_bounded(file, kMost, patience_s));
    return "read";
  } catch (const UnreadableFile& error) {
    EXPECT_NE(error.hint(), "");
    return error.what();
  }
}

class ReadBounded : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_.path() / "file") << text;
    return folder_.path() / "file";
  }
  [[nodiscard]] std::filesystem::path pipe() const {
    const std::filesystem::path pipe = folder_.path() / "pipe";
    EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    return pipe;
  }

  TemporaryFolder folder_;
};

TEST_F(ReadBounded, FilesAreReadWholeUpToTheLimit) {
  EXPECT_EQ(read_bounded(write(""), kMost, 1), "");
  EXPECT_EQ(read_bounded(write("a\nb"), kMost, 1), "a\nb");
  EXPECT_EQ(read_bounded(write(std::string(kMost, 'x')), kMost, 1).size(), kMost);
  EXPECT_THAT(refusal(write(std::string(kMost + 1, 'x'))), HasSubstr("is larger than"));
  const std::string large(1'000'000, 'y');
  EXPECT_EQ(read_bounded(write(large), large.size(), 1), large);
}

TEST_F(ReadBounded, WhatIsNoTextFileSaysSo) {
  EXPECT_THAT(refusal(folder_.path() / "absent"), HasSubstr("No such file"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is a folder"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is not text"));
  EXPECT_THAT(refusal("/dev/urandom"),
              testing::AnyOf(HasSubstr("is not text"), HasSubstr("larger")));
  EXPECT_EQ(read_bounded("/dev/null", kMost, 1), "");
}

TEST_F(ReadBounded, AFileOfAGigabyteIsNotRead) {
  const std::filesystem::path file = write("x");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 30U);
  EXPECT_THAT(refusal(file), HasSubstr("is larger than"));
}

TEST_F(ReadBounded, APipeThatNobodyWritesToIsGivenUp) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(refusal(pipe()), HasSubstr("gives nothing"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST_F(ReadBounded, AWriterThatSaysNothingIsGivenUpToo) {
  const std::filesystem::path path = pipe();
  const int both = open(path.c_str(), O_RDWR);
  EXPECT_THAT(refusal(path), HasSubstr("gives nothing"));
  close(both);
}

TEST_F(ReadBounded, APipeIsReadToItsEnd) {
  const std::filesystem::path path = pipe();
  std::thread writer([&path] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    std::ofstream stream(path);
    stream << "first " << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stream << "second";
  });
  EXPECT_EQ(read_bounded(path, kMost, 5), "first second");
  writer.join();
}

}  // namespace
}  // namespace loopscope::config::tests
