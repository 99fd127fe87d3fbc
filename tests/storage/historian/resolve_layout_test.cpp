#include "storage/historian/resolve_layout.hpp"

#include <gmock/gmock.h>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::signal::RawSeries;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

class LayoutTest : public HistorianTest {};

struct KindOfTime {
  TimeKind kind;
  const char* type;
  const char* at_1s;  // 2026-01-01 00:00:01 as SQL
};

class TimeKindTest : public HistorianTest, public testing::WithParamInterface<KindOfTime> {};

TEST_P(TimeKindTest, RowsComeBackAtTheirTimes) {
  layout.relation = "public.other";
  layout.time_kind = GetParam().kind;
  ASSERT_TRUE(create_historian_table(settings(), layout));
  EXPECT_EQ(database->value("SELECT format_type(atttypid, NULL) FROM pg_attribute WHERE attrelid ="
                            " 'public.other'::regclass AND attname = 'time'"),
            GetParam().type);
  import_rows(settings(), layout, std::vector{rows_of("a", {0, 1, 2, 3})}, false);
  EXPECT_EQ(database->value(std::string("SELECT value FROM public.other WHERE time = ") +
                            GetParam().at_1s),
            "1");

  HistorianReader historian = reader();
  TagRequest wanted = request("a", 2, 3);
  wanted.before = RowBefore::yes;
  const RawSeries rows = read_one(historian, wanted);
  EXPECT_THAT(rows.value, ElementsAre(1, 2, 3));
  EXPECT_THAT(rows.time_us, ElementsAre(second(1), second(2), second(3)));
  EXPECT_THAT(historian.newest(std::vector<std::string>{"a"}, second(2)), ElementsAre(second(2)));
}

INSTANTIATE_TEST_SUITE_P(
    All, TimeKindTest,
    testing::Values(
        KindOfTime{TimeKind::timestamptz, "timestamp with time zone", "'2026-01-01 00:00:01+00'"},
        KindOfTime{TimeKind::timestamp_utc, "timestamp without time zone", "'2026-01-01 00:00:01'"},
        KindOfTime{TimeKind::epoch_s, "bigint", "1767225601"},
        KindOfTime{TimeKind::epoch_s_float, "double precision", "1767225601"},
        KindOfTime{TimeKind::epoch_ms, "bigint", "1767225601000"},
        KindOfTime{TimeKind::epoch_us, "bigint", "1767225601000000"},
        KindOfTime{TimeKind::epoch_ns, "bigint", "1767225601000000000"}));

struct KindOfTag {
  const char* type;
  const char* tag;
  const char* impossible;  // no value of that type
};

class TagTypeTest : public HistorianTest, public testing::WithParamInterface<KindOfTag> {};

TEST_P(TagTypeTest, TagsOfOtherTypesAreFound) {
  const std::string tag = GetParam().tag;
  database->execute(std::string("CREATE TABLE typed (tag ") + GetParam().type +
                    ", time timestamptz, value real, quality int);"
                    "CREATE INDEX ON typed (tag, time);"
                    "INSERT INTO typed VALUES ('" +
                    tag + "', '2026-01-01 00:00:01+00', 1.5, 192)");
  layout.relation = "typed";
  HistorianReader historian = reader();
  const auto rows =
      historian.read(std::vector{request(GetParam().impossible, 0, 9), request(tag, 0, 9)});
  EXPECT_TRUE(rows[0].empty());
  EXPECT_THAT(rows[1].value, ElementsAre(1.5));
}

INSTANTIATE_TEST_SUITE_P(
    All, TagTypeTest,
    testing::Values(KindOfTag{"varchar(20)", "FIC 1", "\xff"},
                    KindOfTag{"char(20)", "FIC 1", "\xff"}, KindOfTag{"name", "FIC 1", "\xff"},
                    KindOfTag{"int2", "77", "1e3"}, KindOfTag{"int4", "-77", "77 "},
                    KindOfTag{"int8", "77", "FIC 1"},
                    KindOfTag{"uuid", "6b1f7e1a-9f5e-4a0b-8a39-9f1f6c1b8d01", "6b1f7e1a"}));

TEST_F(LayoutTest, ReadsThroughViewsAndDomainsAndOtherNumbers) {
  database->execute(
      "CREATE DOMAIN percent AS numeric;"
      "CREATE TABLE odd (tag text, time timestamptz, value percent, on_off boolean);"
      "INSERT INTO odd VALUES ('a', '2026-01-01 00:00:01+00', 12.5, true),"
      " ('a', '2026-01-01 00:00:02+00', 'NaN', false);"
      "CREATE VIEW seen AS SELECT * FROM odd");
  layout.relation = "public.seen";
  layout.quality_column = "";
  {
    HistorianReader historian = reader();
    EXPECT_THAT(read_one(historian, request("a", 0, 9)).value, ElementsAre(12.5, IsNan()));
  }
  layout.value_columns = {"on_off"};
  HistorianReader historian = reader();
  EXPECT_THAT(read_one(historian, request("a", 0, 9)).value, ElementsAre(1.0, 0.0));
}

