#include <algorithm>
#include <gmock/gmock.h>

#include "storage/error.hpp"
#include "storage/historian/list_tags.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "tests/storage/historian/historian_fixture.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::storage {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::HostileName;

class HostileIdentifiers : public HistorianTest {
 protected:
  [[nodiscard]] std::string refusal() const {
    try {
      const HistorianReader historian(settings(), layout);
      return "accepted";
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::give_up);
      EXPECT_NE(error.hint(), "");
      return error.what();
    }
  }
};

TEST_F(HostileIdentifiers, SchemasTablesAndColumnsOfTheseNamesAreReadAndNoOthers) {
  const std::vector<HostileName> names = tests::hostile_identifiers();
  const auto name = [&](std::size_t k) { return names[k % names.size()].name; };
  std::string schemas;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool ends_at_dot = name(k).find('.') != std::string::npos;
    if (!ends_at_dot) schemas += "CREATE SCHEMA " + tests::sql_identifier(name(k)) + ";";
  }
  database->execute("CREATE SCHEMA dotted;" + schemas);
  // Every name comes to every place.
  for (std::size_t k = 0; k < names.size(); ++k) {
    SCOPED_TRACE(std::string(names[k].about) + ": " + names[k].name);
    const bool ends_at_dot = name(k).find('.') != std::string::npos;
    const std::string schema = ends_at_dot ? "dotted" : name(k);
    layout.relation = schema + "." + name(k + 1);
    layout.key.front().column = name(k + 2);
    layout.time_column = name(k + 3);
    layout.value_columns = {name(k + 4)};
    layout.quality_column = name(k + 5);
    ASSERT_TRUE(create_historian_table(settings(), layout));
    import_rows(settings(), layout, std::vector{rows_of(name(k), {1, 2})}, false);
    HistorianReader historian = reader();
    EXPECT_THAT(read_one(historian, request(name(k), 0, 9)).value, ElementsAre(1, 2));
    if (k % 3 == 0) {
      EXPECT_THAT(list_tags(settings(), layout), ElementsAre(name(k)));
    } else if (k % 3 == 1) {
      const std::vector<Finding> findings = check_historian(settings(), layout);
      EXPECT_FALSE(findings.empty());
      for (const Finding& found : findings) EXPECT_TRUE(found.ok) << found.what;
    }
  }
  EXPECT_EQ(database->value("SELECT count(*) FROM public.history"), "0");
}

TEST_F(HostileIdentifiers, ColumnsOfATableThatHoldsEveryTag) {
  std::string columns, values;
  std::vector<std::string> names;
  for (const HostileName& hostile : tests::hostile_identifiers()) {
    names.push_back(hostile.name);
    columns += ", " + tests::sql_identifier(hostile.name) + " real";
    values += ", " + std::to_string(names.size());
  }
  database->execute("CREATE TABLE wide (at timestamptz PRIMARY KEY" + columns +
                    "); INSERT INTO wide VALUES ('2026-01-01 00:00:01+00'" + values + ")");
  layout.shape = Shape::wide;
  layout.relation = "wide";
  layout.key.clear();
  layout.time_column = "at";
  layout.quality_column = "";
  HistorianReader historian = reader();
  std::vector<TagRequest> wanted;
  for (const std::string& name : names) wanted.push_back(request(name, 0, 9));
  const auto rows = historian.read(wanted);
  for (std::size_t k = 0; k < names.size(); ++k)
    EXPECT_THAT(rows[k].value, ElementsAre(static_cast<double>(k + 1))) << names[k];
  std::ranges::sort(names);
  EXPECT_EQ(list_tags(settings(), layout), names);
}

/// A table of data whose only tag 7 has a name, and whose codes have some, in a table of that name
/// with a column of that name.
std::string side_tables_sql(const std::string& schema, const std::string& name) {
  const std::string quoted = tests::sql_identifier(name), names = schema + "." + quoted;
  return "CREATE SCHEMA " + schema + "; CREATE TABLE " + names + " (" + quoted +
         " text, i int); CREATE TABLE " + schema +
         ".d (tag int, time timestamptz, value real, quality int); INSERT INTO " + names +
         " VALUES (" + tests::sql_text(name) + ", 7); INSERT INTO " + schema +
         ".d VALUES (7, '2026-01-01 00:00:01+00', 1.5, 7), (7, '2026-01-01 00:00:02+00', 2.5, 8);";
}

