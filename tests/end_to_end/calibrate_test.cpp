#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/run_program.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

ProgramResult calibrate(std::vector<std::string> options) {
  options.insert(options.begin(), {LOOPSCOPE_PROGRAM, "calibrate"});
  return run_program(options);
}

Json counted(const std::string& threads) {
  const ProgramResult result = calibrate({"--records", "3", "--threads", threads, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");  // no progress where there is no terminal
  Json json = Json::parse(result.out);
  EXPECT_GT(json["cost"]["ratio"], 0.0);
  json.erase("cost");
  return json;
}

TEST(Calibrate, JsonIsTheSameInAnyNumberOfThreads) {
  const Json one = counted("1");
  EXPECT_EQ(one, counted("3"));
  EXPECT_GE(one["families"].size(), 50U);
  for (const Json& family : one["families"]) {
    EXPECT_EQ(family["rejected"].size(), one["tests"].size()) << family["name"];
    EXPECT_EQ(family["rejected"]["published_ngi"]["computed"], 3) << family["name"];
  }
}

TEST(Calibrate, TableForPeople) {
  const ProgramResult result = calibrate({"--records", "2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"nominal 5 %", "nominal 1 %", "NGI > 0", "Hinich G", "nonlinear_p",
                           "random_walk", "sawtooth_400", "CPU time of a linear Gaussian record"}) {
    EXPECT_THAT(result.out, HasSubstr(part));
  }
}

TEST(Calibrate, WrongUsage) {
  for (const auto& [option, value] : {std::pair{"--records", "0"},
                                      {"--records", "many"},
                                      {"--threads", "0"},
                                      {"--plants", "-1"},
                                      {"--nonsense", "1"}}) {
    const ProgramResult result = calibrate({option, value});
    EXPECT_EQ(result.exit_code, 2) << option << ' ' << value;
    EXPECT_EQ(result.out, "") << option << ' ' << value;
    EXPECT_THAT(result.err, HasSubstr("error: ")) << option << ' ' << value;
    EXPECT_THAT(result.err, HasSubstr("HINT: ")) << option << ' ' << value;
  }
}

}  // namespace
}  // namespace loopscope::tests
