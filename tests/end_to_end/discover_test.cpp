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
  add_tags("FIC101.SP,FIC101.PV,FIC101.OP,area1/TIC7/pv,area1/TIC7/out,LIC3.SP,TI200,TI8.PV");
  const std::string file = plant.folder() / "found.csv";
  const ProgramResult found = loops({"discover", "--out", file});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("8 tags, 2 loops are new"));
  EXPECT_THAT(found.out, HasSubstr("1 without pv, left out: LIC3 (LIC3.SP)"));
  EXPECT_THAT(found.out, HasSubstr("1 pv without sp and op, no control loop, left out: TI8"));
  EXPECT_THAT(found.out, HasSubstr("1 tag is no loop's by its name: TI200"));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.loop"), "0") << "a look first";
  EXPECT_THAT(content_of(file), HasSubstr("FIC101,plant,FIC101.SP,FIC101.PV,FIC101.OP,"));

  EXPECT_THAT(loops({"load", file}).out, HasSubstr("2 loops added, 0 changed, 0 as before"));
  EXPECT_EQ(plant.sql("select name, coalesce(sp_tag, '-'), pv_tag, period_s, loop_type from "
                      "loopscope.loop order by name"),
            "FIC101|FIC101.SP|FIC101.PV|3600|flow\narea1/TIC7|-|area1/TIC7/pv|3600|temperature");
  EXPECT_THAT(loops({"load", file}).out, HasSubstr("0 loops added, 0 changed, 2 as before"));
  EXPECT_THAT(loops({"discover", "--add"}).out, HasSubstr("0 loops added"));
  add_tags("PIC9.PV,PIC9.SP");
  EXPECT_THAT(loops({"discover", "--add"}).out, HasSubstr("1 loop added"));
}

TEST_F(Discover, CsvOnStandardOutputIsNothingButCsv) {
  add_tags("FIC101.PV,FIC101.SP");
  const ProgramResult found = loops({"discover", "--out", "-"});
  EXPECT_EQ(found.exit_code, 0);
  EXPECT_TRUE(found.out.starts_with("name,source,sp_tag,")) << found.out;
  EXPECT_THAT(found.err, HasSubstr("1 loop is new"));
}

TEST_F(Discover, ALoopsNameThatIsTakenIsLeftAlone) {
  add_tags("FIC101.PV,FIC101.SP,TIC1.PV,TIC1.OP");
  ASSERT_EQ(loops({"add", "FIC101", "--pv-tag", "mine"}).exit_code, 0);
  EXPECT_THAT(loops({"discover", "--add"}).out,
              HasSubstr("1 name taken by another loop of the catalogue, left out: FIC101"));
  EXPECT_EQ(plant.sql("select pv_tag from loopscope.loop order by name"), "mine\nTIC1.PV");
}

