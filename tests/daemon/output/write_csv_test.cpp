#include "daemon/output/write_csv.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>
#include <string>

#include "daemon/text/csv_table.hpp"
#include "tests/support/hostile_names.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(WriteCsv, FormulasAreCountedAndNumbersAreNot) {
  EXPECT_EQ(count_formulas("name,op_low\n=A1,-10\n+1+1,+5.5\n-2+3,-1e3\n@SUM(1),\n"), 4U);
  EXPECT_EQ(count_formulas("name\n\"=A1,\"\nx=1\n\"\tx\"\nFIC101.PV\n-\n"), 3U);
  EXPECT_EQ(count_formulas("name\n"), 0U);
}

TEST(WriteCsv, NamesStayByteForByteAndTheNoteGoesToStandardError) {
  const tests::TemporaryFolder folder;
  std::string csv = "name\n";
  for (const tests::HostileName& hostile : tests::hostile_names())
    csv += csv_cell(hostile.name) + '\n';
  testing::internal::CaptureStderr();
  write_csv(folder.path() / "names.csv", csv);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::MatchesRegex("note: [0-9]+ cells begin with =, .+, - or @: a spreadsheet "
                                    "takes this for a formula unless it is told to import every "
                                    "column as text\n"));
  EXPECT_EQ(content_of(folder.path() / "names.csv"), csv);
  testing::internal::CaptureStderr();
  write_csv(folder.path() / "names.csv", "name\nFIC101\n");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace loopscope::daemon
