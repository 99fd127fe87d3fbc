#include "daemon/setup/recognise_layouts.hpp"

#include <gmock/gmock.h>

#include "daemon/text/failure.hpp"
#include "tests/daemon/setup/seen_tables.hpp"

namespace loopscope::daemon {
namespace {

using storage::SeenTable;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

SeenTable archive() {
  return seen_table("archive", {{"tagname", "text"},
                                {"zeitstempel", "timestamptz"},
                                {"wert", "float4"},
                                {"status", "int2"}});
}

SeenTable measurement() {
  return seen_table("plc", {{"time", "timestamp"},
                            {"host", "text"},
                            {"name", "text"},
                            {"SP", "float8"},
                            {"PV", "float8"},
                            {"OP", "float8"},
                            {"MODE", "text"}});
}

SeenTable users() {
  return seen_table("users", {{"id", "int4"}, {"name", "text"}});
}

LayoutWishes wish_of_table(const std::string& table) {
  LayoutWishes wishes;
  wishes.table = table;
  return wishes;
}

config::HistorianSettings only(const std::vector<SeenTable>& tables,
                               const LayoutWishes& wishes = {}) {
  const auto found = recognise_layouts(tables, wishes);
  EXPECT_THAT(found, SizeIs(1));
  EXPECT_EQ(found.at(0).open, "");
  return found.at(0).historian;
}

TEST(RecogniseLayouts, ANarrowTableByNamesAndTypesInSeveralLanguages) {
  const auto historian = only({archive(), users()});
  EXPECT_EQ(historian.preset, "narrow");
  EXPECT_EQ(historian.table, "public.archive");
  EXPECT_EQ(historian.tag_column, "tagname");
  EXPECT_EQ(historian.time_column, "zeitstempel");
  EXPECT_EQ(historian.value_column, "wert");
  EXPECT_EQ(historian.quality_column, "status");
}

TEST(RecogniseLayouts, ANarrowTableByTypesAlone) {
  const auto historian =
      only({seen_table("x", {{"a", "varchar"}, {"b", "timestamptz"}, {"c", "numeric"}})});
  EXPECT_EQ(historian.tag_column, "a");
  EXPECT_EQ(historian.time_column, "b");
  EXPECT_EQ(historian.value_column, "c");
  EXPECT_EQ(historian.quality_column, "");
  EXPECT_EQ(historian.quality_rule, "none");
}

TEST(RecogniseLayouts, TimesAsNumbersByTheirName) {
  const auto historian =
      only({seen_table("x", {{"tag", "text"}, {"ts", "int8"}, {"value", "float8"}})});
  EXPECT_EQ(historian.time_column, "ts");
  EXPECT_EQ(historian.time_kind, "epoch_ms");
}

TEST(RecogniseLayouts, TelegrafByTimesWithoutAZoneAndItsHost) {
  const auto historian = only({measurement()});
  EXPECT_EQ(historian.preset, "telegraf");
  EXPECT_EQ(historian.tag_column, "name");
}

TEST(RecogniseLayouts, TelegrafsCommentsSayWhatATagIs) {
  SeenTable table = measurement();
  table.columns.insert(table.columns.begin() + 1, {"place", "text", "tag"});
  EXPECT_EQ(only({table}).tag_column, "place");
}

TEST(RecogniseLayouts, ARowOfSeveralValuesIsALoopsOrAllOfThem) {
  EXPECT_EQ(
      only({seen_table(
               "x", {{"loop", "text"}, {"at", "timestamptz"}, {"sp", "float8"}, {"pv", "float8"}})})
          .preset,
      "loop_row");
  EXPECT_EQ(only({seen_table("x", {{"id", "int8"},
                                   {"at", "timestamptz"},
                                   {"FIC1.PV", "float8"},
                                   {"FIC1.SP", "float8"}})})
                .preset,
            "wide");
}

TEST(RecogniseLayouts, NumbersForTagsFindTheirNames) {
  const SeenTable data =
      seen_table("rows", {{"tag_id", "int4"}, {"t", "timestamptz"}, {"v", "float8"}});
  const auto historian =
      only({data, seen_table("tags", {{"tag_id", "int4"}, {"tagname", "text"}})});
  EXPECT_EQ(historian.tag_table, "public.tags");
  EXPECT_EQ(historian.tag_name_column, "tagname");
  EXPECT_EQ(historian.tag_id_column, "tag_id");
  EXPECT_EQ(only({data}).tag_table, "") << "the numbers themselves are the tags then";
}

TEST(RecogniseLayouts, SeveralTablesAreSeveralCandidates) {
  const std::vector<SeenTable> tables = {archive(), measurement(), users()};
  const auto found = recognise_layouts(tables, {});
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(describe(found[0]),
            "public.archive: preset narrow, time in zeitstempel (timestamptz), tag in tagname, "
            "value in wert, quality in status, about 1000 rows");
  EXPECT_EQ(only(tables, wish_of_table("public.plc")).preset, "telegraf");
  LayoutWishes narrow;
  narrow.preset = "narrow";
  EXPECT_EQ(only(tables, narrow).table, "public.archive");
}

TEST(RecogniseLayouts, AVendorsSetGoesBeforeSingleTables) {
  const std::vector<SeenTable> tables = {
      seen_table("datapoints", {{"id", "int4"}, {"xid", "varchar"}}),
      seen_table(
          "pointvalues",
          {{"id", "int8"}, {"datapointid", "int4"}, {"pointvalue", "float8"}, {"ts", "int8"}}),
      archive()};
  EXPECT_EQ(only(tables).preset, "scada_lts");
  EXPECT_EQ(only(tables, wish_of_table("archive")).preset, "narrow");
}

TEST(RecogniseLayouts, AVendorsSetInAnotherSchemaIsFoundThere) {
  std::vector<SeenTable> tables = {
      seen_table("states",
                 {{"metadata_id", "int8"}, {"state", "varchar"}, {"last_updated_ts", "float8"}}),
      seen_table("states_meta", {{"metadata_id", "int8"}, {"entity_id", "varchar"}})};
  for (SeenTable& table : tables) table.schema = "ha";
  const auto found = recognise_layouts(tables, {});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].historian.table, "ha.states");
  EXPECT_EQ(found[0].historian.tag_table, "ha.states_meta");
  EXPECT_THAT(found[0].tables, ElementsAre(storage::TableName{"ha", "states_meta"},
                                           storage::TableName{"ha", "states"}));
}