TEST_F(Discover, PatternsComeFromTheCommandLineOrTheSettings) {
  add_tags("Rec@R7,Ref@R7");
  const ProgramResult nothing = loops({"discover"});
  EXPECT_EQ(nothing.exit_code, 5);
  EXPECT_THAT(nothing.err, HasSubstr("no loop was found among 2 tags"));
  EXPECT_THAT(nothing.err, HasSubstr("HINT: "));
  const ProgramResult told =
      loops({"discover", "--pattern", "{role}@{loop}", "--role", "pv=Rec", "--role", "sp=Ref"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("1 loop is new (sp 1, pv 1"));
  plant.write_settings(Plant::settings(
      R"("discovery": {"patterns": "{role}@{loop}", "pv_words": "Rec", "sp_words": "Ref"})"));
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
  const std::string csv = content_of(file);
  EXPECT_TRUE(
      csv.starts_with("loop,source,role,tag,newest_row,age_s,problem\n"
                      "FIC101,plant,sp,FIC101.SV,,,the historian has no row of this tag\n"
                      "FIC101,plant,pv,FIC101.PV,20"))
      << csv;
  EXPECT_THAT(csv, HasSubstr("Z,36"));  // an hour and what the test took
}

/// A tag that was renamed has rows, old ones.
TEST_F(Discover, CheckNamesWhatHasStopped) {
  plant.sql(
      "insert into history select tag, now() - (k + back) * interval '1 minute', k % 7, 192 from "
      "(values ('FIC1.PV', 0), ('FIC1.OP', 0), ('TIC2.PV', 4320), ('TIC2.OP', 0)) as one (tag, "
      "back), generate_series(1, 30) as k; insert into history values ('TIC2.SP', now() - "
      "interval '9 days', 50, 192)");
  ASSERT_EQ(loops({"add", "FIC1", "--pv-tag=FIC1.PV", "--op-tag=FIC1.OP"}).exit_code, 0);
  ASSERT_EQ(
      loops({"add", "TIC2", "--pv-tag=TIC2.PV", "--op-tag=TIC2.OP", "--sp-tag=TIC2.SP"}).exit_code,
      0);
  const ProgramResult check = loops({"check"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("newest row of historian plant: 6"));  // a minute
  EXPECT_THAT(check.out, HasSubstr("5 tags of 2 loops, all with rows; 1 has stopped"));
  EXPECT_THAT(check.out,
              testing::ContainsRegex("TIC2 +pv +TIC2.PV +3 d plant: stopped: no row for 3 d, "
                                     "never more than 60 s before"));
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

/// Names and patterns, all of it in one transaction.
TEST_F(Discover, ManyLoopsAtOnce) {
  plant.sql(
      "insert into loopscope.loop (name, source, pv_tag, period_s) select name, 'plant', name || "
      "'.PV', 3600 from unnest('{FIC-1,FIC-2,TIC-3,T*}'::text[]) as name");
  EXPECT_THAT(loops({"set", "--area", "north", "FIC-*", "TIC-3"}).out,
              HasSubstr("3 loops changed, 0 as before"));
  EXPECT_THAT(loops({"set", "--area", "north", "--all"}).out,
              HasSubstr("1 loop changed, 3 as before"));
  EXPECT_THAT(loops({"disable", "T*"}).out, HasSubstr("1 loop disabled, 0 as before"))
      << "a loop's name is no pattern";
  EXPECT_THAT(loops({"disable", "*-[13]", "T*"}).out, HasSubstr("2 loops disabled, 1 as before"));
  EXPECT_THAT(loops({"enable", "--all"}).out, HasSubstr("3 loops enabled, 1 as before"));
  const ProgramResult unknown = loops({"set", "--area", "south", "FIC-1", "FIC-3"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no loop named \"FIC-3\""));
  EXPECT_THAT(unknown.err, HasSubstr("did you mean"));
  EXPECT_THAT(loops({"disable", "X*"}).err, HasSubstr("no loop fits \"X*\""));
  EXPECT_THAT(loops({"set", "--pv-tag", "x", "FIC-*"}).err,
              HasSubstr("--pv-tag for 2 loops: each has a tag of its own"));
  EXPECT_THAT(loops({"set", "--area", "south"}).err, HasSubstr("no loop is named"));
  EXPECT_EQ(loops({"set", "FIC-1"}).exit_code, 2);
  EXPECT_EQ(loops({"set", "--period-s", "0", "--all"}).exit_code, 2);
  EXPECT_EQ(plant.sql("select distinct area, period_s, enabled from loopscope.loop"),
            "north|3600|t");
}

TEST_F(Discover, DeletedLoopsAreGone) {
  plant.import_loop("FIC1", 600);
  plant.import_loop("FIC2", 600);
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
  ASSERT_EQ(loops({"add", "NEW", "--pv-tag", "x"}).exit_code, 0);
  const ProgramResult refused = loops({"delete", "FIC*", "NEW"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("nothing was deleted: 2 of 3 loops have results (2 analyses, "
                                     "0 annotations, 0 pieces of maintenance work)"));
  EXPECT_THAT(refused.err, HasSubstr("HINT: --with-results deletes them too"));
  EXPECT_THAT(loops({"delete", "NEW"}).out,
              HasSubstr("deleted NEW\n1 loop deleted, with 0 analyses"));
  plant.sql("update loopscope.schedule set owner = 'w', visible_at = now() + interval '1 hour'");
  EXPECT_THAT(loops({"delete", "--with-results", "FIC1"}).err,
              HasSubstr("nothing was deleted: being analysed at this moment: FIC1"));
  plant.sql("update loopscope.schedule set owner = null");
  EXPECT_THAT(loops({"delete", "--with-results", "FIC1"}).out,
              HasSubstr("1 loop deleted, with 1 analysis, 0 annotations"));
  EXPECT_EQ(plant.sql("select name from loopscope.loop"), "FIC2");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.latest_verdict"), "1");
  EXPECT_EQ(loops({"delete", "FIC1"}).exit_code, 2);
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
