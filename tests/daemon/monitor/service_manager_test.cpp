#include "daemon/monitor/service_manager.hpp"

#include <array>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;

/// What systemd holds at the other end: a datagram socket, here of the abstract kind.
class ServiceManagerTest : public testing::Test {
 protected:
  void SetUp() override { listen(); }

  void TearDown() override {
    close(descriptor);
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
  }

  void listen() {
    descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ASSERT_GE(descriptor, 0);
    const std::string name = "loopscope-test-" + std::to_string(getpid());
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.data(), name.size());
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    ASSERT_EQ(bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size), 0);
    setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
  }

  /// The next message that has arrived; "" = none.
  [[nodiscard]] std::string message() const {
    std::array<char, 4096> text{};
    const ssize_t size = recv(descriptor, text.data(), text.size(), MSG_DONTWAIT);
    return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
  }

  int descriptor = -1;
};

TEST_F(ServiceManagerTest, TellsWhatHappens) {
  ServiceManager::ready("8 workers");
  EXPECT_EQ(message(), "READY=1\nSTATUS=8 workers");
  ServiceManager::reloading();
  EXPECT_EQ(message(), "RELOADING=1");
  ServiceManager::stopping("finishing what is in hand");
  EXPECT_EQ(message(), "STOPPING=1\nSTATUS=finishing what is in hand");
  ServiceManager::status("waits for the results database");
  EXPECT_EQ(message(), "STATUS=waits for the results database");
  ServiceManager::feed_watchdog();
  EXPECT_EQ(message(), "WATCHDOG=1");
  ServiceManager::extend_timeout(90s);
  EXPECT_EQ(message(), "EXTEND_TIMEOUT_USEC=90000000");
  EXPECT_EQ(message(), "");
}

TEST_F(ServiceManagerTest, TextCannotAssignAnythingElse) {
  ServiceManager::status("historian x\nWATCHDOG=1\nMAINPID=1");
  EXPECT_EQ(message(), "STATUS=historian x WATCHDOG=1 MAINPID=1");
  ServiceManager::status(std::string(5000, 'x'));
  EXPECT_EQ(message().size(), 7U + 512U);
}

TEST_F(ServiceManagerTest, WatchdogTimeIsTheUnits) {
  EXPECT_EQ(ServiceManager::watchdog_time(), std::nullopt);
  setenv("WATCHDOG_USEC", "60000000", 1);
  EXPECT_EQ(ServiceManager::watchdog_time(), 60s);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_EQ(ServiceManager::watchdog_time(), 60s);
  setenv("WATCHDOG_PID", std::to_string(getppid()).c_str(), 1);
  EXPECT_EQ(ServiceManager::watchdog_time(), std::nullopt);
}

TEST_F(ServiceManagerTest, NothingHappensOutsideSystemd) {
  unsetenv("NOTIFY_SOCKET");
  ServiceManager::ready("x");
  ServiceManager::feed_watchdog();
  EXPECT_EQ(message(), "");
}

TEST_F(ServiceManagerTest, ManagerThatHasGoneIsNoError) {
  close(descriptor);
  EXPECT_NO_THROW(ServiceManager::ready("x"));
  EXPECT_NO_THROW(ServiceManager::feed_watchdog());
  listen();
  EXPECT_EQ(message(), "") << "what nobody heard is not told again";
  ServiceManager::status("back");
  EXPECT_EQ(message(), "STATUS=back") << "one that comes back hears what follows";
}

TEST_F(ServiceManagerTest, MessagesOfManyThreadsArriveWhole) {
  std::vector<std::jthread> threads;
  for (int number = 0; number < 4; ++number) {
    threads.emplace_back([] {
      // As many as the socket's queue holds (net.unix.max_dgram_qlen is 10 at least).
      for (int round = 0; round < 2; ++round) ServiceManager::feed_watchdog();
    });
  }
  threads.clear();
  for (int count = 0; count < 8; ++count) EXPECT_EQ(message(), "WATCHDOG=1");
}

}  // namespace
}  // namespace loopscope::daemon
