#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

TEST(WindowCommand, WritesWhatOnceHasReadSoThatAnalyzeSaysTheSame) {
  if (!test_server()) GTEST_SKIP() << kNoServer;
  TestDatabase database;
  const Truth truth(database, 1, 6'000);
  database.execute(vendor("ignition").tables);
  const TemporaryFolder folder;
  const std::string file = folder.path() / "loopscope.json";
  std::ofstream(file) << nlohmann::json{
      {"results", {{"connection", database.conninfo(database.owner())}}},
      {"historians",
       {{{"name", "gateway"}, {"preset", "ignition"}, {"connection", database.conninfo()}}}}};
  const auto loopscope = [&](const std::string& command, std::vector<std::string> rest = {}) {
    rest.insert(rest.begin(), {LOOPSCOPE_PROGRAM, command, "--config", file});
    return run_program(rest);
  };
  ASSERT_EQ(loopscope("migrate").exit_code, 0);
  const ProgramResult added =
      loopscope("loops", {"add", "FIC1", "--sp-tag", "area/fic1/sp", "--pv-tag", "Area/FIC1/PV",
                          "--op-tag", "[default]area/fic1/op", "--interval-s", "10"});
  ASSERT_EQ(added.exit_code, 0) << added.err;
  ASSERT_EQ(loopscope("once").exit_code, 0);
  const std::string csv = folder.path() / "window.csv";
  const ProgramResult written = loopscope("window", {"--loop", "FIC1", "--out", csv});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  const ProgramResult alone =
      run_program({LOOPSCOPE_PROGRAM, "analyze", csv, "--json", "--no-model"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const auto json = nlohmann::json::parse(alone.out);
  for (const char* column : {"ngi", "nli", "ngi_p", "nli_p", "cubic_p", "nonlinear_p"}) {
    EXPECT_EQ(
        std::stod(database.value(std::string("SELECT ") + column + " FROM loopscope.analysis")),
        json["hos"][column].get<double>())
        << column;
  }
  EXPECT_THAT(loopscope("window", {"--loop", "nobody"}).err, HasSubstr("no loop named \"nobody\""));
  EXPECT_EQ(loopscope("window", {"--loop", "FIC1", "--end", "noon"}).exit_code, 2);
}

}  // namespace
}  // namespace loopscope::tests
