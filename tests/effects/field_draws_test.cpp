#include "tests/effects/field_draws.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/command_words.hpp"

namespace loopscope::tests::effects {
namespace {

class FieldDraws : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("field_draws_" + std::to_string(::getpid()));
  const Plan plan{};
};

constexpr const char* kHead = "file,loop,type,interval_s,samples,label\n";

/// A recording that is left out would be counted as a valve that nobody accuses.
TEST_F(FieldDraws, AManifestWhoseFilesCannotBeReadIsRefused) {
  EXPECT_THROW((void)recorded(plan, folder / "nowhere.csv"), WrongUsage);
  EXPECT_THROW(
      (void)recorded(plan, file("lost.csv", std::string(kHead) + "a.csv,A,flow,1,9,stiction\n")),
      WrongUsage);
  (void)file("empty.csv", "t_s,sp,pv,op\n");
  EXPECT_THROW((void)recorded(
                   plan, file("list.csv", std::string(kHead) + "empty.csv,A,flow,1,0,stiction\n")),
               WrongUsage);
  EXPECT_THROW((void)recorded(plan, file("none.csv", kHead)), WrongUsage);
}

TEST_F(FieldDraws, LabelledRecordingsAreJudgedAndOthersLeftOut) {
  std::string samples = "t_s,sp,pv,op\n";
  for (int k = 0; k < 50; ++k) samples += std::to_string(k) + ",50,50.1,40\n";
  (void)file("a.csv", samples);
  const std::string list = file("list.csv", std::string(kHead) +
                                                "a.csv,A,flow,1,50,no_stiction\n"
                                                "a.csv,B,level,1,50,unknown\n");
  const std::vector<FieldOutcome> outcomes = recorded(plan, list);
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes.front().verdict, "insufficient_data");
  EXPECT_FALSE(outcomes.front().sticks || outcomes.front().accuses_valve);
  EXPECT_NE(lines_of(outcomes).find("\"kind\":\"no_stiction\""), std::string::npos);
}

}  // namespace
}  // namespace loopscope::tests::effects
