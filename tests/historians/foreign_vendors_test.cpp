#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/service/historians/storage_settings.hpp"
#include "storage/error.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "tests/historians/foreign_fixture.hpp"
#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"

namespace loopscope::tests {
namespace {

using storage::RowBefore;
using storage::TagRequest;
using testing::HasSubstr;
using testing::Not;

/// Products that keep their tables in MySQL or MariaDB too, and every layout that there is.
constexpr const char* kVendorsElsewhere[] = {"narrow",    "loop_row", "wide",          "telegraf",
                                             "scada_lts", "epics",    "home_assistant"};

/// Settings for the imported tables; DATETIME has no time zone.
config::HistorianSettings elsewhere(config::HistorianSettings settings) {
  for (std::string* relation : {&settings.table, &settings.partition_table, &settings.tag_table,
                                &settings.subtag_table, &settings.quality_table}) {
    if (!relation->empty()) *relation = "elsewhere" + relation->substr(relation->find('.'));
  }
  if (settings.time_kind == "timestamptz") settings.time_kind = "timestamp_utc";
  return settings;
}

storage::HistorianReader reader_of(const config::HistorianSettings& settings) {
  return {daemon::historian_connection(settings), daemon::historian_layout(settings)};
}

std::vector<TagRequest> requests_of(const Vendor& vendor) {
  std::vector<TagRequest> requests;
  for (const int last : {17'999, 17'500}) {  // over the end of February, too
    for (const char* role : {"sp", "pv", "op"}) {
      requests.push_back({tag_of(vendor, 1, role), Truth::time_us(last - 999),
                          Truth::time_us(last) + 1, 2048, RowBefore::yes, false});
    }
  }
  return requests;
}

TEST_F(Foreign, EveryLayoutGivesTheWindowsOfTheNativeOne) {
  const Truth truth(*database, 1, 18'000);
  database->execute("DELETE FROM truth WHERE k < 16000; CREATE SCHEMA elsewhere");
  for (const char* name : kVendorsElsewhere) database->execute(vendor(name).tables);
  std::string tables;
  for (const auto& row : database->rows(
           "SELECT relname FROM pg_class WHERE relnamespace = 'public'::regnamespace AND relkind IN"
           " ('r', 'p') AND NOT relispartition AND relname <> 'truth'")) {
    tables += as_create(*database, row[0]) + as_insert(*database, row[0]);
  }
  mariadb->execute(tables);
  database->execute("IMPORT FOREIGN SCHEMA plant FROM SERVER mariadb INTO elsewhere");
  for (const char* name : kVendorsElsewhere) {
    SCOPED_TRACE(name);
    const auto settings = settings_of(vendor(name), database->conninfo());
    auto native = reader_of(settings), foreign = reader_of(elsewhere(settings));
    const auto requests = requests_of(vendor(name));
    const auto expected = native.read(requests), read = foreign.read(requests);
    for (std::size_t k = 0; k < requests.size(); ++k) {
      EXPECT_GE(expected[k].time_us.size(), 1000U);
      expect_same(read[k], expected[k], requests[k]);
    }
    const std::vector<std::string> tags{requests[0].tag, requests[1].tag, requests[2].tag};
    EXPECT_EQ(foreign.newest(tags, Truth::time_us(17'000)),
              native.newest(tags, Truth::time_us(17'000)));
  }
}

/// Ignition's tables in both, two loops of rows over the end of February.
class ForeignIgnition : public Foreign {
 protected:
  void SetUp() override {
    Foreign::SetUp();
    if (IsSkipped()) return;
    const Truth truth(*database, 2, 18'000);
    database->execute("DELETE FROM truth WHERE k < 16000; CREATE SCHEMA elsewhere");
    database->execute(vendor("ignition").tables);
    std::string tables =
        "CREATE TABLE sqlt_data_1_2026_02 (tagid int, intvalue bigint, floatvalue double,"
        " stringvalue varchar(255), datevalue datetime, dataintegrity int, t_stamp bigint,"
        " PRIMARY KEY (tagid, t_stamp), KEY (t_stamp));"
        "CREATE TABLE sqlt_data_2_2026_03 LIKE sqlt_data_1_2026_02;";
    for (const char* table : {"sqlth_te", "sqlth_partitions"})
      tables += as_create(*database, table) + as_insert(*database, table);
    for (const char* table : {"sqlt_data_1_2026_02", "sqlt_data_2_2026_03"})
      tables += as_insert(*database, table);
    mariadb->execute(tables);
    database->execute("IMPORT FOREIGN SCHEMA plant FROM SERVER mariadb INTO elsewhere");
  }
  [[nodiscard]] config::HistorianSettings native() const {
    return settings_of(vendor("ignition"), database->conninfo());
  }
};

TEST_F(ForeignIgnition, WindowsAreTheNativeOnes) {
  auto here = reader_of(native()), there = reader_of(elsewhere(native()));
  const auto requests = requests_of(vendor("ignition"));
  const auto expected = here.read(requests), read = there.read(requests);
  std::vector<std::string> tags;
  for (std::size_t k = 0; k < requests.size(); ++k) {
    EXPECT_GE(expected[k].time_us.size(), 1000U);
    expect_same(read[k], expected[k], requests[k]);
    tags.push_back(requests[k].tag);
  }
  EXPECT_EQ(there.newest(tags, Truth::time_us(17'000)), here.newest(tags, Truth::time_us(17'000)));
}

/// What reading one window says; empty = it was read.
std::string refusal(storage::HistorianReader& reader, int last, const std::string& sqlstate) {
  const std::string tag = tag_of(vendor("ignition"), 1, "pv");
  try {
    static_cast<void>(reader.read(std::vector<TagRequest>{
        {tag, Truth::time_us(last - 99), Truth::time_us(last), 200, RowBefore::yes, false}}));
  } catch (const storage::DatabaseError& error) {
    EXPECT_EQ(error.sqlstate(), sqlstate);
    return error.what();
  }
  return "";
}

TEST_F(ForeignIgnition, AMonthThatWasNotImportedIsNotPassedOver) {
  auto reader = reader_of(elsewhere(native()));
  database->execute("DROP FOREIGN TABLE elsewhere.sqlt_data_1_2026_02");
  EXPECT_THAT(refusal(reader, 17'000, "22000"), HasSubstr("no foreign table sqlt_data_1_2026_02"))
      << "others can be read: the loop is set aside";
  EXPECT_EQ(refusal(reader, 17'900, ""), "") << "a row before the window may lie there, no more";
  database->execute("DROP FOREIGN TABLE elsewhere.sqlt_data_2_2026_03");
  EXPECT_THAT(refusal(reader, 17'900, ""), HasSubstr("no foreign table sqlt_data_2_2026_03"))
      << "it is being written: the historian counts as away";
  EXPECT_THROW(static_cast<void>(
                   reader.newest(std::vector<std::string>{"area/fic1/pv"}, Truth::time_us(17'900))),
               storage::DatabaseError);
  // As config/FOREIGN_TABLES.md makes tables ahead.
  database->execute(
      "CREATE FOREIGN TABLE elsewhere.sqlt_data_2_2026_03 (tagid int, intvalue bigint,"
      " floatvalue float8, stringvalue text, datevalue timestamp, dataintegrity int, t_stamp "
      "bigint)"
      " SERVER mariadb OPTIONS (dbname 'plant', table_name 'sqlt_data_2_2026_03')");
  EXPECT_EQ(refusal(reader, 17'900, ""), "") << "found at the next read";
}

TEST_F(ForeignIgnition, CheckConfigPrintsTheStatementThatImports) {
  mariadb->execute(
      "CREATE TABLE sqlt_data_2_now LIKE sqlt_data_2_2026_03;"
      "INSERT INTO sqlth_partitions VALUES ('sqlt_data_2_now', 2,"
      " (unix_timestamp() - 86400) * 1000, (unix_timestamp() + 86400) * 1000, 0, 0)");
  const auto check = [this] {
    return storage::check_historian(daemon::historian_connection(native()),
                                    daemon::historian_layout(elsewhere(native())));
  };
  std::string statement;
  for (const storage::Finding& finding : check()) {
    EXPECT_TRUE(finding.ok) << finding.what;
    if (finding.what.find("were not imported") == std::string::npos) continue;
    EXPECT_TRUE(finding.warning);
    EXPECT_THAT(finding.what, HasSubstr("sqlt_data_2_now"));
    statement = finding.hint;
  }
  ASSERT_THAT(statement, HasSubstr("IMPORT FOREIGN SCHEMA"));
  // Pruned there, which Ignition's list does not say: an import cannot bring it.
  mariadb->execute("DELETE FROM sqlth_partitions WHERE pname = 'sqlt_data_1_2026_01'");
  database->execute(statement);
  for (const storage::Finding& finding : check())
    EXPECT_THAT(finding.what, Not(HasSubstr("were not imported")));
}

}  // namespace
}  // namespace loopscope::tests