TEST_F(HostileIdentifiers, TablesOfNamesAndOfCodes) {
  const std::vector<HostileName> names = tests::hostile_identifiers();
  std::string sql;
  for (std::size_t k = 0; k < names.size(); ++k)
    sql += side_tables_sql("s" + std::to_string(k), names[k].name);
  database->execute(sql);
  for (std::size_t k = 0; k < names.size(); ++k) {
    SCOPED_TRACE(names[k].name);
    const std::string schema = "s" + std::to_string(k);
    const SideTable side{schema + "." + names[k].name, names[k].name, "i"};
    layout.relation = schema + ".d";
    layout.key.front().names = side;
    layout.quality = {QualityRule::codes, false, {names[k].name}, {}, {}, side};
    HistorianReader historian = reader();
    const auto rows = read_one(historian, request(names[k].name, 0, 9));
    ASSERT_EQ(rows.value.size(), 2U);
    EXPECT_EQ(rows.value[0], 1.5);
    EXPECT_NE(rows.value[1], 2.5) << "its code has another name";
  }
}

TEST_F(HostileIdentifiers, StatesAndCodesAreOnlyTexts) {
  database->execute("CREATE TABLE texts (tag text, time timestamptz, value text, quality text)");
  layout.relation = "texts";
  layout.quality.rule = QualityRule::codes;
  for (const HostileName& hostile : tests::hostile_names()) {
    layout.states.emplace_back(hostile.name, 42.0);
    layout.quality.good.push_back(hostile.name);
  }
  database->execute(
      "INSERT INTO texts VALUES ('a', '2026-01-01 00:00:01+00', 'x'' OR ''1''=''1', '$1'),"
      " ('a', '2026-01-01 00:00:02+00', 'X'' or ''1''=''1', 'nothing known')");
  HistorianReader historian = reader();
  const auto rows = read_one(historian, request("a", 0, 9));
  EXPECT_EQ(rows.value.at(0), 42.0);
  EXPECT_NE(rows.value.at(1), 42.0) << "its quality is not known";
  EXPECT_EQ(rows.unknown_quality, 1);
}

TEST_F(HostileIdentifiers, ALongNameNeverMeansTheTableOfItsBeginning) {
  const std::string longest(kLongestIdentifier, 'n'), longer = longest + "n";
  database->execute("CREATE TABLE " + longest + " (LIKE public.history)");
  layout.relation = "public." + longest;
  EXPECT_EQ(refusal(), "accepted");
  layout.relation = "public." + longer;
  EXPECT_THAT(refusal(), HasSubstr("no such table or view"));
  EXPECT_THROW(static_cast<void>(create_historian_table(settings(), layout)), DatabaseError);
  database->execute("CREATE SCHEMA s" + longest.substr(1) + "; CREATE TABLE s" + longest.substr(1) +
                    ".history (LIKE public.history)");
  layout.relation = "s" + longer.substr(1) + ".history";
  EXPECT_THAT(refusal(), HasSubstr("no such table or view"));
  layout.relation = "public.history";
  layout.value_columns = {longer};
  EXPECT_THAT(refusal(), HasSubstr("no column"));
}

TEST_F(HostileIdentifiers, WhatIsNoTextIsRefusedInWords) {
  for (const HostileName& bad : tests::impossible_names()) {
    layout = SourceLayout{};
    layout.relation = "public." + bad.name;
    EXPECT_THAT(refusal(), HasSubstr("no such table or view")) << bad.about;
    EXPECT_THROW(static_cast<void>(create_historian_table(settings(), layout)), DatabaseError);
    layout = SourceLayout{};
    layout.time_column = bad.name;
    EXPECT_THAT(refusal(), HasSubstr("no column")) << bad.about;
    layout = SourceLayout{};
    layout.states = {{bad.name, 1.0}};
    layout.quality = {QualityRule::codes, false, {bad.name}, {}, {}, std::nullopt};
    EXPECT_NE(refusal(), "accepted") << bad.about;
    layout = SourceLayout{};
    HistorianReader historian = reader();
    EXPECT_TRUE(read_one(historian, request(bad.name, 0, 9)).empty()) << bad.about;
  }
}

TEST_F(HostileIdentifiers, IndexesAreKnownByWholeNames) {
  database->execute(
      "CREATE TABLE commas (\"a,b\" text, a text, b timestamptz, time timestamptz, value real,"
      " quality int); CREATE INDEX ON commas (a, b, time)");
  layout.relation = "commas";
  layout.key.front().column = "a,b";
  const auto advised = testing::Field(&Finding::index_sql, testing::HasSubstr("\"a,b\""));
  EXPECT_THAT(check_historian(settings(), layout), Contains(advised));
  database->execute("CREATE INDEX ON commas (\"a,b\", time) INCLUDE (value, quality)");
  for (const Finding& found : check_historian(settings(), layout))
    EXPECT_TRUE(found.ok && found.index_sql.empty()) << found.what;
}

}  // namespace
}  // namespace loopscope::storage
