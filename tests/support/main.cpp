// The main() of every test program.

#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>

#include "tests/support/test_records.hpp"

int main(int argc, char** argv) {
  ::testing::InitGoogleMock(&argc, argv);
  const char* const folder = std::getenv("LOOPSCOPE_TEST_RECORDS");
  if (folder != nullptr && !::testing::GTEST_FLAG(list_tests)) {
    const std::string program = std::filesystem::path(argv[0]).filename();
    // GoogleTest deletes its listeners.
    ::testing::UnitTest::GetInstance()->listeners().Append(
        new loopscope::tests::TestRecords(folder, program));
  }
  return RUN_ALL_TESTS();
}
