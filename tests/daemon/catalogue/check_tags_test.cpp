#include "daemon/catalogue/check_tags.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kSecond_us = 1'000'000;
constexpr std::int64_t kNow_us = 1'767'225'600 * kSecond_us;  // 2026-01-01T00:00:00Z

NewestRows ages(std::span<const std::string> tags, const std::map<std::string, double>& age_s) {
  NewestRows rows{{}, kNow_us};
  for (const std::string& tag : tags) {
    const auto known = age_s.find(tag);
    rows.of_tags.push_back(
        known == age_s.end()
            ? std::nullopt
            : std::optional(kNow_us - static_cast<std::int64_t>(known->second) * kSecond_us));
  }
  return rows;
}

storage::CatalogueEntry loop_of(const std::string& name, const std::string& sp,
                                const std::string& pv, const std::string& op) {
  storage::CatalogueEntry entry;
  entry.name = name;
  entry.sp_tag = sp;
  entry.pv_tag = pv;
  entry.op_tag = op;
  entry.period_s = 3600.0;
  return entry;
}

TEST(CheckTags, AsksEachSourceOnceAndGivesEveryAge) {
  std::vector entries{loop_of("a, first", "", "A.PV", "A.OP"), loop_of("b", "A.OP", "A.PV", ""),
                      loop_of("c", "", "A.OP", "")};
  entries[2].source = "other";
  std::vector<std::string> asked;
  const TagCheck check =
      check_tags(entries, [&](const std::string& source, std::span<const std::string> tags) {
        for (const std::string& tag : tags) asked.push_back(source + ":" + tag);
        return ages(tags, source == "other" ? std::map<std::string, double>{{"A.OP", 90.0}}
                                            : std::map<std::string, double>{{"A.PV", 60.0}});
      });
  EXPECT_THAT(asked, ElementsAre("other:A.OP", "plant:A.OP", "plant:A.PV"));
  EXPECT_EQ(check.loops, 3u);
  EXPECT_EQ(check.without_rows(), 2u);
  EXPECT_EQ(check.stopped(), 0u);
  EXPECT_EQ(checked_tags_csv(check),
            "loop,source,role,tag,newest_row,age_s,problem\n"
            "\"a, first\",plant,pv,A.PV,2025-12-31T23:59:00Z,60,\n"
            "\"a, first\",plant,op,A.OP,,,the historian has no row of this tag\n"
            "b,plant,sp,A.OP,,,the historian has no row of this tag\n"
            "b,plant,pv,A.PV,2025-12-31T23:59:00Z,60,\n"
            "c,other,pv,A.OP,2025-12-31T23:58:30Z,90,\n");
}

/// Beside a live tag of the source; each with the longest time that passed between its rows.
TEST(CheckTags, StoppedIsSilentForLongerThanEverAndThanThePeriod) {
  struct Case {
    const char* what;
    double age_s;
    std::optional<double> longest_gap_s;
    bool stopped;
  };
  const std::vector<Case> cases{
      {"renamed three days ago", 259'200.0, 1.0, true},
      {"a setpoint that changes once a week", 259'200.0, 604'800.0, false},
      {"a setpoint that was hardly ever changed", 1e8, std::nullopt, false},
      {"within the loop's period", 3500.0, 1.0, false},
      {"not twice as long as ever", 7000.0, 4000.0, false},
  };
  for (const Case& one : cases) {
    const std::vector entries{loop_of("a", "", "live", "tag")};
    TagCheck check =
        check_tags(entries, [&](const std::string&, std::span<const std::string> tags) {
          return ages(tags, {{"live", 10.0}, {"tag", one.age_s}});
        });
    find_stopped(check, [&](const std::string&, std::span<const std::string> tags) {
      return std::vector(tags.size(), one.longest_gap_s);
    });
    EXPECT_EQ(check.stopped(), one.stopped ? 1u : 0u) << one.what;
  }
}

TEST(CheckTags, WhereAllHaveStoppedTheHistorianHas) {
  const std::vector entries{loop_of("a", "", "A.PV", "A.OP")};
  TagCheck check = check_tags(entries, [&](const std::string&, std::span<const std::string> tags) {
    return ages(tags, {{"A.PV", 1e6}, {"A.OP", 1e6}});
  });
  find_stopped(check, [](const std::string&, std::span<const std::string> tags) {
    ADD_FAILURE() << "nothing is behind";
    return std::vector<std::optional<double>>(tags.size());
  });
  EXPECT_EQ(check.stopped(), 0u);
}

TEST(CheckTags, DeadEndsAreDroppedButForPv) {
  std::vector entries{loop_of("A", "", "A.PV", ""), loop_of("B", "", "B.PV", "")};
  for (storage::CatalogueEntry& entry : entries) entry.mode_tag = entry.name + ".MODE";
  const TagCheck check =
      check_tags(entries, [](const std::string&, std::span<const std::string> tags) {
        return ages(tags, {{"B.MODE", 1.0}});
      });
  drop_dead_ends(check, entries);
  EXPECT_EQ(entries[0].pv_tag, "A.PV");
  EXPECT_EQ(entries[0].mode_tag, "");
  EXPECT_EQ(entries[1].mode_tag, "B.MODE");
}

}  // namespace
}  // namespace loopscope::daemon
