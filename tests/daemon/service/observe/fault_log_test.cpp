#include "daemon/service/observe/fault_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <sstream>

namespace loopscope::daemon {
namespace {

/// Gathers what is logged while it lives.
class LoggedLines {
 public:
  LoggedLines() : before_(spdlog::default_logger()) {
    auto logger = std::make_shared<spdlog::logger>(
        "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_));
    logger->set_pattern("%l %v");
    spdlog::set_default_logger(std::move(logger));
  }
  ~LoggedLines() { spdlog::set_default_logger(before_); }
  LoggedLines(const LoggedLines&) = delete;
  LoggedLines& operator=(const LoggedLines&) = delete;
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> before_;
};

TEST(FaultLog, SaysAFaultOnceAndItsEndOnce) {
  const LoggedLines lines;
  Metrics metrics({"0.0", 0, "portable"});
  FaultLog log(metrics);
  log.recovered("plant");
  for (int k = 0; k < 3; ++k) log.fault("plant", "away");
  for (int k = 0; k < 3; ++k) log.recovered("plant");
  EXPECT_EQ(lines.text(), "error plant: away\ninfo plant: works again\n");
}

TEST(FaultLog, StandsAsLongAsItDoesForAnybody) {
  const LoggedLines lines;
  Metrics metrics({"0.0", 0, "portable"});
  FaultLog log(metrics);
  const int writer = 0;
  const int reader = 0;
  for (int round = 0; round < 3; ++round) {
    log.fault("results", "disk full", &writer);
    log.recovered("results", &reader);
  }
  EXPECT_EQ(lines.text(), "error results: disk full\n") << "reading works all the time";
  log.recovered("results", &writer);
  EXPECT_EQ(lines.text(), "error results: disk full\ninfo results: works again\n");
}

TEST(FaultLog, WhoLeavesDoesNotSayThatItWorks) {
  const LoggedLines lines;
  Metrics metrics({"0.0", 0, "portable"});
  FaultLog log(metrics);
  const int link = 0;
  log.fault("results", "away", &link);
  log.leave("results", &link);
  log.recovered("results", &link);
  EXPECT_EQ(lines.text(), "error results: away\n");
  log.fault("results", "away", &link);
  EXPECT_EQ(lines.text(), "error results: away\nerror results: away\n") << "a fault of its own";
}

TEST(FaultLog, OneOutageInManyWordsIsSaidAFewTimes) {
  const LoggedLines lines;
  Metrics metrics({"0.0", 0, "portable"});
  FaultLog log(metrics);
  for (int round = 0; round < 5; ++round) {
    for (const char* words : {"a", "b", "c", "d", "e"}) log.fault("plant", words);
  }
  EXPECT_EQ(lines.text(), "error plant: a\nerror plant: b\nerror plant: c\n");
}

}  // namespace
}  // namespace loopscope::daemon
