#include "daemon/catalogue/check_tags.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(CheckTags, AsksEachSourceOnceAndNamesEveryDeadEnd) {
  std::vector<storage::CatalogueEntry> entries(3);
  entries[0].name = "a, first";
  entries[0].pv_tag = "A.PV";
  entries[0].op_tag = "A.OP";
  entries[1].name = "b";
  entries[1].pv_tag = "A.PV";
  entries[1].sp_tag = "A.OP";
  entries[2].name = "c";
  entries[2].source = "other";
  entries[2].pv_tag = "A.OP";
  std::vector<std::string> asked;
  const TagCheck check =
      check_tags(entries, [&](const std::string& source, std::span<const std::string> tags) {
        std::vector<bool> answer;
        for (const std::string& tag : tags) {
          asked.push_back(source + ":" + tag);
          answer.push_back(source == "other" || tag == "A.PV");
        }
        return answer;
      });
  EXPECT_THAT(asked, testing::ElementsAre("other:A.OP", "plant:A.OP", "plant:A.PV"));
  EXPECT_EQ(check.loops, 3u);
  EXPECT_EQ(check.tags, 5u);
  EXPECT_EQ(dead_ends_csv(check),
            "loop,source,role,tag,problem\n"
            "\"a, first\",plant,op,A.OP,the historian has no row of this tag\n"
            "b,plant,sp,A.OP,the historian has no row of this tag\n");
}

storage::CatalogueEntry with_mode(const std::string& name) {
  storage::CatalogueEntry entry;
  entry.name = name;
  entry.pv_tag = name + ".PV";
  entry.mode_tag = name + ".MODE";
  return entry;
}

TEST(CheckTags, DeadEndsAreDroppedButForPv) {
  std::vector<storage::CatalogueEntry> entries{with_mode("A"), with_mode("B")};
  const TagCheck check =
      check_tags(entries, [](const std::string&, std::span<const std::string> tags) {
        std::vector<bool> answer;
        for (const std::string& tag : tags) answer.push_back(tag == "B.MODE");
        return answer;
      });
  drop_dead_ends(check, entries);
  EXPECT_EQ(entries[0].pv_tag, "A.PV");
  EXPECT_EQ(entries[0].mode_tag, "");
  EXPECT_EQ(entries[1].mode_tag, "B.MODE");
}

}  // namespace
}  // namespace loopscope::daemon
