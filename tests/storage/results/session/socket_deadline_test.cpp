#include "storage/results/session/socket_deadline.hpp"

#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace loopscope::storage {
namespace {

using std::chrono::seconds;

/// Two sockets that talk to each other, like libpq's and the server's.
class SocketDeadlineTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0); }
  void TearDown() override {
    close(ends[0]);
    close(ends[1]);
  }
  std::array<int, 2> ends{};
  std::atomic<int> told = 0;
  const std::function<void()> tell = [this] { ++told; };
};

TEST_F(SocketDeadlineTest, EndsAWaitThatNobodyAnswers) {
  SocketDeadline deadline(ends[0], seconds(1), tell);
  const SocketDeadline::Guard guard(deadline);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0) << "blocks until the socket is shut down";
  EXPECT_EQ(told, 1) << "before that";
  EXPECT_TRUE(deadline.expired());
}

TEST_F(SocketDeadlineTest, WorkDoneInTimeLeavesTheSocketAlone) {
  SocketDeadline deadline(ends[0], seconds(1), tell);
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500);
  while (std::chrono::steady_clock::now() < until) {
    const SocketDeadline::Guard guard(deadline);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(deadline.expired());
  EXPECT_EQ(told, 0);
  EXPECT_EQ(write(ends[0], "x", 1), 1);
}

TEST_F(SocketDeadlineTest, RestartGivesTheWholeTimeAgain) {
  SocketDeadline deadline(ends[0], seconds(1), tell);
  const SocketDeadline::Guard guard(deadline);
  for (int statement = 0; statement < 3; ++statement) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    deadline.restart();
  }
  EXPECT_FALSE(deadline.expired());
}

TEST_F(SocketDeadlineTest, WithoutPatienceNothingHappens) {
  SocketDeadline deadline(ends[0], std::nullopt, tell);
  const SocketDeadline::Guard guard(deadline);
  EXPECT_FALSE(deadline.expired());
}

}  // namespace
}  // namespace loopscope::storage
