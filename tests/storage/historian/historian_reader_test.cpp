#include "storage/historian/historian_reader.hpp"

#include <chrono>
#include <gmock/gmock.h>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::signal::RawSeries;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

class ReaderTest : public HistorianTest {};

TEST_F(ReaderTest, BadMissingAndInfiniteValuesAreNaN) {
  insert("a", "2026-01-01 00:00:00+00", "1.5", "192");
  insert("a", "2026-01-01 00:00:01+00", "2", "NULL");
  insert("a", "2026-01-01 00:00:02+00", "3", "24");
  insert("a", "2026-01-01 00:00:03+00", "4", "216");
  insert("a", "2026-01-01 00:00:04+00", "5", "64");
  insert("a", "2026-01-01 00:00:05+00", "NULL", "192");
  insert("a", "2026-01-01 00:00:06+00", "'NaN'", "192");
  insert("a", "2026-01-01 00:00:07+00", "'-Infinity'", "192");
  HistorianReader historian = reader();
  const RawSeries rows = read_one(historian, request("a", 0, 100));
  EXPECT_THAT(rows.value,
              ElementsAre(1.5, IsNan(), IsNan(), 4.0, IsNan(), IsNan(), IsNan(), IsNan()));
  EXPECT_EQ(rows.time_us.front(), second(0));
  EXPECT_EQ(rows.time_us.back(), second(7));
}

TEST_F(ReaderTest, QualityRulesDiffer) {
  insert("a", "2026-01-01 00:00:00+00", "1", "0");
  insert("a", "2026-01-01 00:00:01+00", "2", "192");
  const auto values = [&](QualityRule rule, const std::string& column) {
    layout.quality.rule = rule;
    layout.quality_column = column;
    HistorianReader historian = reader();
    return read_one(historian, request("a", 0, 100)).value;
  };
  EXPECT_THAT(values(QualityRule::zero, "quality"), ElementsAre(1.0, IsNan()));
  EXPECT_THAT(values(QualityRule::opcda, "quality"), ElementsAre(IsNan(), 2.0));
  EXPECT_THAT(values(QualityRule::none, "quality"), ElementsAre(1.0, 2.0));
  EXPECT_THAT(values(QualityRule::opcda, ""), ElementsAre(1.0, 2.0));
}

TEST_F(ReaderTest, RepeatedTimesAreKeptInTheOrderOfTheirValues) {
  insert("a", "2026-01-01 00:00:01+00", "2");
  insert("a", "2026-01-01 00:00:01+00", "1");
  insert("a", "2026-01-01 00:00:02+00", "3");
  HistorianReader historian = reader();
  EXPECT_THAT(read_one(historian, request("a", 0, 100)).value, ElementsAre(1.0, 2.0, 3.0));
}

TEST_F(ReaderTest, ZerosOfBothSignsAtOneTimeComeInOneOrder) {
  for (const std::string tag : {"a", "b"}) {
    const bool negative_first = tag == "a";
    insert(tag, "2026-01-01 00:00:00+00", negative_first ? "'-0'" : "'0'");
    insert(tag, "2026-01-01 00:00:00+00", negative_first ? "'0'" : "'-0'");
  }
  HistorianReader historian = reader();
  for (const std::string tag : {"a", "b"}) {
    const auto values = read_one(historian, request(tag, 0, 10)).value;
    ASSERT_EQ(values.size(), 2U) << tag;
    EXPECT_TRUE(std::signbit(values[0]) && !std::signbit(values[1])) << tag;
  }
}

TEST_F(ReaderTest, UnknownTagIsEmptyAndDoesNotShiftTheOthers) {
  insert("a", "2026-01-01 00:00:01+00", "1");
  insert("b", "2026-01-01 00:00:01+00", "2");
  HistorianReader historian = reader();
  const std::vector<TagRequest> wanted{request("b", 0, 9), request("no such", 0, 9),
                                       request(std::string("a\0", 2), 0, 9),
                                       request("bad \xff", 0, 9), request("a", 0, 9)};
  const std::vector<RawSeries> rows = historian.read(wanted);
  EXPECT_THAT(rows[0].value, ElementsAre(2.0));
  EXPECT_TRUE(rows[1].empty() && rows[2].empty() && rows[3].empty());
  EXPECT_THAT(rows[4].value, ElementsAre(1.0));
  EXPECT_TRUE(historian.read({}).empty());
}

