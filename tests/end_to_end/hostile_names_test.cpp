#include "tests/support/hostile_names.hpp"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

constexpr const char* kQuick = R"("analysis": {"fit_model": false}, "daemon": {"workers": 2})";

/// Every hostile name with this after it.
std::set<std::string> hex_of_names(const std::string& suffix = "") {
  std::set<std::string> names;
  for (const HostileName& hostile : hostile_names()) names.insert(hex(hostile.name + suffix));
  return names;
}

/// A plant whose loops and tags have every hostile name.
class HostilePlant : public testing::Test {
 protected:
  void SetUp() override { plant_.write_settings(Plant::settings(kQuick)); }

  /// Each by a run of `import`.
  void import_all() {
    const std::string recording = plant_.folder() / "recording.csv";
    std::ofstream(recording) << noisy_loop_csv(600, 1);
    for (const HostileName& hostile : hostile_names()) {
      const ProgramResult imported =
          plant_.loopscope("import", {"--create-table", "--loop=" + hostile.name, recording});
      ASSERT_EQ(imported.exit_code, 0) << hostile.about << ": " << imported.err;
      expect_harmless(imported);
      EXPECT_EQ(std::ranges::count(imported.out, '\n'), 1) << imported.out;
    }
  }

  /// All of them by SQL: quicker than by import.
  void fill() {
    plant_.import_loop("seed", 600);
    std::string values;
    for (const HostileName& hostile : hostile_names())
      values += (values.empty() ? "(" : ", (") + sql_text(hostile.name) + ")";
    plant_.sql(
        "with names (name) as (values " + values +
        "), rows as (insert into history select name || substr(tag, 5), time, value,"
        " quality from history, names) insert into loopscope.loop (name, source, sp_tag, pv_tag,"
        " op_tag, period_s) select name, 'plant', name || '.SP', name || '.PV', name || '.OP', 3600"
        " from names");
    plant_.sql("delete from loopscope.loop where name = 'seed'");
    plant_.sql("delete from history where tag like 'seed%'");
  }

  void expect_harmless(const ProgramResult& result) const {
    EXPECT_TRUE(is_harmless_on_a_terminal(result.out)) << result.out;
    EXPECT_TRUE(is_harmless_on_a_terminal(result.err)) << result.err;
  }

  /// First column of a query's rows, as hexadecimal digits of their UTF-8.
  [[nodiscard]] std::set<std::string> column(const std::string& name,
                                             const std::string& from) const {
    std::istringstream rows(
        plant_.sql("select distinct encode(convert_to(" + name + ", 'UTF8'), 'hex') from " + from));
    std::set<std::string> found;
    for (std::string row; std::getline(rows, row);) found.insert(row);
    return found;
  }

  Plant plant_;
};

TEST_F(HostilePlant, NamesArriveInEveryTableAndViewAsTheyWere) {
  import_all();
  const ProgramResult pass = plant_.loopscope("once");
  EXPECT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_THAT(pass.out, HasSubstr(std::to_string(hostile_names().size()) + " new"));
  expect_harmless(pass);
  const std::set<std::string> names = hex_of_names();
  EXPECT_EQ(column("name", "loopscope.loop"), names);
  for (const char* view : {"latest_verdict", "loop_history", "data_quality", "monitor_health"})
    EXPECT_EQ(column("loop_name", std::string("loopscope.") + view), names) << view;
  EXPECT_EQ(column("pv_tag", "loopscope.loop"), hex_of_names(".PV"));
  EXPECT_EQ(column("tag", "history where tag like '%.PV'"), hex_of_names(".PV"));
  EXPECT_EQ(plant_.sql("select count(*) from loopscope.analysis where not usable"), "0");
  EXPECT_FALSE(std::filesystem::exists("/tmp/loopscope_hostile"));
  EXPECT_FALSE(std::filesystem::exists("loopscope_hostile"));
}

