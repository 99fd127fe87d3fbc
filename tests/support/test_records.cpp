#include "tests/support/test_records.hpp"

#include <algorithm>
#include <stdexcept>
#include <unistd.h>

#include "tests/support/counted_assertions.hpp"

namespace loopscope::tests {
namespace {

/// The first line, without what would end a field of the record.
std::string first_line(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  std::ranges::replace(line, '\t', ' ');
  return line;
}

const char* outcome_of(const ::testing::TestResult& result) {
  if (result.Failed()) return "failed";
  return result.Skipped() ? "skipped" : "passed";
}

}  // namespace

TestRecords::TestRecords(const std::string& folder, const std::string& program)
    : file_(folder + "/" + program + "." + std::to_string(::getpid()) + ".tsv") {
  if (!file_) throw std::runtime_error("no test records can be written into " + folder);
}

void TestRecords::OnTestStart(const ::testing::TestInfo&) {
  assertions_before_ = executed_assertions;
  skipped_because_.clear();
}

void TestRecords::OnTestPartResult(const ::testing::TestPartResult& part) {
  if (part.skipped()) skipped_because_ = first_line(part.message());
}

void TestRecords::OnTestEnd(const ::testing::TestInfo& test) {
  const ::testing::TestResult& result = *test.result();
  file_ << test.test_suite_name() << '.' << test.name() << '\t' << outcome_of(result) << '\t'
        << result.elapsed_time() << '\t' << executed_assertions - assertions_before_ << '\t'
        << skipped_because_ << std::endl;
}

}  // namespace loopscope::tests
