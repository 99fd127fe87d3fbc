#include "storage/results/catalogue/catalogue.hpp"

#include <gmock/gmock.h>
#include <stdexcept>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

class CatalogueTest : public ResultsTest {};

TEST_F(CatalogueTest, SavesFindsAndLists) {
  Catalogue loops(settings_for(*database));
  EXPECT_EQ(loops.save(std::vector{loop_named("b"), loop_named("a")}).added, 2u);
  const std::vector<CatalogueEntry> listed = loops.list();
  ASSERT_EQ(listed.size(), 2u);
  EXPECT_EQ(listed[0].name, "a");
  ASSERT_TRUE(loops.find("b"));
  EXPECT_EQ(loops.find("b")->pv_tag, "b.PV");
  EXPECT_FALSE(loops.find("c"));
  EXPECT_FALSE(loops.find("\xff"));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule WHERE enabled AND visible_at <= now()"),
            "2");
}

TEST_F(CatalogueTest, NamesMayHoldAnyText) {
  Catalogue loops(settings_for(*database));
  const std::vector<std::string> names{"'; DROP TABLE loopscope.loop; --", "a\"b\\c{,}", "NULL",
                                       "Füllstand\n°C"};
  for (const std::string& name : names) {
    EXPECT_EQ(loops.save(std::vector{loop_named(name)}).added, 1u);
    ASSERT_TRUE(loops.find(name)) << name;
    EXPECT_EQ(loops.find(name)->name, name);
  }
  EXPECT_EQ(loops.set_enabled(names, false), names.size());
}

TEST_F(CatalogueTest, SavingAgainChangesAndMakesDue) {
  Catalogue loops(settings_for(*database));
  loops.save(std::vector{loop_named("a")});
  const std::int64_t id = loops.find("a")->loop_id;
  database->execute("UPDATE loopscope.schedule SET visible_at = now() + interval '1 hour'");

  CatalogueEntry changed = loop_named("a");
  changed.period_s = 60;
  changed.enabled = false;
  EXPECT_EQ(loops.save(std::vector{changed, loop_named("new")}),
            (SavedLoops{.added = 1, .changed = 1, .unchanged = 0}));
  EXPECT_EQ(loops.find("a")->loop_id, id);
  EXPECT_EQ(loops.find("a")->period_s, 60);
  EXPECT_EQ(value("SELECT visible_at <= now() AND NOT enabled FROM loopscope.schedule"
                  " WHERE loop_id = " +
                  std::to_string(id)),
            "t");
}

/// Each field, by itself, counts as a change, and saving the same again as none.
TEST_F(CatalogueTest, WhatIsTheSameIsNoChange) {
  Catalogue loops(settings_for(*database));
  CatalogueEntry entry = loop_named("a");
  loops.save(std::vector{entry});
  const auto expect_change = [&](auto edit) {
    edit(entry);
    EXPECT_EQ(loops.save(std::vector{entry}).changed, 1u);
    EXPECT_EQ(loops.save(std::vector{entry}).unchanged, 1u);
  };
  for (std::string CatalogueEntry::*text :
       {&CatalogueEntry::source, &CatalogueEntry::sp_tag, &CatalogueEntry::pv_tag,
        &CatalogueEntry::op_tag, &CatalogueEntry::mv_tag, &CatalogueEntry::mode_tag,
        &CatalogueEntry::loop_type, &CatalogueEntry::area, &CatalogueEntry::unit,
        &CatalogueEntry::description, &CatalogueEntry::pv_unit, &CatalogueEntry::owner}) {
    expect_change([&](CatalogueEntry& one) { one.*text = "else"; });
  }
  expect_change([](CatalogueEntry& one) { one.interval_s = 2.0; });
  expect_change([](CatalogueEntry& one) { one.period_s = 61.0; });
  expect_change([](CatalogueEntry& one) { one.importance = 2.0; });
  expect_change([](CatalogueEntry& one) { one.enabled = !one.enabled; });
  expect_change([](CatalogueEntry& one) { one.op_range = core::signal::OpRange{0.0, 1.0}; });
  expect_change([](CatalogueEntry& one) { one.pv_range = core::signal::OpRange{0.0, 1.0}; });
  expect_change([](CatalogueEntry& one) { one.pv_range.reset(); });
}

