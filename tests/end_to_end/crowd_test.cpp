#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/end_to_end/plant.hpp"

/// The pages in a crowd, in little; in earnest: tests/bench/readers.
namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// Loops that the daemon does not work on: their page is large all the same.
void add_resting_loops(const Plant& plant, int count) {
  plant.sql(
      "insert into loopscope.loop (name, source, pv_tag, interval_s, period_s, enabled) "
      "select 'FC' || i, 'plant', 'FC' || i || '.PV', 10, 3600, false from generate_series(1, " +
      std::to_string(count) + ") as i");
}

class Crowd : public testing::Test {
 protected:
  void set(const std::string& more) const {
    plant.write_settings(
        Plant::settings(R"("daemon": {"http_address": "127.0.0.1:0")" + more + "}"));
  }
  /// `words` stand before the command.
  void run(const std::string& more = "", std::vector<std::string> words = {}) {
    set(more);
    for (const std::string& word : plant.command_line("run")) words.push_back(word);
    daemon_.emplace(words, log());
    address = pages_of(log());
    ASSERT_NE(address, "") << content_of(log());
    address = address.substr(address.rfind('/') + 1);
  }
  std::filesystem::path log() const { return plant.folder() / "daemon.log"; }
  /// Status and head of an answer, as curl prints them.
  std::string head(const std::string& path, const std::string& header) const {
    return run_program({"/usr/bin/curl", "-s", "--max-time", "60", "-o", "/dev/null", "-D", "-",
                        "-H", header, "http://" + address + path})
        .out;
  }
  void reload(const std::string& more) {
    set(more);
    daemon_->send(SIGHUP);
    const std::string done = "settings read again";
    for (int tries = 0; tries < 200 && content_of(log()).find(done) == std::string::npos; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  void TearDown() override {
    daemon_->send(SIGTERM);
    EXPECT_EQ(daemon_->wait(60), 0) << content_of(log());
  }

  Plant plant;
  std::string address;  ///< with its port

 private:
  std::optional<BackgroundProgram> daemon_;
};

/// Bounds are those of a busy machine: compressing in the threads that answer, and threads that
/// wait for slow clients, took seconds.
TEST_F(Crowd, ReadersAndSlowClientsDelayNeitherLifeNorFigures) {
  add_resting_loops(plant, 3000);
  run();
  const ProgramResult crowd =
      run_program({"/usr/bin/python3", source_dir() / "tests/support/crowd.py", address,
                   "--readers", "12", "--slow", "200", "--seconds", "6"});
  ASSERT_EQ(crowd.exit_code, 0) << crowd.err;
  const auto found = nlohmann::json::parse(crowd.out);
  EXPECT_EQ(found["unanswered"], 0) << crowd.out;
  EXPECT_GT(found["livez_ms"]["probes"], 10) << crowd.out;
  EXPECT_LT(found["livez_ms"]["p90"], 500) << crowd.out;
  EXPECT_LT(found["metrics_ms"]["p90"], 500) << crowd.out;
  EXPECT_GT(found["pages"]["200"], 10) << crowd.out;
  EXPECT_GT(found["pages"]["bytes"], 10'000'000) << "pages of thousands of loops";
}

TEST_F(Crowd, PagesComeInTheFormThatIsWantedUnderNamesThatAreKnown) {
  add_resting_loops(plant, 100);
  run(R"(, "http_names": ["scada.example"])");
  EXPECT_THAT(head("/loops", "Accept-Encoding: br, gzip"), HasSubstr("Content-Encoding: gzip"));
  EXPECT_THAT(head("/loops", "Accept-Encoding: *;q=0"), HasSubstr(" 406 "));
  EXPECT_THAT(head("/loops", "Host: scada.example"), HasSubstr(" 200 "));
  EXPECT_THAT(head("/loops", "Host: evil.example"), HasSubstr(" 421 "));
  reload(R"(, "http_names": ["dcs.example"])");
  EXPECT_THAT(head("/loops", "Host: dcs.example"), HasSubstr(" 200 "));
  EXPECT_THAT(head("/loops", "Host: scada.example"), HasSubstr(" 421 "));
}

/// A recursion over a header line took five of the eight megabytes that a thread usually has.
TEST_F(Crowd, LongHeaderLinesTakeNoStack) {
  run("", {"/bin/bash", "-c", "ulimit -s 4096 && exec \"$@\"", "bash"});
  const std::string ranges = "Range: bytes=1-2," + std::string(8125, ' ') + "3-4";
  EXPECT_THAT(head("/livez", ranges), HasSubstr(" 200 "));
  EXPECT_THAT(head("/livez", "Range: bytes=0-0"), HasSubstr("Content-Length: 3"));
}

}  // namespace
}  // namespace loopscope::tests
