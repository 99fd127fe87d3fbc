#include "daemon/text/csv_table.hpp"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/data_failure.hpp"
#include "tests/support/hostile_names.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string csv_failure(std::string_view text) {
  return data_failure([&] { return parse_csv(text, "f.csv"); }).what();
}

TEST(CsvTable, HeaderAndRowsWithTheirLines) {
  const CsvTable table = parse_csv("a,b\n1,2\n\n3,4\n", "f.csv");
  EXPECT_THAT(table.header, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_THAT(table.rows[1].cells, ElementsAre("3", "4"));
  EXPECT_EQ(table.rows[1].line, 4U);
}

TEST(CsvTable, ByteOrderMarkCarriageReturnsAndAMissingLastNewline) {
  const CsvTable table = parse_csv(
      "\xEF\xBB\xBF"
      "a,b\r\n1,\r\n3,4",
      "f.csv");
  EXPECT_THAT(table.header, ElementsAre("a", "b"));
  EXPECT_THAT(table.rows[0].cells, ElementsAre("1", ""));
  EXPECT_THAT(table.rows[1].cells, ElementsAre("3", "4"));
}

TEST(CsvTable, QuotedCells) {
  const CsvTable table = parse_csv("a,b\n\"x,\"\"y\"\"\nz\",2\n5,6\n", "f.csv");
  EXPECT_THAT(table.rows[0].cells, ElementsAre("x,\"y\"\nz", "2"));
  EXPECT_EQ(table.rows[1].line, 4U);
}

TEST(CsvTable, WrittenCellsReadBack) {
  for (const std::string text : {"plain", "with,comma", "with \"quotes\"", "line\nbreak", ""}) {
    const CsvTable table = parse_csv("a,b\n" + csv_cell(text) + ",x\n", "f.csv");
    EXPECT_EQ(table.rows[0].cells[0], text);
  }
}

TEST(CsvTable, HostileNamesReadBack) {
  for (const tests::HostileName& hostile : tests::hostile_names()) {
    const CsvTable table =
        parse_csv("a,b\n" + csv_cell(hostile.name) + "," + csv_cell(hostile.name) + "\n", "f.csv");
    ASSERT_EQ(table.rows.size(), 1U) << hostile.about;
    EXPECT_THAT(table.rows[0].cells, ElementsAre(hostile.name, hostile.name)) << hostile.about;
  }
}

TEST(CsvTable, ProblemsNameTheirLine) {
  EXPECT_EQ(csv_failure(""), "f.csv: the file is empty");
  EXPECT_EQ(csv_failure("\n\n"), "f.csv: the file is empty");
  EXPECT_EQ(csv_failure("a,b\n1,2\n1\n"), "f.csv, line 3: 1 cell where the header has 2");
  EXPECT_EQ(csv_failure("a,b\n1,2,3\n"), "f.csv, line 2: 3 cells where the header has 2");
  EXPECT_EQ(csv_failure("a,b\n1,\"2\n"), "f.csv, line 2: a quote is opened and never closed");
}

/// What the header of find_csv_form() has to hold.
CsvForm form_of(std::string_view text) {
  return find_csv_form(text, "f.csv", [](const std::vector<std::string>& header) {
    return std::ranges::find(header, "pv") != header.end();
  });
}

TEST(CsvTable, TheHeaderSaysTheSeparator) {
  EXPECT_EQ(form_of("t_s,pv\n").separator, ',');
  EXPECT_EQ(form_of("t_s;pv\n").separator, ';');
  EXPECT_EQ(form_of("\xEF\xBB\xBF\r\n\"t,s\";\"pv\"\r\n").separator, ';');
  EXPECT_EQ(form_of("t_s\tpv\n1,5\t2,5\n").separator, '\t');
  EXPECT_EQ(form_of("").separator, ',');
}

/// However many of the others stand in it.
TEST(CsvTable, AHeaderThatCommasMakeGoodIsSeparatedByCommas) {
  EXPECT_EQ(form_of("t_s,pv,a;b;c;d;e\n").separator, ',');
  EXPECT_EQ(form_of("a;pv,pv\n").separator, ',');
  EXPECT_EQ(form_of("a\tb,pv\n").separator, ',');
}

TEST(CsvTable, WhereNoHeaderIsGoodTheMostCellsAreShown) {
  EXPECT_EQ(form_of("Name;SP;PV, max\n").separator, ';');
  EXPECT_EQ(form_of("a,b\n").separator, ',');
  EXPECT_EQ(form_of("a\n").separator, ',');
}

TEST(CsvTable, AFirstLineOfASpreadsheetSaysTheSeparator) {
  const std::string_view text = "\xEF\xBB\xBFsep=;\r\na;b,c\r\n1;2,5\r\n";
  const CsvTable table = parse_csv(text, "f.csv", form_of(text));
  EXPECT_THAT(table.header, ElementsAre("a", "b,c"));
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_THAT(table.rows[0].cells, ElementsAre("1", "2,5"));
  EXPECT_EQ(table.rows[0].line, 3U);
  EXPECT_FALSE(form_of("sep=|\npv\n").first_line_says);
}

TEST(CsvTable, TheHintOfAnOddRowNamesTheSeparator) {
  const auto hint = [](CsvForm form) {
    return data_failure([&] { return parse_csv("a\n1;2,3\t4\n", "f.csv", form); }).hint();
  };
  EXPECT_EQ(hint({','}),
            "separate cells by commas and leave missing ones empty; decimal point, not comma");
  EXPECT_EQ(hint({';'}), "separate cells by semicolons and leave missing ones empty");
  EXPECT_EQ(hint({'\t'}), "separate cells by tabs and leave missing ones empty");
}

TEST(CsvTable, FilesThatCannotBeRead) {
  const tests::TemporaryFolder folder;
  EXPECT_THROW(static_cast<void>(read_csv(folder.path() / "absent.csv")), Failure);
  EXPECT_THROW(static_cast<void>(read_csv(folder.path())), Failure);
  std::ofstream(folder.path() / "empty.csv").flush();
  try {
    static_cast<void>(read_csv(folder.path() / "empty.csv"));
    ADD_FAILURE() << "an empty file was accepted";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("is empty"));
  }
}

}  // namespace
}  // namespace loopscope::daemon
