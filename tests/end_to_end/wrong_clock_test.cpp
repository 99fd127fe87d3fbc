#include <chrono>
#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <vector>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/sql_connection.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

std::string faketime_library() {
  for (const auto& folder : std::filesystem::directory_iterator("/usr/lib")) {
    const std::filesystem::path file = folder.path() / "faketime" / "libfaketimeMT.so.1";
    if (std::filesystem::exists(file)) return file;
  }
  return {};
}

/// What a command begins with to see another time; `offset` as faketime takes it, e.g. -5h.
std::vector<std::string> at_time(const std::string& offset) {
  return {"/usr/bin/env", "LD_PRELOAD=" + faketime_library(), "FAKETIME=" + offset,
          "DONT_FAKE_MONOTONIC=1", "FAKETIME_DONT_FAKE_MONOTONIC=1"};
}

/// The program on a host whose clock is wrong, beside a server that is results and historian in
/// one: nobody can tell which of the two is right.
class WrongClock : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult run_at(const std::string& offset, const std::string& command,
                                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = at_time(offset);
    for (const std::string& word : plant.command_line(command)) words.push_back(word);
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  Plant plant;
};

TEST_F(WrongClock, NothingIsDoneUntilAPersonHasSettledIt) {
  ASSERT_NE(faketime_library(), "") << "install the package faketime";
  plant.import_loop("FIC101", 600);
  const std::string before = plant.sql("SELECT * FROM loopscope.schedule");
  for (const char* const command : {"once", "maintain"}) {
    const ProgramResult refused = run_at("-5h", command);
    EXPECT_EQ(refused.exit_code, 4) << command;
    EXPECT_THAT(refused.err, HasSubstr("nobody confirms the results server's clock"));
    EXPECT_THAT(refused.err, HasSubstr("5 h 0 min behind"));
    EXPECT_THAT(refused.err, HasSubstr("HINT: set the clock that is wrong"));
  }
  EXPECT_EQ(plant.sql("SELECT * FROM loopscope.schedule"), before);

  const ProgramResult settled = run_at("-5h", "maintain", {"--accept-clock"});
  EXPECT_EQ(settled.exit_code, 0) << settled.err;
  EXPECT_THAT(settled.out, HasSubstr("accepted host "));
  const ProgramResult pass = run_at("-5h", "once");
  EXPECT_EQ(pass.exit_code, 0) << "the round after the pass knows it too: " << pass.err;
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.analysis"), "1");
  EXPECT_EQ(run_at("+30d", "once").exit_code, 4) << "that is another difference";

  const ProgramResult right = plant.loopscope("maintain", {"--accept-clock"});
  EXPECT_THAT(right.out, HasSubstr("no clock differs"));
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.accepted_clock"), "0");
}

/// A historian of its own whose clock is an hour behind.
class LateHistorian {
 public:
  LateHistorian() : file_(folder_.path() / "server.env") { script("start"); }
  ~LateHistorian() { script("stop"); }
  LateHistorian(const LateHistorian&) = delete;
  LateHistorian& operator=(const LateHistorian&) = delete;
  [[nodiscard]] std::string conninfo() const {
    const std::string text = content_of(file_);
    return text.substr(text.find('=') + 1, text.find('\n') - text.find('=') - 1);
  }

 private:
  void script(const std::string& action) const {
    std::vector<std::string> words = at_time("-1h");
    words.insert(words.end(), {source_dir() / "tests" / "support" / "postgres", action, file_});
    const ProgramResult done = run_program(words);
    if (done.exit_code != 0) ADD_FAILURE() << done.err;
  }
  TemporaryFolder folder_;
  std::string file_;
};

/// Its loops lag behind by an hour, and would be due again at once, before all others.
TEST_F(WrongClock, AHistorianThatIsBehindKeepsNoOtherFromWork) {
  const LateHistorian late;
  const SqlConnection historian(late.conninfo());
  historian.run(
      "CREATE TABLE history (tag text, time timestamptz, value float8, quality smallint);"
      "INSERT INTO history SELECT 'B' || n, now() - k * interval '1 s', k % 7, 192"
      " FROM generate_series(1, 3) AS n, generate_series(1, 100) AS k");
  plant.import_loop("FIC101", 600);
  plant.sql(
      "INSERT INTO loopscope.loop (name, source, pv_tag, period_s) SELECT 'B' || n, 'late', 'B' || "
      "n, 4"
      " FROM generate_series(1, 3) AS n; UPDATE loopscope.loop SET period_s = 4");
  plant.write_settings(R"({"results": {"connection": "@RESULTS@"}, "historians": [
      {"name": "plant", "connection": "@CONNECTION@"},
      {"name": "late", "connection": ")" +
                       late.conninfo() +
                       R"("}], "schedule": {"poll_s": 0.2, "settle_s": 0},
      "daemon": {"workers": 1}})");
  {
    const BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "log");
    std::this_thread::sleep_for(std::chrono::seconds(14));
    daemon.send(SIGTERM);
  }
  EXPECT_THAT(content_of(plant.folder() / "log"), HasSubstr("historian late"));
  const std::string visits =
      "SELECT max(fence) FROM loopscope.schedule JOIN loopscope.loop"
      " USING (loop_id) WHERE source = ";
  EXPECT_LE(std::stoi(plant.sql(visits + "'late'")), 6) << "in three or four periods";
  EXPECT_GE(std::stoi(plant.sql(visits + "'plant'")), 2);
}

}  // namespace
}  // namespace loopscope::tests