TEST_F(CatalogueTest, EditsAreOneTransaction) {
  add_loops({"a", "b", "c"});
  Catalogue loops(settings_for(*database));
  const SavedLoops saved = loops.change([](const std::vector<CatalogueEntry>& all) {
    std::vector<CatalogueEntry> edited{all.at(0), all.at(1)};
    edited[1].area = "north";
    return edited;
  });
  EXPECT_EQ(saved, (SavedLoops{.added = 0, .changed = 1, .unchanged = 1}));
  EXPECT_EQ(loops.find("b")->area, "north");
  EXPECT_THROW(loops.change([](const std::vector<CatalogueEntry>&) -> std::vector<CatalogueEntry> {
    throw std::invalid_argument("no");
  }),
               std::invalid_argument);
}

TEST_F(CatalogueTest, HeldLoopStaysHeldWhenItIsChanged) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  add_loops({"a"});
  EXPECT_TRUE(results.extend(claimed, 100).empty());
  EXPECT_TRUE(claim_all(results).empty());
}

TEST_F(CatalogueTest, AllOrNothing) {
  Catalogue loops(settings_for(*database));
  CatalogueEntry bad = loop_named("bad");
  bad.period_s = 0;
  EXPECT_THROW(loops.save(std::vector{loop_named("good"), bad}), DatabaseError);
  EXPECT_TRUE(loops.list().empty());
}

TEST_F(CatalogueTest, EntriesThatCannotBeAreNamed) {
  Catalogue loops(settings_for(*database));
  const auto refusal = [&](std::vector<CatalogueEntry> entries) {
    try {
      loops.save(entries);
      ADD_FAILURE();
      return std::string();
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::give_up);
      return std::string(error.what());
    }
  };
  EXPECT_THAT(refusal({loop_named("a"), loop_named("a")}), HasSubstr("listed twice, loop a"));
  EXPECT_THAT(refusal({loop_named("bad\xff")}), HasSubstr("not UTF-8, loop bad"));
  CatalogueEntry range = loop_named("r");
  range.op_range = core::signal::OpRange{5, 5};
  EXPECT_THAT(refusal({range}), HasSubstr("loop_op_range"));
  EXPECT_THAT(refusal({loop_named("")}), HasSubstr("loop_name_check"));
}

TEST_F(CatalogueTest, SwitchingCountsTheNamesThatExist) {
  add_loops({"a", "b"});
  Catalogue loops(settings_for(*database));
  EXPECT_EQ(loops.set_enabled(std::vector<std::string>{"a", "nobody"}, false), 1u);
  EXPECT_EQ(loops.set_enabled(std::vector<std::string>{"a", "nobody"}, false), 0u);
  ResultsDatabase results = connect();
  EXPECT_EQ(results.count_enabled_loops(), 1u);
  EXPECT_EQ(loops.set_enabled(std::vector<std::string>{"a"}, true), 1u);
  EXPECT_EQ(results.count_enabled_loops(), 2u);
}

TEST_F(CatalogueTest, ThousandsAtOnce) {
  std::vector<CatalogueEntry> many;
  for (int i = 0; i < 5000; ++i) many.push_back(loop_named("loop" + std::to_string(i)));
  Catalogue loops(settings_for(*database));
  EXPECT_EQ(loops.save(many).added, 5000u);
  EXPECT_EQ(loops.save(many), (SavedLoops{.added = 0, .changed = 0, .unchanged = 5000}));
  EXPECT_EQ(loops.list().size(), 5000u);
}

}  // namespace
}  // namespace loopscope::storage
