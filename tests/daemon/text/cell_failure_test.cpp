#include "daemon/text/cell_failure.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using namespace std::string_view_literals;

TEST(Shown, PrintableTextStaysAsItIs) {
  EXPECT_EQ(shown(""), "\"\"");
  EXPECT_EQ(shown("1.5.2"), "\"1.5.2\"");
  EXPECT_EQ(shown("20 \u00b0C \u2013 \U0001F600"), "\"20 \u00b0C \u2013 \U0001F600\"");
}

TEST(Shown, UnprintableBytesAreEscaped) {
  EXPECT_EQ(shown("1\0002"sv), "\"1\\x002\"");
  EXPECT_EQ(shown("a\tb\nc\x1b[2J\x7f"), "\"a\\x09b\\x0ac\\x1b[2J\\x7f\"");
}

TEST(Shown, BytesThatAreNoCharacterAreEscaped) {
  EXPECT_EQ(shown("20 \xb0"
                  "C"),
            "\"20 \\xb0C\"");
  EXPECT_EQ(shown("cut \xe2\x80"), "\"cut \\xe2\\x80\"");
  EXPECT_EQ(shown("\xff\xc0\x80"), "\"\\xff\\xc0\\x80\"");
  EXPECT_EQ(shown("\xc2\x9b"
                  "2J"),
            "\"\\xc2\\x9b2J\"");
}

TEST(Shown, LongCellsAreShortened) {
  EXPECT_EQ(shown(std::string(60, 'x')), '"' + std::string(60, 'x') + '"');
  EXPECT_EQ(shown(std::string(100'000, 'x')), '"' + std::string(60, 'x') + "...\"");
}

TEST(CellFailure, NamesFileLineAndColumn) {
  const CsvTable table = parse_csv("t_s, PV \n\n0,x\n", "f.csv");
  const Failure failure = cell_failure(table, table.rows[0], 1, "is odd", "mend it");
  EXPECT_STREQ(failure.what(), "f.csv, line 3, column \"PV\": is odd");
  EXPECT_EQ(failure.hint(), "mend it");
  EXPECT_EQ(failure.exit_code(), ExitCode::unusable_data);
}

}  // namespace
}  // namespace loopscope::daemon
