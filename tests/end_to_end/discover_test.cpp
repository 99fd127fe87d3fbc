#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// A historian without any loop in the catalogue.
class Discover : public testing::Test {
 protected:
  Discover() {
    plant.import_loop("seed", 600);
    plant.sql("truncate history; delete from loopscope.loop");
  }
  void add_tags(const std::string& names) const {
    plant.sql("insert into history select tag, now() - interval '1 hour', 1, 192 from unnest('{" +
              names + "}'::text[]) as tag");
  }
  [[nodiscard]] ProgramResult loops(const std::vector<std::string>& rest) const {
    return plant.loopscope("loops", rest);
  }
  Plant plant;
};

TEST_F(Discover, FromTagsToACsvToTheCatalogue) {
  add_tags("FIC101.SP,FIC101.PV,FIC101.OP,area1/TIC7/pv,LIC3.SP,TI200");
  const std::string file = plant.folder() / "found.csv";
  const ProgramResult found = loops({"discover", "--out", file});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("6 tags, 2 loops are new"));
  EXPECT_THAT(found.out, HasSubstr("1 without pv, left out: LIC3 (LIC3.SP)"));
  EXPECT_THAT(found.out, HasSubstr("1 tag fits no pattern: TI200"));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.loop"), "0") << "a look first";
  EXPECT_THAT(content_of(file), HasSubstr("FIC101,plant,FIC101.SP,FIC101.PV,FIC101.OP,"));

  EXPECT_THAT(loops({"load", file}).out, HasSubstr("2 loops added, 0 changed"));
  EXPECT_EQ(plant.sql("select name, coalesce(sp_tag, '-'), pv_tag, period_s from loopscope.loop "
                      "order by name"),
            "FIC101|FIC101.SP|FIC101.PV|3600\narea1/TIC7|-|area1/TIC7/pv|3600");
  EXPECT_THAT(loops({"discover", "--add"}).out, HasSubstr("0 loops added"));
  add_tags("PIC9.PV");
  EXPECT_THAT(loops({"discover", "--add"}).out, HasSubstr("1 loop added"));
}

TEST_F(Discover, CsvOnStandardOutputIsNothingButCsv) {
  add_tags("FIC101.PV");
  const ProgramResult found = loops({"discover", "--out", "-"});
  EXPECT_EQ(found.exit_code, 0);
  EXPECT_TRUE(found.out.starts_with("name,source,sp_tag,")) << found.out;
  EXPECT_THAT(found.err, HasSubstr("1 loop is new"));
}

TEST_F(Discover, ALoopsNameThatIsTakenIsLeftAlone) {
  add_tags("FIC101.PV,TIC1.PV");
  ASSERT_EQ(loops({"add", "FIC101", "--pv-tag", "mine"}).exit_code, 0);
  EXPECT_THAT(loops({"discover", "--add"}).out,
              HasSubstr("1 name taken by another loop of the catalogue, left out: FIC101"));
  EXPECT_EQ(plant.sql("select pv_tag from loopscope.loop order by name"), "mine\nTIC1.PV");
}

