#pragma once
/// What a test program leaves behind for `deploy/test` to add up.

#include <cstdint>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace loopscope::tests {

/// Writes a line for each test into FOLDER/PROGRAM.PID.tsv, as soon as the test has ended:
///
///     full name <TAB> passed|failed|skipped <TAB> milliseconds <TAB> assertions <TAB> why skipped
///
/// A program that died leaves the lines of the tests before.
class TestRecords final : public ::testing::EmptyTestEventListener {
 public:
  /// @throws std::runtime_error the file cannot be written
  TestRecords(const std::string& folder, const std::string& program);

  void OnTestStart(const ::testing::TestInfo& test) override;
  void OnTestPartResult(const ::testing::TestPartResult& part) override;
  void OnTestEnd(const ::testing::TestInfo& test) override;

 private:
  std::ofstream file_;
  std::uint64_t assertions_before_ = 0;
  std::string skipped_because_;
};

}  // namespace loopscope::tests
