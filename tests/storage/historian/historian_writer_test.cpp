#include "storage/historian/historian_writer.hpp"

#include <gmock/gmock.h>
#include <limits>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

class WriterTest : public HistorianTest {};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_F(WriterTest, MissingValuesAreNullWithBadQuality) {
  import_rows(settings(), layout, std::vector{rows_of("a", {0.1, kNan})}, false);
  using tests::TextRows;
  EXPECT_EQ(database->rows("SELECT time, value, quality FROM history ORDER BY time"),
            (TextRows{{"2026-01-01 00:00:00+00", "0.1", "192"},
                      {"2026-01-01 00:00:01+00", "NULL", "0"}}));
  layout.quality.rule = QualityRule::zero;
  import_rows(settings(), layout, std::vector{rows_of("b", {0.1, kNan})}, false);
  EXPECT_EQ(database->rows("SELECT quality FROM history WHERE tag = 'b' ORDER BY time"),
            (TextRows{{"0"}, {"1"}}));
}

TEST_F(WriterTest, RowsThatAreThereAreRefusedOrReplaced) {
  import_rows(settings(), layout, std::vector{rows_of("a", {1, 2, 3})}, false);
  TagRows later = rows_of("a", {7, 8, 9});
  for (std::int64_t& time : later.rows.time_us) time += 2'000'000;
  const std::vector both{rows_of("b", {1}), later};
  try {
    import_rows(settings(), layout, both, false);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("tag a"));
    EXPECT_EQ(error.remedy(), Remedy::give_up);
  }
  EXPECT_EQ(database->value("SELECT count(*) FROM history"), "3") << "all or nothing";

  EXPECT_EQ(import_rows(settings(), layout, both, true), 4u);
  EXPECT_EQ(database->value("SELECT string_agg(value::text, ' ' ORDER BY time) FROM history"
                            " WHERE tag = 'a'"),
            "1 2 7 8 9");
}

TEST_F(WriterTest, TagsThatTouchButDoNotOverlapAreTaken) {
  import_rows(settings(), layout, std::vector{rows_of("a", {1, 2})}, false);
  TagRows later = rows_of("a", {3});
  later.rows.time_us[0] = second(2);
  EXPECT_EQ(import_rows(settings(), layout, std::vector{later, rows_of("empty", {})}, false), 1u);
}

TEST_F(WriterTest, LargeImportComesBackWhole) {
  std::vector<double> values(60'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 7.0;
  EXPECT_EQ(import_rows(settings(), layout, std::vector{rows_of("a", values)}, false), 60'000u);
  HistorianReader historian = reader();
  EXPECT_EQ(historian.read(std::vector{request("a", 0, 100'000, 100'000)}).at(0).value, values)
      << "every double survives";
}

TEST_F(WriterTest, TagThatDoesNotFitTheColumnIsNamed) {
  database->execute("CREATE TABLE numbered (tag int, time timestamptz, value float8, quality int)");
  layout.relation = "numbered";
  try {
    import_rows(settings(), layout, std::vector{rows_of("FIC 1", {1})}, false);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("tag FIC 1"));
  }
}

TEST_F(WriterTest, FailingCopySaysWhatAndWhere) {
  database->execute("ALTER TABLE history ADD CHECK (value < 100)");
  try {
    import_rows(settings(), layout, std::vector{rows_of("a", {1, 1000})}, false);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.sqlstate(), "23514");
    EXPECT_THAT(error.what(), HasSubstr("statement copy_rows"));
  }
  EXPECT_EQ(database->value("SELECT count(*) FROM history"), "0");
}

TEST_F(WriterTest, CreatesACoveringIndexOnce) {
  EXPECT_FALSE(create_historian_table(settings(), layout));
  EXPECT_THAT(database->value("SELECT indexdef FROM pg_indexes WHERE tablename = 'history'"),
              HasSubstr("(tag, \"time\") INCLUDE (value, quality)"));
}

TEST_F(WriterTest, SchemaThatIsMissingIsNamed) {
  layout.relation = "no_such.history";
  try {
    create_historian_table(settings(), layout);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("schema \"no_such\" does not exist"));
    EXPECT_EQ(error.remedy(), Remedy::give_up);
  }
}

}  // namespace
}  // namespace loopscope::storage
