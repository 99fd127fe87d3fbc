#include "daemon/monitor/patient_socket.hpp"

#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class PatientSocketTest : public testing::Test {
 protected:
  void SetUp() override {
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    client = ends[0];
    socket = std::make_unique<PatientSocket>(
        ends[1], [this] { return patience.load(); }, 100);
  }
  void TearDown() override {
    if (client >= 0) close(client);
  }

  void say(const std::string& text) const {
    ASSERT_EQ(send(client, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  std::string read_all() const {
    std::string all;
    std::array<char, 16> bytes{};
    while (const std::size_t size = socket->read(bytes.data(), bytes.size()))
      all.append(bytes.data(), size);
    return all;
  }

  int client = -1;
  std::atomic<std::chrono::milliseconds> patience{10s};
  std::unique_ptr<PatientSocket> socket;
};

TEST_F(PatientSocketTest, ReadsWhatComesUntilTheClientIsDone) {
  say("one two three, and more than one buffer of the reader");
  shutdown(client, SHUT_WR);
  EXPECT_EQ(read_all(), "one two three, and more than one buffer of the reader");
}

TEST_F(PatientSocketTest, ReadsNoMoreThanItsSize) {
  say(std::string(5000, 'x'));
  EXPECT_EQ(read_all(), std::string(100, 'x'));
}

TEST_F(PatientSocketTest, AllReadsTogetherHaveOnePatience) {
  patience = 300ms;
  const std::jthread trickle([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      send(client, "x", 1, MSG_NOSIGNAL);
      std::this_thread::sleep_for(20ms);
    }
  });
  const auto start = Clock::now();
  EXPECT_FALSE(read_all().empty());
  EXPECT_GE(Clock::now() - start, 290ms);
  EXPECT_LT(Clock::now() - start, 2s);
}

TEST_F(PatientSocketTest, PatienceMayEndWhileItWaits) {
  const std::jthread impatience([this] {
    std::this_thread::sleep_for(100ms);
    patience = 0ms;
  });
  const auto start = Clock::now();
  EXPECT_EQ(read_all(), "");
  EXPECT_LT(Clock::now() - start, 2s);
}

TEST_F(PatientSocketTest, WritesWholeTextsAndGivesUpOnTheDeaf) {
  EXPECT_TRUE(socket->write("short"));
  patience = 200ms;
  const auto start = Clock::now();
  EXPECT_FALSE(socket->write(std::string(10'000'000, 'x')));
  EXPECT_LT(Clock::now() - start, 2s);
}

TEST_F(PatientSocketTest, ClientThatHasGoneIsNoSignal) {
  close(client);
  client = -1;
  EXPECT_EQ(read_all(), "");
  EXPECT_FALSE(socket->write(std::string(1'000'000, 'x')));
}

TEST_F(PatientSocketTest, FinishingTakesWhatStillComesButNotForLong) {
  patience = 2s;
  EXPECT_TRUE(socket->write("answer"));
  say("a body that nobody wants");
  const auto start = Clock::now();
  socket->finish();
  EXPECT_LT(Clock::now() - start, 1s);
  socket.reset();
  std::array<char, 64> bytes{};
  EXPECT_EQ(recv(client, bytes.data(), bytes.size(), 0), 6) << "the answer, and no reset before it";
}

}  // namespace
}  // namespace loopscope::daemon
