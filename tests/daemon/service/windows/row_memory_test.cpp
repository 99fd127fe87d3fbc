#include "daemon/service/windows/row_memory.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace loopscope::daemon {
namespace {

using core::signal::RawSeries;
using storage::RowBefore;
using storage::TagRequest;
using testing::ElementsAre;

/// An archive of one tag that answers as a historian does, and counts what it gave out.
class Archive {
 public:
  explicit Archive(RawSeries rows) : rows_(std::move(rows)) {}
  std::vector<RawSeries> read(std::span<const TagRequest> requests) {
    std::vector<RawSeries> answers;
    for (const TagRequest& request : requests) answers.push_back(answer(request));
    return answers;
  }
  std::size_t given = 0;

 private:
  RawSeries answer(const TagRequest& request) {
    RawSeries found;
    found.hold = rows_.hold;
    std::int64_t before = -1;
    for (std::size_t k = 0; k < rows_.time_us.size(); ++k) {
      if (rows_.time_us[k] < request.from_us) before = static_cast<std::int64_t>(k);
      if (rows_.time_us[k] < request.from_us || rows_.time_us[k] > request.to_us) continue;
      found.time_us.push_back(rows_.time_us[k]);
      found.value.push_back(rows_.value[k]);
    }
    const auto most = static_cast<std::size_t>(request.max_rows);
    if (found.time_us.size() > most) {
      const auto extra = static_cast<std::ptrdiff_t>(found.time_us.size() - most);
      found.time_us.erase(found.time_us.begin(), found.time_us.begin() + extra);
      found.value.erase(found.value.begin(), found.value.begin() + extra);
    }
    const bool wanted =
        request.before == RowBefore::yes ||
        (request.before == RowBefore::if_held && rows_.hold != core::signal::Hold::sample);
    if (wanted && before >= 0) {
      found.time_us.insert(found.time_us.begin(), rows_.time_us[static_cast<std::size_t>(before)]);
      found.value.insert(found.value.begin(), rows_.value[static_cast<std::size_t>(before)]);
    }
    given += found.time_us.size();
    return found;
  }
  RawSeries rows_;
};

RawSeries rows_at(const std::vector<std::int64_t>& times) {
  RawSeries rows;
  for (const std::int64_t time : times) {
    rows.time_us.push_back(time);
    rows.value.push_back(static_cast<double>(rows.value.size()));
  }
  return rows;
}

RawSeries one(RowMemory& memory, Archive& archive, const TagRequest& request) {
  return memory
      .read(std::vector{request},
            [&](std::span<const TagRequest> requests) { return archive.read(requests); })
      .at(0);
}

TEST(RowMemory, AnEarlierSpanAsksOnlyForWhatIsMissing) {
  Archive archive(rows_at({0, 10, 20, 30, 40, 50, 60}));
  RowMemory memory;
  EXPECT_THAT(one(memory, archive, {"a", 20, 60, 100, RowBefore::yes}).time_us,
              ElementsAre(10, 20, 30, 40, 50, 60));
  archive.given = 0;
  EXPECT_THAT(one(memory, archive, {"a", 10, 50, 100, RowBefore::yes}).time_us,
              ElementsAre(0, 10, 20, 30, 40, 50));
  EXPECT_EQ(archive.given, 2u);
}

TEST(RowMemory, ALongerSpanToTheSameEndAsWell) {
  Archive archive(rows_at({0, 10, 20, 30, 40}));
  RowMemory memory;
  static_cast<void>(one(memory, archive, {"a", 30, 40, 100, RowBefore::no}));
  EXPECT_THAT(one(memory, archive, {"a", 5, 40, 100, RowBefore::no}).value,
              ElementsAre(1, 2, 3, 4));
}

TEST(RowMemory, ALaterSpanAsksOnlyForWhatIsNew) {
  Archive archive(rows_at({0, 10, 20, 30, 40, 50, 60}));
  RowMemory memory;
  static_cast<void>(one(memory, archive, {"a", 10, 30, 100, RowBefore::yes}));
  archive.given = 0;
  EXPECT_THAT(one(memory, archive, {"a", 25, 50, 100, RowBefore::yes}).time_us,
              ElementsAre(20, 30, 40, 50));
  EXPECT_EQ(archive.given, 2u);
}

TEST(RowMemory, WhatIsKnownFromElsewhereIsNotRead) {
  Archive archive(rows_at({0, 10, 20, 30, 40}));
  RowMemory memory;
  memory.know("a", false, {5, 30, false, rows_at({10, 20, 30})});
  EXPECT_THAT(one(memory, archive, {"a", 15, 40, 100, RowBefore::yes}).time_us,
              ElementsAre(10, 20, 30, 40));
  EXPECT_EQ(archive.given, 1u);
}

// Two loops that share a tag want it read again from different times on.
TEST(RowMemory, OfWhatIsKnownTwiceTheEarlierPartStays) {
  Archive archive(rows_at({0, 10, 20, 30, 40}));
  RowMemory memory;
  memory.know("a", false, {0, 30, false, rows_at({0, 10, 20, 30})});
  memory.know("a", false, {0, 15, false, rows_at({0, 10})});
  static_cast<void>(one(memory, archive, {"a", 0, 40, 100, RowBefore::no}));
  EXPECT_EQ(archive.given, 3u);
}

TEST(RowMemory, OfSpansWithoutACommonPartTheEarlierOneStays) {
  Archive archive(rows_at({0, 10, 20, 30, 40}));
  for (const bool earlier_first : {true, false}) {
    RowMemory memory;
    archive.given = 0;
    if (earlier_first) memory.know("a", false, {0, 15, false, rows_at({0, 10})});
    memory.know("a", false, {20, 30, false, rows_at({20, 30})});
    if (!earlier_first) memory.know("a", false, {0, 15, false, rows_at({0, 10})});
    EXPECT_EQ(one(memory, archive, {"a", 0, 40, 100, RowBefore::no}).time_us.size(), 5u);
    EXPECT_EQ(archive.given, 3u);
  }
}

TEST(RowMemory, ARowBeforeLiesNoFurtherBackThanOneIsLookedFor) {
  RowMemory memory;
  Archive archive(rows_at({}));
  memory.know("a", false, {10, 30, true, rows_at({0})});
  const std::int64_t far = storage::kReachBefore_us;
  EXPECT_THAT(one(memory, archive, {"a", 20, far, 100, RowBefore::yes}).time_us, ElementsAre(0));
  EXPECT_TRUE(one(memory, archive, {"a", far + 1, far + 2, 100, RowBefore::yes}).empty());
}

TEST(RowMemory, OtherTagsAreReadWhole) {
  Archive archive(rows_at({0, 10, 20, 30, 40}));
  RowMemory memory;
  static_cast<void>(one(memory, archive, {"a", 20, 40, 100, RowBefore::no}));
  archive.given = 0;
  static_cast<void>(one(memory, archive, {"b", 10, 30, 100, RowBefore::no}));
  EXPECT_EQ(archive.given, 3u);
}

// Which rows of two ids count depends on all rows of both; codes of unknown quality are counted for
// a whole span; a tag that became another one keeps its values otherwise.
TEST(RowMemory, WhatCannotBeJoinedIsReadWhole) {
  for (const auto change : {+[](RawSeries& rows) { rows.merged = true; },
                            +[](RawSeries& rows) { rows.unknown_quality = 1; },
                            +[](RawSeries& rows) { rows.hold = core::signal::Hold::step; }}) {
    RawSeries changed = rows_at({0, 10, 20, 30, 40});
    change(changed);
    RowMemory memory;
    memory.know("a", false, {0, 30, true, rows_at({0, 10, 20, 30})});
    std::size_t reads = 0;
    const TagRequest request{"a", 10, 40, 100, RowBefore::no};
    const auto found = memory.read(std::vector{request}, [&](std::span<const TagRequest> requests) {
      EXPECT_EQ(requests.front().from_us, ++reads == 1 ? 31 : 10);
      RawSeries rows = rows_within(changed, requests.front().from_us, requests.front().to_us);
      change(rows);
      return std::vector{rows};
    });
    EXPECT_EQ(reads, 2U);
    EXPECT_THAT(found.at(0).time_us, ElementsAre(10, 20, 30, 40));
  }
}

TEST(RowMemory, ATagReadAsAModeIsAnotherReading) {
  Archive archive(rows_at({0, 10, 20, 30, 40}));
  RowMemory memory;
  TagRequest request{"a", 20, 40, 100, RowBefore::no};
  request.mode = true;
  static_cast<void>(one(memory, archive, request));
  archive.given = 0;
  static_cast<void>(one(memory, archive, {"a", 10, 30, 100, RowBefore::no}));
  EXPECT_EQ(archive.given, 3u);
}

// Whatever the rows, the spans and the caps: the answer is that of the archive itself.
TEST(RowMemory, GivesWhatAReadOfTheWholeSpanGives) {
  std::mt19937_64 random(7);
  const auto below = [&](std::int64_t limit) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(limit));
  };
  for (int round = 0; round < 5000; ++round) {
    std::vector<std::int64_t> times;
    for (std::int64_t k = below(30); k > 0; --k) times.push_back(below(60));
    std::ranges::sort(times);
    RawSeries rows = rows_at(times);
    rows.hold = static_cast<core::signal::Hold>(below(3));
    Archive archive(rows);
    RowMemory memory;
    for (int read = 0; read < 5; ++read) {
      const std::int64_t from = below(60);
      const TagRequest request{"a", from, from + below(40), 1 + below(20),
                               static_cast<RowBefore>(below(3))};
      const RawSeries found = one(memory, archive, request);
      const RawSeries whole = archive.read(std::vector{request}).at(0);
      ASSERT_EQ(found.time_us, whole.time_us) << "round " << round;
      ASSERT_EQ(found.value, whole.value) << "round " << round;
    }
  }
}

}  // namespace
}  // namespace loopscope::daemon
