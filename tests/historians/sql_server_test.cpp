#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <unistd.h>

#include "storage/historian/historian_reader.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "tests/historians/foreign_fixture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {
namespace {

using storage::RowBefore;
using storage::TagRequest;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kTdsWrapper = "/usr/lib/postgresql/15/lib/tds_fdw.so";
constexpr const char* kNoWrapper = "no tds_fdw (deploy/test installs postgresql-15-tds-fdw)";

constexpr const char* kRows = R"(
    CREATE TABLE native (tag text, time timestamp, value float8, quality int);
    SELECT setseed(0.33);
    INSERT INTO native SELECT tag, timestamp '2026-03-30' - k * interval '1.234567 seconds',
      exp(random() * 600 - 300) - random(), CASE WHEN random() < 0.1 THEN 64 ELSE 192 END
      FROM generate_series(0, 2000) AS k, unnest(ARRAY['FIC1', 'odd ''tag''']) AS tag;
    INSERT INTO native SELECT 'SP1', timestamp '2026-03-29' - k * k * interval '1 hour', k / 7.0, 192
      FROM generate_series(0, 60) AS k, generate_series(0, 1))";

/// tds_fdw before a stand-in for SQL Server (tests/support/fake_sql_server.py): what is sent, and
/// how the answer is read. What the real one makes of it is not tested.
class SqlServer : public testing::Test {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
    if (access(kTdsWrapper, R_OK) != 0) GTEST_SKIP() << kNoWrapper;
    database.emplace();
    database->execute(kRows);
    std::ofstream rows(folder.path() / "rows");
    for (const auto& row : database->rows("SELECT tag, time, value, quality FROM native"))
      rows << row[0] << '\t' << row[1] << '\t' << row[2] << '\t' << row[3] << '\n';
    rows.close();
    start_server();
  }
  void start_server() {
    server.emplace(std::vector<std::string>{"/usr/bin/python3",
                                            source_dir() / "tests/support/fake_sql_server.py",
                                            folder.path() / "rows", folder.path()},
                   folder.path() / "log");
    for (int tries = 0; !told_port().ends_with('\n'); ++tries) {
      if (tries == 300) throw std::runtime_error("no server: " + content_of(folder.path() / "log"));
      usleep(20'000);
    }
  }
  [[nodiscard]] std::string told_port() const {
    const std::string file = folder.path() / "port";
    return access(file.c_str(), R_OK) == 0 ? content_of(file) : "";
  }
  void make_foreign(const std::string& tds_version) {
    database->execute(
        "CREATE EXTENSION tds_fdw; CREATE SERVER scada FOREIGN DATA WRAPPER tds_fdw OPTIONS ("
        "servername '127.0.0.1', port '" +
        std::to_string(std::stoi(told_port())) + "', database 'plant', tds_version '" +
        tds_version +
        "', row_estimate_method 'showplan_all');"
        "CREATE USER MAPPING FOR PUBLIC SERVER scada OPTIONS (username 'loopscope', password '-');"
        "CREATE FOREIGN TABLE elsewhere (tag text, time timestamp, value float8, quality int)"
        " SERVER scada OPTIONS (schema_name 'dbo', table_name 'history')");
  }
  [[nodiscard]] storage::ConnectionSettings connection() const {
    storage::ConnectionSettings settings;
    settings.conninfo = database->conninfo();
    return settings;
  }
  [[nodiscard]] static storage::SourceLayout layout_of(const std::string& table) {
    storage::SourceLayout layout;
    layout.relation = "public." + table;
    layout.time_kind = storage::TimeKind::timestamp_utc;
    return layout;
  }
  [[nodiscard]] std::vector<storage::Finding> check() const {
    return storage::check_historian(connection(), layout_of("elsewhere"));
  }

  TemporaryFolder folder;
  std::optional<TestDatabase> database;
  std::optional<BackgroundProgram> server;
};

TEST_F(SqlServer, WindowsAreTheNativeOnes) {
  make_foreign("7.2");
  storage::HistorianReader native(connection(), layout_of("native"));
  storage::HistorianReader elsewhere(connection(), layout_of("elsewhere"));
  std::vector<TagRequest> requests;
  for (const char* tag : {"FIC1", "SP1", "odd 'tag'", "never there"}) {
    for (const auto& [max_rows, before] : {std::pair{4096, RowBefore::no}, {100, RowBefore::yes}}) {
      requests.push_back({tag, kEnd_us - 700 * kSecond_us, kEnd_us - 1, max_rows, before, false});
    }
  }
  const auto expected = native.read(requests), read = elsewhere.read(requests);
  for (std::size_t k = 0; k < requests.size(); ++k) expect_same(read[k], expected[k], requests[k]);
  EXPECT_EQ(read[3].time_us.size(), 1U) << "the setpoint's row of the day before";
  const std::vector<std::string> tags{"FIC1", "SP1", "odd 'tag'", "never there"};
  EXPECT_EQ(elsewhere.newest(tags, kEnd_us), native.newest(tags, kEnd_us));
  EXPECT_THAT(content_of(folder.path() / "batches"), Not(HasSubstr("CAST(")))
      << "a value that is found at run time";
}

TEST_F(SqlServer, CheckConfigTellsWhatIsSent) {
  make_foreign("7.2");
  const auto findings = check();
  for (const storage::Finding& finding : findings) EXPECT_TRUE(finding.ok) << finding.what;
  EXPECT_THAT(findings, Contains(Field(&storage::Finding::what,
                                       HasSubstr("times of a window are looked up by the other"))));
  EXPECT_THAT(findings, Contains(Field(&storage::Finding::what,
                                       HasSubstr("the other server sends every row of a window"))));
  server->send(SIGKILL);
  static_cast<void>(server->wait(5));
  const storage::Finding away = check().back();
  EXPECT_FALSE(away.ok);
  EXPECT_THAT(away.what, HasSubstr("Unable to connect"));
  EXPECT_THAT(away.hint, HasSubstr("the server behind a foreign table does not answer"));
}

TEST_F(SqlServer, Datetime2NeedsAnOldProtocol) {
  make_foreign("7.4");
  EXPECT_THAT(check(), Contains(Field(&storage::Finding::what,
                                      HasSubstr("invalid input syntax for type timestamp"))));
}

}  // namespace
}  // namespace loopscope::tests
