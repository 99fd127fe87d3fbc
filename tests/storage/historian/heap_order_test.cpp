#include "storage/historian/heap_order.hpp"

#include <algorithm>
#include <gmock/gmock.h>

#include "storage/historian/scan_rows.hpp"
#include "storage/historian/tag_value.hpp"
#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::signal::RawSeries;

constexpr int kTags = 600;
constexpr std::int64_t kRows = 400;
constexpr std::size_t kRead = 12;

/// A table as a historian fills it: the rows of all tags, second by second; some late, some twice.
class HeapOrderTest : public HistorianTest {
 protected:
  void SetUp() override {
    HistorianTest::SetUp();
    if (IsSkipped()) return;
    database->execute(
        "DELETE FROM public.history; DO $$ DECLARE name text; BEGIN FOR name IN"
        " SELECT indexname FROM pg_indexes WHERE tablename = 'history' LOOP"
        " EXECUTE format('DROP INDEX public.%I', name); END LOOP; END $$;"
        "INSERT INTO public.history SELECT 'tag' || i, timestamptz"
        " '2026-01-01 00:00:00+00' + k * interval '1 second',"
        " CASE WHEN (i + k) % 97 = 0 THEN NULL ELSE i * 1000 + k END,"
        " CASE WHEN (i + k) % 89 = 0 THEN 0 ELSE 192 END"
        " FROM generate_series(0, " +
        std::to_string(kRows - 1) +
        ") AS k,"
        " generate_series(1, " +
        std::to_string(kTags) +
        ") AS i"
        " WHERE k % 50 <> 7 ORDER BY k, i;"
        "INSERT INTO public.history SELECT 'tag' || i, timestamptz"
        " '2026-01-01 00:00:00+00' + k * interval '1 second', -i, 192"
        " FROM (VALUES (57), (57), (7), (200)) AS late (k), generate_series(1, " +
        std::to_string(kTags) + ") AS i");
    index("(tag, time)");
  }

  void index(const std::string& columns) {
    database->execute("DROP INDEX IF EXISTS public.by_tag; CREATE INDEX by_tag ON public.history " +
                      columns);
    database->execute("VACUUM ANALYZE public.history");
  }

  [[nodiscard]] static std::vector<TagRequest> requests(std::int64_t from_s, std::int64_t to_s,
                                                        std::int64_t max_rows) {
    std::vector<TagRequest> wanted;
    for (std::size_t i = 0; i < kRead; ++i) {
      wanted.push_back(request("tag" + std::to_string(50 + i), from_s, to_s, max_rows));
      wanted.back().before = i % 3 == 0 ? RowBefore::yes : RowBefore::no;
    }
    return wanted;
  }

  [[nodiscard]] static Scan scan_of(const TagRequest& one, const PqConnection& connection,
                                    const ResolvedLayout& resolved) {
    const bool before = one.before == RowBefore::yes;
    return {{one.tag},
            one.from_us,
            one.to_us,
            one.max_rows,
            {{value_of(connection, resolved, "").value(), before, {}}}};
  }

  /// Whether the planner would read those together.
  [[nodiscard]] bool is_better(const std::vector<TagRequest>& wanted) {
    ConnectionSettings as_reader = settings();
    as_reader.read_only = true;
    PqConnection connection(as_reader);
    const ResolvedLayout resolved = resolve_layout(connection, layout);
    std::vector<Scan> batch;
    for (const TagRequest& one : wanted) batch.push_back(scan_of(one, connection, resolved));
    if (!HeapOrder::fits(batch, resolved)) return false;
    const auto statements =
        historian_statements::read_in_heap_order(resolved, {resolved.data.sql}, columns_of(batch));
    return HeapOrder().is_better(connection, statements.plan, batch,
                                 heap_order_parameters(batch, resolved));
  }

  /// All at once gives what each by itself gives, which is few keys and so by the index.
  void expect_alike(const std::vector<TagRequest>& wanted) {
    HistorianReader historian = reader();
    const std::vector<RawSeries> together = historian.read(wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const RawSeries alone = read_one(historian, wanted[i]);
      EXPECT_FALSE(alone.empty());
      EXPECT_EQ(together[i].time_us, alone.time_us) << wanted[i].tag;
      EXPECT_THAT(together[i].value,
                  testing::Pointwise(testing::NanSensitiveDoubleEq(), alone.value));
      EXPECT_EQ(together[i].unknown_quality, alone.unknown_quality);
    }
  }
};

TEST_F(HeapOrderTest, RowsAreThoseThatTheIndexGives) {
  const std::vector<TagRequest> wanted = requests(3, kRows, 1000);
  EXPECT_TRUE(is_better(wanted));
  expect_alike(wanted);
}

TEST_F(HeapOrderTest, SpansThatDifferAreReadApart) {
  std::vector<TagRequest> wanted = requests(3, kRows, 1000);
  for (const TagRequest& later : requests(20, 300, 1000)) wanted.push_back(later);
  wanted.push_back(request("tag50", 5, 300));
  expect_alike(wanted);
}

TEST_F(HeapOrderTest, TagsWithTooManyRowsAreReadByTheIndex) {
  // All together have as many as they may, one of them more.
  std::vector<TagRequest> wanted = requests(3, kRows, 1000);
  wanted[5].max_rows = 300;
  EXPECT_TRUE(is_better(wanted));
  expect_alike(wanted);
  EXPECT_FALSE(is_better(requests(3, kRows, 256))) << "the planner expects more";
  expect_alike(requests(3, kRows, 256));
}

TEST_F(HeapOrderTest, SeveralTablesAreReadAsOne) {
  PqConnection connection(settings());
  const ResolvedLayout resolved = resolve_layout(connection, layout);
  const std::vector<Scan> batch{scan_of(request("tag50", 3, kRows), connection, resolved)};
  const auto rows_of = [&](const std::vector<std::string>& tables) {
    const auto statements =
        historian_statements::read_in_heap_order(resolved, tables, columns_of(batch));
    const PqRows rows = connection.run(statements.read, heap_order_parameters(batch, resolved),
                                       ResultFormat::binary);
    return rows_of_span(rows, 0, resolved);
  };
  const std::string table = resolved.data.sql;
  EXPECT_GT(rows_of({table}), 300u);
  EXPECT_EQ(rows_of({table, table}), 2 * rows_of({table}));
}

TEST_F(HeapOrderTest, AnIndexThatCoversIsBetter) {
  index("(tag, time) INCLUDE (value, quality)");
  const std::vector<TagRequest> wanted = requests(3, kRows, 1000);
  EXPECT_FALSE(is_better(wanted));
  expect_alike(wanted);
}

TEST_F(HeapOrderTest, TagsThatAreNotThereAreEmpty) {
  std::vector<TagRequest> wanted = requests(3, kRows, 1000);
  wanted[4].tag = "no such";
  HistorianReader historian = reader();
  const std::vector<RawSeries> rows = historian.read(wanted);
  EXPECT_TRUE(rows[4].empty());
  EXPECT_FALSE(rows[3].empty() || rows[5].empty());
}

TEST_F(HeapOrderTest, FewKeysFewRowsAndTiesThatAColumnBreaksAreTheIndexs) {
  std::vector<TagRequest> wanted = requests(3, kRows, 1000);
  EXPECT_FALSE(is_better({wanted.begin(), wanted.begin() + 4}));
  EXPECT_FALSE(is_better(requests(3, kRows, 255)));
  layout.tiebreak_column = "quality";
  EXPECT_FALSE(is_better(wanted));
}

}  // namespace
}  // namespace loopscope::storage
