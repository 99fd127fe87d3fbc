#include "daemon/service/observe/log.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <sstream>
#include <vector>

#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

/// The lines that the log has written for a message.
std::vector<std::string> logged(const std::string& format, const std::string& message) {
  config::DaemonSettings settings;
  settings.log_format = format;
  testing::internal::CaptureStderr();
  set_up_log(settings);
  spdlog::error("loop \"{}\" could not be analysed", message);
  std::istringstream text(testing::internal::GetCapturedStderr());
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST(Log, NoNameForgesALineOfText) {
  for (const auto* names : {&tests::hostile_names(), &tests::impossible_names()}) {
    for (const tests::HostileName& hostile : *names) {
      const auto lines = logged("text", hostile.name);
      ASSERT_EQ(lines.size(), 1U) << hostile.about << ": " << hostile.name;
      EXPECT_TRUE(tests::is_harmless_on_a_terminal(lines[0])) << lines[0];
      EXPECT_EQ(lines[0].substr(19, 15), "Z error: loop \"") << lines[0];
    }
  }
}

TEST(Log, EveryNameReadsBackFromJson) {
  for (const tests::HostileName& hostile : tests::hostile_names()) {
    const auto lines = logged("json", hostile.name);
    ASSERT_EQ(lines.size(), 1U) << hostile.about;
    EXPECT_TRUE(tests::is_harmless_on_a_terminal(lines[0])) << lines[0];
    const auto object = nlohmann::json::parse(lines[0]);
    EXPECT_EQ(object.at("message"), "loop \"" + hostile.name + "\" could not be analysed");
    EXPECT_EQ(object.at("level"), "error");
  }
  EXPECT_NE(logged("json", "F\u00fcllstand").at(0).find("F\u00fcllstand"), std::string::npos)
      << "letters stay letters";
}

TEST(Log, WhatIsNoUtf8StillMakesALineOfJson) {
  for (const tests::HostileName& bad : tests::impossible_names()) {
    const auto lines = logged("json", bad.name);
    ASSERT_EQ(lines.size(), 1U) << bad.about;
    EXPECT_TRUE(nlohmann::json::accept(lines[0])) << lines[0];
  }
}

}  // namespace
}  // namespace loopscope::daemon
