#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

#include "daemon/service/historians/storage_settings.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/historian/list_tags.hpp"
#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"

namespace loopscope::tests {
namespace {

using storage::RowBefore;
using storage::TagRequest;

int number_from(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

/// The full size is LOOPSCOPE_LOOPS=50 LOOPSCOPE_ROWS=20000; the usual one holds the end of a month
/// as well.
class Windows : public testing::TestWithParam<Vendor> {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
  }
  const int loops = number_from("LOOPSCOPE_LOOPS", 4);
  const int rows = number_from("LOOPSCOPE_ROWS", 18'000);
};

TEST_P(Windows, AreBitForBitWhatPlainSqlReads) {
  const TestDatabase database;
  const Truth truth(database, loops, rows);
  database.execute(GetParam().tables);
  database.execute("ANALYZE");
  const auto settings = settings_of(GetParam(), database.conninfo());
  storage::HistorianReader reader(daemon::historian_connection(settings),
                                  daemon::historian_layout(settings));
  // Two windows: the newest rows, and one over the end of February (row 17280).
  for (const int last : {rows - 1, 17'500}) {
    const int first = last - 4095;
    std::vector<TagRequest> requests;
    for (int loop = 1; loop <= loops; ++loop) {
      for (const char* role : {"sp", "pv", "op"}) {
        requests.push_back({tag_of(GetParam(), loop, role), Truth::time_us(first),
                            Truth::time_us(last) + 1, 8192,
                            role == std::string("sp") ? RowBefore::yes : RowBefore::no});
      }
    }
    const auto series = reader.read(requests);
    std::size_t next = 0;
    for (int loop = 1; loop <= loops; ++loop) {
      for (const char* role : {"sp", "pv", "op"}) {
        const auto& read = series[next++];
        const int before = role == std::string("sp") ? 1 : 0;
        const auto expected = truth.rows(loop, role, first - before, last);
        ASSERT_EQ(read.time_us.size(), expected.size()) << loop << role << last;
        for (std::size_t k = 0; k < expected.size(); ++k) {
          ASSERT_EQ(read.time_us[k], expected[k].time_us) << loop << role << k;
          ASSERT_EQ(read.value[k], expected[k].value) << loop << role << k;
        }
        EXPECT_EQ(read.unknown_quality, 0U);
      }
    }
  }
}

TEST_P(Windows, NewestRowsAreFoundUpToATime) {
  const TestDatabase database;
  const Truth truth(database, 2, 17'400);
  database.execute(GetParam().tables);
  const auto settings = settings_of(GetParam(), database.conninfo());
  storage::HistorianReader reader(daemon::historian_connection(settings),
                                  daemon::historian_layout(settings));
  const std::vector<std::string> tags{tag_of(GetParam(), 1, "pv"), tag_of(GetParam(), 2, "op"),
                                      tag_of(GetParam(), 99, "pv")};
  for (const int last : {17'399, 300}) {
    const auto newest = reader.newest(tags, Truth::time_us(last) + 4'000'000);
    EXPECT_EQ(newest[0], Truth::time_us(last)) << last;
    EXPECT_EQ(newest[1], Truth::time_us(last)) << last;
  }
}

TEST_P(Windows, TagsOfTheHistorianAreListedAsLoopsReferToThem) {
  const TestDatabase database;
  const Truth truth(database, 2, 10);
  database.execute(GetParam().tables);
  const auto settings = settings_of(GetParam(), database.conninfo());
  const auto listed = storage::list_tags(daemon::historian_connection(settings),
                                         daemon::historian_layout(settings));
  EXPECT_TRUE(std::ranges::is_sorted(listed));
  for (int loop = 1; loop <= 2; ++loop) {
    for (const char* role : {"sp", "pv", "op"}) {
      std::string tag = tag_of(GetParam(), loop, role);
      // A path is listed as the historian's own table has it.
      if (tag.starts_with("[default]")) tag = "area/fic" + std::to_string(loop) + "/" + role;
      EXPECT_TRUE(std::ranges::binary_search(listed, tag)) << tag;
    }
  }
  EXPECT_LE(listed.size(), 9U) << "hosts and modes besides, nothing else";
}

INSTANTIATE_TEST_SUITE_P(Vendors, Windows, testing::ValuesIn(vendors()),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace loopscope::tests