TEST_F(LayoutTest, DatabaseMayHaveAnotherEncoding) {
  database = std::make_unique<tests::TestDatabase>("LATIN1");
  ASSERT_TRUE(create_historian_table(settings(), layout));
  import_rows(settings(), layout, std::vector{rows_of("Füllstand", {1})}, false);
  EXPECT_EQ(database->value("SELECT octet_length(tag) FROM history"), "9") << "one byte for ü";
  HistorianReader historian = reader();
  EXPECT_THAT(read_one(historian, request("Füllstand", 0, 9)).value, ElementsAre(1));
}

TEST_F(LayoutTest, HostileNamesAreOnlyNames) {
  layout.relation = "we\"ird.ta;ble'; DROP TABLE public.history; --";
  layout.key.front().column = "ta\"g";
  layout.time_column = "select";
  layout.value_columns = {"va,lue\\"};
  layout.quality_column = "$1";
  database->execute("CREATE SCHEMA \"we\"\"ird\"");
  ASSERT_TRUE(create_historian_table(settings(), layout));
  EXPECT_FALSE(create_historian_table(settings(), layout)) << "it exists now";
  const std::string tag = "'; DELETE FROM history; --\t\n\r\\N\\.\"{},NULL";
  import_rows(settings(), layout,
              std::vector{rows_of(tag, {1, 2}), rows_of("NULL", {3}), rows_of("", {4})}, false);
  HistorianReader historian = reader();
  const auto rows =
      historian.read(std::vector{request(tag, 0, 9), request("NULL", 0, 9), request("", 0, 9)});
  EXPECT_THAT(rows[0].value, ElementsAre(1, 2));
  EXPECT_THAT(rows[1].value, ElementsAre(3));
  EXPECT_THAT(rows[2].value, ElementsAre(4));
  EXPECT_EQ(database->value("SELECT count(*) FROM public.history"), "0");
}

TEST_F(LayoutTest, NoValueMakesTheStatementFail) {
  database->execute(
      "CREATE TABLE numbers (tag text, time timestamptz, value numeric);"
      "INSERT INTO numbers SELECT 'a', timestamptz '2026-01-01 00:00:00+00' + k * interval '1 s', v"
      " FROM unnest(ARRAY['1.5', '1e400', '-1e-400', '0', 'NaN', '-1e299']::numeric[])"
      " WITH ORDINALITY AS t (v, k)");
  layout.relation = "numbers";
  layout.quality_column = "";
  HistorianReader historian = reader();
  EXPECT_THAT(read_one(historian, request("a", 0, 99)).value,
              ElementsAre(1.5, IsNan(), IsNan(), 0.0, IsNan(), -1e299));
}

TEST_F(LayoutTest, WrongLayoutsAreRefusedWithAHint) {
  const auto refusal = [&](auto change) {
    SourceLayout wrong = layout;
    change(wrong);
    try {
      HistorianReader historian(settings(), wrong);
      ADD_FAILURE() << "accepted";
      return std::string();
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::give_up);
      return std::string(error.what()) + " HINT: " + error.hint();
    }
  };
  EXPECT_THAT(refusal([](SourceLayout& l) { l.relation = "public.nothing"; }),
              HasSubstr("no such table or view: public.nothing, historian plant (public.nothing)"));
  EXPECT_THAT(refusal([](SourceLayout& l) { l.relation = "History"; }), HasSubstr("no such table"));
  EXPECT_THAT(refusal([](SourceLayout& l) { l.relation = ""; }), HasSubstr("no such table"));
  EXPECT_THAT(refusal([](SourceLayout& l) { l.key.front().column = "Tag"; }),
              HasSubstr("no column \"Tag\" in public.history, historian plant (public.history) "
                        "HINT: set `tag_column` "
                        "to one of: quality, tag, time, value"));
  EXPECT_THAT(refusal([](SourceLayout& l) { l.value_columns = {"time"}; }),
              HasSubstr("column \"time\" has the unusable type timestamptz"));
  EXPECT_THAT(refusal([](SourceLayout& l) { l.quality_column = "value"; }),
              HasSubstr("`quality_column` reads int2, int4, int8"));
  EXPECT_THAT(refusal([](SourceLayout& l) { l.time_kind = TimeKind::timestamp_utc; }),
              HasSubstr("`time_column` reads timestamp;"));
  EXPECT_THAT(refusal([](SourceLayout& l) { l.time_kind = TimeKind::epoch_ms; }),
              HasSubstr("unusable type timestamptz"));
}

}  // namespace
}  // namespace loopscope::storage
