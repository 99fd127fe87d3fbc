#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// An hour is judged when it ends: the imports end where the hour before did.
constexpr const char* kAtOnce = R"("schedule": {"settle_s": 0})";

/// Several kinds of fault, under names that would break out of a page that lets them.
void make_hostile_plant(const Plant& plant) {
  plant.import_simulated("FIC101", "sticking_valve", "102");
  plant.import_simulated("\"><script>alert(1)</script>", "tight_tuning", "104");
  plant.import_simulated("</style><img src=x onerror=alert(1)>", "quantised_sensor", "105");
  plant.import_simulated("LIC '% &amp; #1?a=b", "sticking_level", "106");
  plant.import_simulated("FIC103", "healthy_flow", "103");
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
}

bool can_browse() {
  for (const char* program : {"/usr/bin/chromium", "/usr/bin/chromedriver", "/usr/bin/python3"})
    if (!std::filesystem::exists(program)) return false;
  return run_program({"/usr/bin/python3", "-c", "import selenium"}).exit_code == 0;
}

/// The login under which the daemon enters what people say.
class Engineer {
 public:
  explicit Engineer(const Plant& plant) : plant_(plant) {
    plant_.sql("CREATE ROLE " + login() + " LOGIN IN ROLE loopscope_engineer");
  }
  ~Engineer() { plant_.sql("DROP ROLE " + login()); }
  Engineer(const Engineer&) = delete;
  Engineer& operator=(const Engineer&) = delete;

  [[nodiscard]] static std::string login() { return "ls_browser_" + std::to_string(getpid()); }

 private:
  const Plant& plant_;
};

constexpr const char* kAcknowledging =
    R"({"http_address": "127.0.0.1:0", "acknowledge": )"
    R"({"trusted_proxies": ["127.0.0.1"], "origin": "http://loopscope.localhost"}})";

TEST(Browser, ReportAndLivePagesAreWhatTheyShouldBe) {
  if (!can_browse()) GTEST_SKIP() << "no chromium, chromium-driver or python3-selenium";
  // The daemon's pages are of the hour that the imports belong to.
  wait_for_hour_with(std::chrono::seconds(60));
  const Plant plant;
  plant.write_settings(Plant::settings(kAtOnce));
  make_hostile_plant(plant);
  const std::string folder = plant.folder() / "reports";
  ASSERT_EQ(plant.loopscope("report", {"--out", folder}).exit_code, 0);
  const Engineer engineer(plant);
  plant.write_settings(R"({"results": {"connection": "@RESULTS@", "engineer_connection": ")" +
                       plant.connection() + " user=" + Engineer::login() + R"("}, "daemon": )" +
                       kAcknowledging + ", " + kAtOnce +
                       R"(, "historians": [{"connection": "@CONNECTION@"}]})");
  const std::filesystem::path log = plant.folder() / "daemon.log";
  BackgroundProgram daemon(plant.command_line("run"), log);
  const std::string address = pages_of(log);
  ASSERT_NE(address, "") << content_of(log);
  const char* kept = std::getenv("LOOPSCOPE_SCREENSHOTS");
  const std::string pictures = kept != nullptr ? kept : plant.folder() / "screenshots";
  const ProgramResult read =
      run_program({"/usr/bin/python3", source_dir() / "tests/end_to_end/read_pages.py",
                   folder + "/report.html", address, pictures});
  EXPECT_EQ(read.exit_code, 0) << read.err << content_of(log);
  EXPECT_THAT(read.out, HasSubstr("read"));
  const ProgramResult filled =
      run_program({"/usr/bin/python3", source_dir() / "tests/end_to_end/fill_form.py", address,
                   "FIC101", pictures});
  EXPECT_EQ(filled.exit_code, 0) << filled.err << content_of(log);
  EXPECT_EQ(plant.sql("SELECT string_agg(kind, ' ' ORDER BY annotation_id) || bool_and("
                      "withdrawn_on_behalf_of = on_behalf_of) FROM loopscope.annotation"),
            "acknowledged suppressed false_positivetrue");
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(30), 0);
}

}  // namespace
}  // namespace loopscope::tests