TEST(RecogniseLayouts, WhatNobodyCanTellIsLeftToAnOption) {
  const SeenTable table = seen_table(
      "x", {{"one", "text"}, {"two", "text"}, {"at", "timestamptz"}, {"value", "float8"}});
  const auto found = recognise_layouts({table}, {});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].open, "which column names the tag: --tag-column with one of one, two");
  LayoutWishes wishes;
  wishes.tag_column = "two";
  EXPECT_EQ(only({table}, wishes).tag_column, "two");
}

TEST(RecogniseLayouts, WhatIsNoHistoryIsNone) {
  EXPECT_THAT(recognise_layouts({users()}, {}), IsEmpty());
  EXPECT_THAT(recognise_layouts({}, {}), IsEmpty());
}

TEST(RecogniseLayouts, AWishThatIsNotThereIsSaid) {
  try {
    static_cast<void>(recognise_layouts({archive()}, wish_of_table("histroy")));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_THAT(failure.hint(), HasSubstr("public.archive"));
  }
  LayoutWishes wishes;
  wishes.value_column = "val";
  try {
    static_cast<void>(recognise_layouts({archive()}, wishes));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("--value-column: public.archive has no column val"));
    EXPECT_THAT(failure.hint(), HasSubstr("wert"));
  }
}

/// What is said of a preset that somebody wishes.
std::string said_of(const std::vector<SeenTable>& tables, const std::string& preset,
                    const std::string& table = "") {
  LayoutWishes wishes = wish_of_table(table);
  wishes.preset = preset;
  try {
    return recognise_layouts(tables, wishes).empty() ? "none" : "fits";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    return failure.what() + std::string(" HINT: ") + failure.hint();
  }
}

TEST(RecogniseLayouts, APresetThatDoesNotFitSaysWhatIsMissingAndWhatFits) {
  EXPECT_EQ(said_of({measurement()}, "wide"),
            "--preset wide does not fit: public.plc has no column for each tag: name says whose a "
            "row is HINT: what fits: --preset telegraf --table public.plc");
  EXPECT_EQ(said_of({measurement()}, "narrow", "plc"),
            "--preset narrow does not fit: public.plc has no one column of values (--value-column; "
            "it has SP, PV, OP) HINT: what fits: --preset telegraf --table public.plc");
  EXPECT_EQ(said_of({archive(), users()}, "loop_row"),
            "--preset loop_row does not fit: public.archive has no columns for a loop's sp, pv and "
            "op, only wert HINT: what fits: --preset narrow --table public.archive");
  EXPECT_EQ(said_of({users()}, "narrow", "users"),
            "--preset narrow does not fit: public.users has no column of times (--time-column), no "
            "column of values (--value-column) HINT: no other preset fits either; "
            "config/HISTORIANS.md says what each one needs");
  EXPECT_EQ(said_of({measurement()}, "loop_row"), "fits");
  EXPECT_EQ(said_of({users()}, "wide"), "none");
}

TEST(RecogniseLayouts, AVendorsPresetSaysWhichTablesAreMissing) {
  EXPECT_EQ(
      said_of({archive(), seen_table("pointvalues",
                                     {{"id", "int8"}, {"datapointid", "int4"}, {"ts", "int8"}})},
              "scada_lts"),
      "--preset scada_lts does not fit: no table datapoints, no column pointvalue in "
      "public.pointvalues HINT: what fits: --preset narrow --table public.archive");
}

TEST(RecogniseLayouts, AColumnThatIsNamedTellsTheTable) {
  LayoutWishes wishes;
  wishes.value_column = "wert";
  EXPECT_EQ(only({measurement(), archive()}, wishes).table, "public.archive");
}

}  // namespace
}  // namespace loopscope::daemon
