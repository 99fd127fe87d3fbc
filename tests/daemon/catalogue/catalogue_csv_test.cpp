#include "daemon/catalogue/catalogue_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/data_failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;
using testing::HasSubstr;

std::vector<CatalogueEntry> load(std::string_view text) {
  return parse_catalogue(parse_csv(text, "loops.csv"), {}, {});
}

std::string catalogue_failure(std::string_view text) {
  return data_failure([&] { return load(text); }).what();
}

TEST(CatalogueCsv, WrittenLoopsReadBack) {
  CatalogueEntry entry;
  entry.name = "FIC \"101\", east";
  entry.pv_tag = "P,V";
  entry.op_tag = "o'p;--";
  entry.interval_s = 0.5;
  entry.op_range = core::signal::OpRange{4.0, 20.0};
  entry.importance = 2.5;
  entry.enabled = false;
  const auto loaded = load(catalogue_csv(std::vector{entry}));
  ASSERT_EQ(loaded.size(), 1U);
  EXPECT_EQ(loaded[0].name, entry.name);
  EXPECT_EQ(loaded[0].op_tag, entry.op_tag);
  EXPECT_EQ(loaded[0].interval_s, entry.interval_s);
  EXPECT_EQ(loaded[0].op_range->low, 4.0);
  EXPECT_FALSE(loaded[0].enabled);
  EXPECT_EQ(catalogue_csv(loaded), catalogue_csv(std::vector{entry}));
}

TEST(CatalogueCsv, NameAndProcessVariableAreEnough) {
  const auto loaded = load("pv_tag,name\nA.PV,A\nB.PV,B\n");
  ASSERT_EQ(loaded.size(), 2U);
  EXPECT_EQ(loaded[1].name, "B");
  EXPECT_EQ(loaded[1].period_s, CatalogueEntry{}.period_s);
  EXPECT_TRUE(loaded[1].enabled);
}

TEST(CatalogueCsv, SemicolonsAndTheNamesOfRoles) {
  constexpr std::string_view kText = "Name;PV_Tag\r\nA;A.PV\r\n";
  const CsvForm form = find_csv_form(kText, "loops.csv", is_header_of_catalogue);
  EXPECT_EQ(parse_catalogue(parse_csv(kText, "loops.csv", form), {}, {})[0].pv_tag, "A.PV");
  const Failure failure = data_failure([] {
    return parse_catalogue(parse_csv("Name;SP\nA;A.SP\n", "loops.csv", {.separator = ';'}), {}, {});
  });
  EXPECT_STREQ(failure.what(),
               "loops.csv, line 1: unknown column \"SP\" (cells separated by semicolons)");
  EXPECT_EQ(failure.hint(),
            "did you mean \"sp_tag\"? `loopscope loops export -` shows the columns");
}

TEST(CatalogueCsv, AKnownLoopKeepsWhatTheTableDoesNotSay) {
  CatalogueEntry known;
  known.name = "A";
  known.pv_tag = "A.PV";
  known.sp_tag = "A.SP";
  known.op_tag = "A.OP";
  known.interval_s = 5.0;
  known.enabled = false;
  const CsvTable table = parse_csv("name,importance,op_tag,enabled\nA,7,,\n", "loops.csv");
  const auto loaded = parse_catalogue(table, {}, std::vector{known});
  ASSERT_EQ(loaded.size(), 1U);
  EXPECT_EQ(loaded[0].importance, 7.0);
  EXPECT_EQ(loaded[0].sp_tag, "A.SP");
  EXPECT_EQ(loaded[0].interval_s, 5.0);
  EXPECT_EQ(loaded[0].op_tag, "") << "an empty cell says: not recorded";
  EXPECT_FALSE(loaded[0].enabled) << "an empty cell cannot say that";
}

TEST(CatalogueCsv, ProblemsNameLineAndColumn) {
  for (const auto& [csv, problem] :
       {std::pair{"name,pv_tag,colour\n",
                  "line 1: unknown column \"colour\" (cells separated by commas)"},
        std::pair{"name,pv_tag,name\nA,B,C\n", "line 1: column \"name\" stands twice"},
        std::pair{"name,pv_tag,period_s\nA,B,-5\n",
                  "line 2, column period_s: -5 is out of range, 1 to 2592000 s"},
        std::pair{"name,pv_tag,period_s\nA,B,often\n",
                  "line 2, column period_s: \"often\" is not a number"},
        std::pair{"name,pv_tag,enabled\nA,B,perhaps\n",
                  "line 2, column enabled: \"perhaps\" is neither true nor false"},
        std::pair{"name,pv_tag\nA,\n", "line 2: the pv tag is empty"},
        std::pair{"name,pv_tag\n,B\n", "line 2: the name is empty"},
        std::pair{"name,pv_tag\nA,B\nA,C\n", "line 3: \"A\" stands twice"},
        std::pair{"name,pv_tag,op_low\nA,B,0\n",
                  "line 2: op_low and op_high need both ends, low below high"},
        std::pair{"name,pv_tag,pv_low,pv_high\nA,B,5,5\n",
                  "line 2: pv_low and pv_high need both ends, low below high"}})
    EXPECT_EQ(catalogue_failure(csv), std::string("loops.csv, ") + problem);
  EXPECT_EQ(catalogue_failure("name,pv_tag\n" + std::string(1001, 'x') + ",B\n"),
            "loops.csv, line 2: the name has 1001 bytes, 1000 are the most");
  EXPECT_THAT(catalogue_failure("name,pv_tag,period_s\nA,B,1e300\n"), HasSubstr("out of range"));
  EXPECT_THAT(catalogue_failure("name,pv_tag,interval_s\nA,B,1e-9\n"), HasSubstr("out of range"));
}

}  // namespace
}  // namespace loopscope::daemon
