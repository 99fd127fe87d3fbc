#include "storage/historian/list_tags.hpp"

#include <gmock/gmock.h>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ListTagsTest : public HistorianTest {
 protected:
  void fill() {
    for (const char* tag : {"b.PV", "a.PV", "B.pv", "a.PV", "c \"x\""}) {
      insert(tag, "2026-01-01 00:00:00+00", "1");
    }
    insert("a.PV", "2026-01-02 00:00:00+00", "NULL", "NULL");
  }
};

TEST_F(ListTagsTest, EachOnceSortedByBytes) {
  EXPECT_THAT(list_tags(settings(), layout), IsEmpty());
  fill();
  EXPECT_THAT(list_tags(settings(), layout), ElementsAre("B.pv", "a.PV", "b.PV", "c \"x\""));
}

TEST_F(ListTagsTest, WithoutAnIndexAndThroughAView) {
  fill();
  database->execute("CREATE TABLE bare AS TABLE history; CREATE VIEW shown AS TABLE history");
  const auto all = list_tags(settings(), layout);
  layout.relation = "public.bare";
  EXPECT_EQ(list_tags(settings(), layout), all);
  layout.relation = "public.shown";
  EXPECT_EQ(list_tags(settings(), layout), all);
}

TEST_F(ListTagsTest, TagsThatAreNumbersAndPartitionedTables) {
  database->execute(
      "CREATE TABLE numbered (tag int, time timestamptz, value float8, quality int)"
      " PARTITION BY RANGE (time);"
      "CREATE TABLE p1 PARTITION OF numbered FOR VALUES FROM ('2026-01-01') TO ('2026-02-01');"
      "CREATE TABLE p2 PARTITION OF numbered FOR VALUES FROM ('2026-02-01') TO ('2026-03-01');"
      "CREATE INDEX ON numbered (tag, time);"
      "INSERT INTO numbered VALUES (7, '2026-01-02', 1, 192), (7, '2026-02-02', 1, 192),"
      " (12, '2026-02-02', 1, 192), (NULL, '2026-02-02', 1, 192)");
  layout.relation = "public.numbered";
  EXPECT_THAT(list_tags(settings(), layout), ElementsAre("12", "7"));
}

}  // namespace
}  // namespace loopscope::storage