TEST_F(ReaderTest, BoundsAreInclusiveAndTheNewestRowsCount) {
  import_rows(settings(), layout, std::vector{rows_of("a", {0, 1, 2, 3, 4, 5})}, false);
  HistorianReader historian = reader();
  EXPECT_THAT(read_one(historian, request("a", 1, 4)).value, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(read_one(historian, request("a", 1, 4, 2)).value, ElementsAre(3, 4));
  EXPECT_TRUE(read_one(historian, request("a", 4, 1)).empty());
  EXPECT_TRUE(read_one(historian, request("a", 1, 4, 0)).empty());
}

TEST_F(ReaderTest, RowBeforeIsAddedWhenAskedFor) {
  import_rows(settings(), layout, std::vector{rows_of("a", {0, 1, 2, 3})}, false);
  HistorianReader historian = reader();
  TagRequest wanted = request("a", 2, 3);
  wanted.before = RowBefore::yes;
  const RawSeries rows = read_one(historian, wanted);
  EXPECT_THAT(rows.value, ElementsAre(1, 2, 3));
  EXPECT_EQ(rows.time_us.front(), second(1));

  wanted = request("a", 100, 200);
  wanted.before = RowBefore::yes;
  EXPECT_THAT(read_one(historian, wanted).value, ElementsAre(3)) << "nothing else in the span";
  wanted = request("a", 0, 0);
  wanted.before = RowBefore::yes;
  EXPECT_THAT(read_one(historian, wanted).value, ElementsAre(0)) << "nothing before";
}

TEST_F(ReaderTest, ManyTagsComeInSeveralRoundTrips) {
  std::vector<TagRows> tags;
  std::vector<TagRequest> wanted;
  for (int i = 0; i < 250; ++i) {
    const std::string tag = "tag" + std::to_string(i);
    tags.push_back(rows_of(tag, {static_cast<double>(i), static_cast<double>(i) + 0.5}));
    wanted.push_back(request(tag, 0, 9, i % 3 == 0 ? 500'000 : 10));
  }
  EXPECT_EQ(import_rows(settings(), layout, tags, false), 500u);
  HistorianReader historian = reader();
  const std::vector<RawSeries> rows = historian.read(wanted);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_THAT(rows[i].value, ElementsAre(static_cast<double>(i), static_cast<double>(i) + 0.5));
  }
}

/// By growing spans as by one look at the whole history.
TEST_F(ReaderTest, NewestRowsOfRandomHistoriesAreThoseOfAPlainStatement) {
  database->execute(
      "SELECT setseed(0.5); INSERT INTO public.history SELECT 't' || tag,"
      " timestamptz '2026-01-01 00:00:00+00' -"
      " exp(random() * 20.5) * interval '1 second', 1, 192"
      " FROM generate_series(1, 40) AS tag, generate_series(1, tag / 4) AS k");
  std::vector<std::string> tags;
  for (int tag = 1; tag <= 41; ++tag) tags.push_back("t" + std::to_string(tag));
  HistorianReader historian = reader();
  for (const std::int64_t back_s : {0, 1800, 5000, 200'000, 6'000'000, 100'000'000}) {
    const auto newest = historian.newest(tags, second(-back_s));
    for (std::size_t k = 0; k < tags.size(); ++k) {
      const std::string expected = database->value(
          "SELECT coalesce((extract(epoch FROM max(time)) * 1000000)::int8::text, 'none')"
          " FROM public.history WHERE tag = '" +
          tags[k] + "' AND time <= to_timestamp(" + std::to_string(second(-back_s) / 1'000'000) +
          ") AND time >= to_timestamp(" +
          std::to_string(second(-back_s - std::int64_t{30} * 366 * 86'400) / 1'000'000) + ")");
      EXPECT_EQ(newest[k] ? std::to_string(*newest[k]) : "none", expected) << tags[k] << back_s;
    }
  }
}

TEST_F(ReaderTest, NewestRowOfEachTag) {
  import_rows(settings(), layout, std::vector{rows_of("a", {0, 1, 2}), rows_of("b", {0})}, false);
  insert("old", "2024-01-01 00:00:00+00", "1");
  HistorianReader historian = reader();
  const std::vector<std::string> tags{"b", "no such", "a", "old"};
  EXPECT_THAT(
      historian.newest(tags, second(1000)),
      ElementsAre(second(0), std::nullopt, second(2), testing::Optional(testing::Lt(second(0)))))
      << "archives of recordings that ended years ago are found too";
  EXPECT_THAT(
      historian.newest(tags, second(1)),
      ElementsAre(second(0), std::nullopt, second(1), testing::Optional(testing::Lt(second(0)))));
}

TEST_F(ReaderTest, ClockIsTheServers) {
  HistorianReader historian = reader();
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(
                       std::chrono::system_clock::now().time_since_epoch())
                       .count();
  EXPECT_NEAR(static_cast<double>(historian.now_us() - now), 0.0, 10e6);
}

TEST_F(ReaderTest, NeverWrites) {
  database->execute(
      "CREATE FUNCTION spy() RETURNS float8 LANGUAGE sql VOLATILE AS"
      " 'INSERT INTO public.history VALUES (''x'', now(), 1, 192) RETURNING value';"
      "CREATE VIEW trap AS SELECT tag, time, spy() AS value, quality FROM history");
  insert("a", "2026-01-01 00:00:01+00", "1");
  layout.relation = "public.trap";
  HistorianReader historian = reader();
  try {
    static_cast<void>(historian.read(std::vector{request("a", 0, 9)}));
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.sqlstate(), "25006");
  }
}

TEST_F(ReaderTest, PrivilegeThatIsMissingIsNamedWithItsGrant) {
  const std::string user = database->make_login("");
  try {
    HistorianReader historian(settings(user), layout);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("permission denied for table history"));
    EXPECT_EQ(error.hint(),
              "as the owner: GRANT SELECT ON history TO " + user +
                  "; `loopscope check-config` prints every grant that is missing, with its schema");
    EXPECT_EQ(error.remedy(), Remedy::give_up);
  }
  database->execute("GRANT SELECT ON public.history TO " + user);
  HistorianReader historian(settings(user), layout);
  EXPECT_TRUE(read_one(historian, request("a", 0, 9)).empty());
}

TEST_F(ReaderTest, ServerThatDiesAsksForANewConnection) {
  HistorianReader historian = reader();
  database->execute(
      "SELECT pg_terminate_backend(pid) FROM pg_stat_activity"
      " WHERE datname = current_database() AND application_name LIKE 'loopscope/%'");
  for (int use = 0; use < 3; ++use) {
    try {
      static_cast<void>(historian.now_us());
      FAIL();
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::reconnect) << error.what();
    }
  }
}

}  // namespace
}  // namespace loopscope::storage