TEST_F(Discover, PatternsComeFromTheCommandLineOrTheSettings) {
  add_tags("Ist@R7,Soll@R7");
  const ProgramResult nothing = loops({"discover"});
  EXPECT_EQ(nothing.exit_code, 5);
  EXPECT_THAT(nothing.err, HasSubstr("no loop was found among 2 tags"));
  EXPECT_THAT(nothing.err, HasSubstr("HINT: "));
  const ProgramResult told =
      loops({"discover", "--pattern", "{role}@{loop}", "--role", "pv=Ist", "--role", "sp=Soll"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("1 loop is new (sp 1, pv 1"));
  plant.write_settings(Plant::settings(
      R"("discovery": {"patterns": "{role}@{loop}", "pv_words": "Ist", "sp_words": "Soll"})"));
  EXPECT_THAT(loops({"discover"}).out, HasSubstr("1 loop is new (sp 1, pv 1"));
}

TEST_F(Discover, BadPatternsSayWhatIsWrong) {
  const ProgramResult bad = loops({"discover", "--pattern", "{loop}.{rolle}"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.err, HasSubstr("pattern \"{loop}.{rolle}\": only {loop} and {role}"));
  EXPECT_EQ(loops({"discover", "--role", "flow=F"}).exit_code, 2);
  EXPECT_EQ(loops({"discover", "--source", "elsewhere"}).exit_code, 3);
  plant.write_settings(Plant::settings(R"("discovery": {"patterns": "{loop}"})"));
  EXPECT_EQ(loops({"discover"}).exit_code, 3);
}

TEST_F(Discover, CheckListsWhatDoesNotResolve) {
  add_tags("FIC101.PV,FIC101.OP");
  ASSERT_EQ(loops({"add", "FIC101", "--pv-tag", "FIC101.PV", "--op-tag", "FIC101.OP"}).exit_code,
            0);
  EXPECT_THAT(loops({"check"}).out, HasSubstr("2 tags of 1 loop, all with rows"));
  ASSERT_EQ(loops({"set", "FIC101", "--sp-tag", "FIC101.SV"}).exit_code, 0);
  const std::string file = plant.folder() / "dead.csv";
  const ProgramResult check = loops({"check", "--out", file});
  EXPECT_EQ(check.exit_code, 5);
  EXPECT_THAT(check.err, HasSubstr("1 of 3 tags of 1 loop cannot be found"));
  EXPECT_THAT(check.err, HasSubstr("HINT: "));
  EXPECT_THAT(check.out, HasSubstr("FIC101.SV"));
  EXPECT_EQ(content_of(file),
            "loop,source,role,tag,problem\n"
            "FIC101,plant,sp,FIC101.SV,the historian has no row of this tag\n");
}

/// A table with a row a loop and time offers its mode column to every loop.
TEST_F(Discover, ATagWithoutAValueIsLeftOut) {
  plant.sql(
      "create table looprows (loop text, time timestamptz, sp float8, pv float8, op float8, "
      "mode int, primary key (loop, time)); insert into looprows select 'FIC101', now() - k * "
      "interval '1 s', 50, 50 + k % 7, 40 + k % 5, null from generate_series(1, 50) as k");
  std::string settings = Plant::settings();
  const std::string connection = R"("@CONNECTION@")";
  settings.insert(settings.find(connection) + connection.size(),
                  R"(, "preset": "loop_row", "table": "public.looprows")");
  plant.write_settings(settings);
  const ProgramResult found = loops({"discover", "--add"});
  EXPECT_THAT(found.out, HasSubstr("1 tag without a value, left out: FIC101.mode"));
  const ProgramResult check = loops({"check"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("3 tags of 1 loop, all with rows"));
}

TEST_F(Discover, TenThousandLoopsInSeconds) {
  plant.sql(
      "insert into history select 'FIC' || n || '.' || role, now() - k * interval '1 minute', "
      "1, 192 from generate_series(1, 10000) as n, unnest('{SP,PV,OP,MODE}'::text[]) as role,"
      " generate_series(1, 20) as k; analyze history");
  const auto seconds = [](auto action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double add = seconds([&] {
    EXPECT_THAT(loops({"discover", "--add"}).out, HasSubstr("10000 loops added"));
  });
  const double check = seconds([&] {
    EXPECT_THAT(loops({"check"}).out, HasSubstr("40000 tags of 10000 loops, all with rows"));
  });
  RecordProperty("discover_s", std::to_string(add));
  RecordProperty("check_s", std::to_string(check));
  EXPECT_LT(add, 60.0) << "a few seconds on an idle machine";
  EXPECT_LT(check, 60.0);
}

}  // namespace
}  // namespace loopscope::tests