TEST_F(HostilePlant, ExportedAndLoadedAgainTheCatalogueIsTheSameBytes) {
  fill();
  const std::string first = plant_.folder() / "first.csv", second = plant_.folder() / "second.csv";
  const ProgramResult exported = plant_.loopscope("loops", {"export", first});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_THAT(exported.err, HasSubstr("a spreadsheet takes this for a formula"));
  plant_.sql("delete from loopscope.loop");
  const ProgramResult loaded = plant_.loopscope("loops", {"load", first});
  ASSERT_EQ(loaded.exit_code, 0) << loaded.err;
  EXPECT_THAT(loaded.out, HasSubstr(std::to_string(hostile_names().size()) + " loops added"));
  ASSERT_EQ(plant_.loopscope("loops", {"export", second}).exit_code, 0);
  EXPECT_EQ(content_of(first), content_of(second));
  EXPECT_EQ(plant_.loopscope("loops", {"export", "-"}).out, content_of(first));
  EXPECT_EQ(column("name", "loopscope.loop"), hex_of_names());
  EXPECT_EQ(column("mv_tag", "loopscope.loop where mv_tag is not null"), std::set<std::string>());
}

TEST_F(HostilePlant, TablesForPeopleKeepOneLineALoop) {
  fill();
  const ProgramResult list = plant_.loopscope("loops");
  EXPECT_EQ(std::ranges::count(list.out, '\n'),
            static_cast<std::ptrdiff_t>(hostile_names().size()) + 1);
  expect_harmless(list);
  const ProgramResult check = plant_.loopscope("loops", {"check"});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  expect_harmless(check);
  plant_.sql("delete from history");
  const ProgramResult dead = plant_.loopscope("loops", {"check"});
  EXPECT_EQ(dead.exit_code, 5);
  // A heading, fifty dead ends and a line for the others; what names propose, and how it is
  // written.
  EXPECT_EQ(std::ranges::count(dead.out, '\n'), 54) << dead.out;
  expect_harmless(dead);
}

TEST_F(HostilePlant, DiscoveryFindsTheirTags) {
  fill();
  plant_.sql("delete from loopscope.loop");
  const std::string file = plant_.folder() / "found.csv";
  const ProgramResult found = plant_.loopscope("loops", {"discover", "--out", file});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  expect_harmless(found);
  EXPECT_EQ(plant_.loopscope("loops", {"load", file}).exit_code, 0);
  EXPECT_EQ(column("pv_tag", "loopscope.loop"), hex_of_names(".PV"));
}

TEST_F(HostilePlant, ATagThatStopsIsNamedOnceInTheLogAndTheViews) {
  fill();
  plant_.sql("drop table history");
  const ProgramResult pass = plant_.loopscope("once");
  EXPECT_EQ(pass.exit_code, 4);
  expect_harmless(pass);
  for (const HostileName& hostile : {hostile_names()[0], hostile_names()[38]}) {
    const ProgramResult one = plant_.loopscope("loops", {"disable", hostile.name});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    const ProgramResult window = plant_.loopscope("window", {"--loop=" + hostile.name});
    EXPECT_EQ(window.exit_code, 4);
    expect_harmless(window);
  }
  expect_harmless(plant_.loopscope("loops", {"disable", "no\nsuch\x1b[2J loop"}));
}

TEST(ImpossibleNames, AreRefusedInWordsAndNothingIsStored) {
  const Plant plant;
  for (const HostileName& bad : impossible_names()) {
    const std::string file = plant.folder() / "loops.csv";
    std::ofstream(file) << "name,pv_tag\n\"" << bad.name << "\",x\n";
    const ProgramResult loaded = plant.loopscope("loops", {"load", file});
    EXPECT_THAT(loaded.exit_code, testing::AnyOf(4, 5)) << bad.about;
    EXPECT_THAT(loaded.err, HasSubstr("UTF-8")) << bad.about;
    EXPECT_TRUE(is_harmless_on_a_terminal(loaded.err)) << loaded.err;
  }
  const ProgramResult longest =
      plant.loopscope("loops", {"add", std::string(1000, 'n'), "--pv-tag=x"});
  EXPECT_EQ(longest.exit_code, 0) << longest.err;
  const ProgramResult longer =
      plant.loopscope("loops", {"add", std::string(1001, 'n'), "--pv-tag=x"});
  EXPECT_EQ(longer.exit_code, 2);
  EXPECT_THAT(longer.err, HasSubstr("1000 are the most"));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.loop"), "1");
}

}  // namespace
}  // namespace loopscope::tests
