#include <algorithm>
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class Analyze : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return (folder.path() / name).string();
  }

  static ProgramResult analyze(const std::string& file) {
    return run_program({LOOPSCOPE_PROGRAM, "analyze", file, "--json"});
  }

  void expect_refused(const std::string& name, const std::string& text,
                      const std::string& part) const {
    const ProgramResult result = analyze(write(name, text));
    EXPECT_EQ(result.exit_code, 5) << name;
    EXPECT_EQ(result.out, "") << name;
    EXPECT_THAT(result.err, HasSubstr("error: ")) << name;
    EXPECT_THAT(result.err, HasSubstr(part)) << name;
    EXPECT_THAT(result.err, HasSubstr("HINT: ")) << name;
  }

  Json expect_verdict(const std::string& name, const std::string& text,
                      const std::string& code) const {
    const ProgramResult result = analyze(write(name, text));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    Json json = Json::parse(result.out);
    EXPECT_EQ(json["verdict"]["code"], code) << result.out;
    return json;
  }

  TemporaryFolder folder;
};

/// A healthy loop; a constant output replaces the recorded one when it is given.
std::string rows(std::size_t count, const std::string& op = "") {
  std::istringstream recorded(noisy_loop_csv(count, 1));
  std::string text;
  std::string line;
  std::getline(recorded, line);
  text = line + "\n";
  while (std::getline(recorded, line)) {
    text += op.empty() ? line : line.substr(0, line.rfind(',') + 1) + op;
    text += "\n";
  }
  return text;
}

TEST_F(Analyze, FilesThatCannotBeParsedAreErrorsWithoutOutput) {
  const ProgramResult missing = analyze((folder.path() / "absent.csv").string());
  EXPECT_EQ(missing.exit_code, 5);
  EXPECT_THAT(missing.err, HasSubstr("cannot be read"));
  expect_refused("empty.csv", "", "is empty");
  expect_refused("header.csv", "a,b,c\n1,2,3\n", "header");
  expect_refused("text.csv", "t_s,sp,pv,op\n0,1,2,3\n1,1,abc,3\n", "line 3, column \"pv\"");
  expect_refused("backwards.csv", "t_s,sp,pv,op\n5,1,2,3\n4,1,2,3\n", "runs backwards");
  expect_refused("extreme.csv", "t_s,sp,pv,op\n-9e12,1,2,3\n0,1,2,3\n9e12,1,2,3\n", "line 3");
  expect_refused("twice.csv", "t_s,sp,pv,op,pv\n0,1,2,3,4\n", "\"pv\" stands twice");
  expect_refused("nul.csv", std::string("t_s,sp,pv,op\n0,1,2\0x,3\n", 23), "is not text");
  expect_refused("ragged.csv", "t_s,sp,pv,op\n5,1,2\n", "line 2: 3 cells");
}

TEST_F(Analyze, DataThatCannotBeJudgedAreAVerdict) {
  expect_verdict("ten.csv", rows(10), "insufficient_data");
  expect_verdict("only_header.csv", "t_s,sp,pv,op\n", "insufficient_data");
  std::string constant = "t_s,sp,pv,op\n";
  for (int k = 0; k < 1000; ++k) constant += std::to_string(k) + ",5,5,50\n";
  expect_verdict("constant.csv", constant, "not_controlling");
}

TEST_F(Analyze, OddValuesAreMissingNotErrors) {
  std::string text = rows(1000);
  text += "10000,50,NaN,50\n10010,50,inf,50\n10020,50,,50\n10030,50,50,50\n10030,50,50.1,50\n";
  const Json json = expect_verdict("odd.csv", text, "healthy");
  EXPECT_NEAR(json["data_quality"]["missing_fraction"].get<double>(), 3.0 / 1004.0, 1e-9);
  EXPECT_THAT(json["data_quality"]["flags"].dump(), HasSubstr("repeated_times"));
  EXPECT_EQ(json["data_quality"]["repeated_times"], 1);
}

TEST_F(Analyze, AFileNameThatIsNoUtf8) {
  const Json json = expect_verdict("bad\xff.csv", rows(1000), "healthy");
  EXPECT_THAT(json["input"]["file"].get<std::string>(), HasSubstr("bad\xEF\xBF\xBD.csv"));
}

/// The figures of a European export are those of the same recording as contract.md has it.
TEST_F(Analyze, AFileOfSemicolonsAndDecimalCommas) {
  std::string text = rows(1000);
  const std::string usual = analyze(write("usual.csv", text)).out;
  std::ranges::replace(text, ',', ';');
  std::ranges::replace(text, '.', ',');
  text.replace(0, text.find('\n'), "Sekunden;W;PV_Actual;Y");
  const std::string file = write("european.csv", "\xEF\xBB\xBF" + text);
  EXPECT_THAT(analyze(file).err,
              HasSubstr("\"W\", \"PV_Actual\", \"Y\" (separated by semicolons)"));
  const ProgramResult result =
      run_program({LOOPSCOPE_PROGRAM, "analyze", file, "--json", "--columns",
                   "sp=W,pv=PV_Actual,op=Y", "--decimal-sign", "comma"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("the decimal sign is the comma"));
  Json european = Json::parse(result.out);
  Json expected = Json::parse(usual);
  expected["input"].erase("file");
  european["input"].erase("file");
  EXPECT_EQ(european, expected);
}

TEST_F(Analyze, SimulateRefusesNumbersThatItCannotUse) {
  const auto simulate = [](const std::string& option, const std::string& value) {
    return run_program({LOOPSCOPE_PROGRAM, "simulate", "paper_5_1", option, value});
  };
  for (const auto& [option, value] : {std::pair{"--seed", "-1"},
                                      {"--seed", "18446744073709551616"},
                                      {"--interval-s", "nan"},
                                      {"--interval-s", "1e308"},
                                      {"--interval-s", "-5"},
                                      {"--effect", "valve_stiction:S=1,S=2"}}) {
    const ProgramResult result = simulate(option, value);
    EXPECT_EQ(result.exit_code, 2) << option << ' ' << value;
    EXPECT_EQ(result.out, "") << option << ' ' << value;
    EXPECT_THAT(result.err, HasSubstr("HINT: give")) << option << ' ' << value;
  }
  EXPECT_EQ(simulate("--seed", "18446744073709551615").exit_code, 0);
}

TEST_F(Analyze, AConstantOutputStillHasItsStatistics) {
  const Json json = expect_verdict("op.csv", rows(1000, "42"), "not_controlling");
  EXPECT_THAT(json["data_quality"]["flags"].dump(), HasSubstr("op_constant"));
  EXPECT_TRUE(json["hos"]["ngi"].is_number());
}

TEST_F(Analyze, TextForPeople) {
  const ProgramResult result =
      run_program({LOOPSCOPE_PROGRAM, "analyze", write("text_out.csv", rows(1000))});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("healthy (confidence"));
  EXPECT_THAT(result.out, HasSubstr("What to do: Nothing to do."));
}

// Rows of the hour that the clock repeats go on; the JSON is for programs, in UTC.
TEST_F(Analyze, TimesOfThePlantsClock) {
  std::string text = "time,sp,pv,op\n";
  for (int minute = 0; minute < 600; ++minute) {
    const int hour = minute / 60;  // 00, 01, 02, 02, 03, ...
    text += "2026-10-25 0" + std::to_string(hour < 3 ? hour : hour - 1) + ":" +
            std::to_string(minute % 60) + ",50," + std::to_string(minute * 7919 % 101) + ",42\n";
  }
  const std::string file = write("local.csv", text);
  const std::vector<std::string> command{LOOPSCOPE_PROGRAM, "analyze", file, "--no-model",
                                         "--time-zone"};
  const auto in_zone = [&](const char* zone, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = command;
    arguments.emplace_back(zone);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  };
  EXPECT_THAT(in_zone("Europe/Berlin").out,
              HasSubstr("600 samples every 60 s, 2026-10-25 00:00 CEST to 2026-10-25 08:59 CET\n"));
  const Json json = Json::parse(in_zone("Europe/Berlin", {"--json"}).out);
  EXPECT_EQ(json["input"]["start"], "2026-10-24T22:00:00Z");
  EXPECT_EQ(json["input"]["end"], "2026-10-25T07:59:00Z");
  EXPECT_THAT(in_zone("UTC").err, HasSubstr("or name their zone (/plant/time_zone, or"));
  const ProgramResult misspelt = in_zone("berlin");
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("HINT: did you mean \"Europe/Berlin\"?"));
}

TEST_F(Analyze, AFileLongerThanAWindowIsJudgedBySeveral) {
  const std::string file = write("long.csv", rows(9000));
  const Json all = Json::parse(analyze(file).out);
  EXPECT_EQ(all["windows"]["judged"], 3);
  // Steps of 0.6 lengths, remembered for 1.25: 0.6 + 0.62 * (0.6 + 0.62).
  EXPECT_NEAR(all["windows"]["together"].get<double>(), 1.35, 0.02);
  EXPECT_EQ(all["input"]["samples"], 4096) << "every other key is the newest window's";
  EXPECT_THAT(all["verdict"]["reasons"].dump(), HasSubstr("Judged by several windows together"));
  const Json one = Json::parse(
      run_program({LOOPSCOPE_PROGRAM, "analyze", file, "--json", "--window", "4096"}).out);
  EXPECT_TRUE(one["windows"].is_null());
  EXPECT_EQ(one["verdict"], all["windows"]["newest_alone"]);
  EXPECT_EQ(one["model"], all["model"]);
}

TEST_F(Analyze, WrongUsage) {
  EXPECT_EQ(run_program({LOOPSCOPE_PROGRAM}).exit_code, 2);
  EXPECT_EQ(run_program({LOOPSCOPE_PROGRAM, "nonsense"}).exit_code, 2);
  EXPECT_EQ(run_program({LOOPSCOPE_PROGRAM, "analyze"}).exit_code, 2);
  const ProgramResult misspelt = run_program({LOOPSCOPE_PROGRAM, "oncee"});
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_EQ(misspelt.err,
            "error: unknown command \"oncee\"\nHINT: did you mean \"once\"? loopscope --help lists "
            "them\n");
  const ProgramResult option = run_program({LOOPSCOPE_PROGRAM, "once", "--confg", "f"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, HasSubstr("has no option \"--confg\"\nHINT: did you mean \"--config\"?"));
  const ProgramResult action = run_program({LOOPSCOPE_PROGRAM, "loops", "lst"});
  EXPECT_EQ(action.exit_code, 2);
  EXPECT_THAT(action.err, HasSubstr("has no action \"lst\"\nHINT: did you mean \"list\"?"));
  EXPECT_EQ(run_program({LOOPSCOPE_PROGRAM, "analyze", "--op-range", "7", "f.csv"}).exit_code, 5);
  EXPECT_EQ(
      run_program({LOOPSCOPE_PROGRAM, "analyze", "--pv-range", "9,1", write("p.csv", rows(10))})
          .exit_code,
      2);
  const ProgramResult range =
      run_program({LOOPSCOPE_PROGRAM, "analyze", "--op-range", "20,4", write("r.csv", rows(10))});
  EXPECT_EQ(range.exit_code, 2);
  EXPECT_THAT(range.err, HasSubstr("HINT: "));
}

TEST_F(Analyze, EveryCommandHasHelp) {
  for (const char* command :
       {"run", "once", "analyze", "reproduce", "calibrate", "simulate", "import", "loops",
        "annotate", "export", "migrate", "maintain", "check-config"}) {
    const ProgramResult result = run_program({LOOPSCOPE_PROGRAM, command, "--help"});
    EXPECT_EQ(result.exit_code, 0) << command;
    EXPECT_THAT(result.out, HasSubstr("Usage:")) << command;
  }
}

/// The signals of ../shared/reference as loops: sp = 0, pv = -signal, so that the error is the
/// signal.
TEST_F(Analyze, ReferenceSignalsGiveTheReferenceFigures) {
  const auto reference = shared_dir() / "reference";
  if (!std::filesystem::exists(reference)) GTEST_SKIP() << reference << " is not there";
  const Json expected = Json::parse(std::ifstream(reference / "expected.json"));
  std::ifstream signals(reference / "signals.csv");
  std::string line;
  std::getline(signals, line);
  std::erase(line, '\r');
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::vector<std::string> files(names.size(), "t_s,sp,pv,op\n");
  for (int k = 0; std::getline(signals, line); ++k) {
    std::erase(line, '\r');
    std::istringstream cells(line);
    std::string cell;
    for (std::string& file : files) {
      std::getline(cells, cell, ',');
      const std::string negated = cell.front() == '-' ? cell.substr(1) : "-" + cell;
      file += std::to_string(k) + ",0," + negated + ",50\n";
    }
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    const ProgramResult result = analyze(write(names[k] + ".csv", files[k]));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json hos = Json::parse(result.out)["hos"];
    const Json& wanted = expected["signals"][names[k]];
    for (const char* key : {"segments", "bifrequencies", "mean_bic2", "std_bic2", "max_bic2",
                            "critical_mean_bic2", "ngi", "nli"}) {
      const double value = wanted[key].get<double>();
      EXPECT_NEAR(hos[key].get<double>(), value, 1e-9 * std::abs(value)) << names[k] << ' ' << key;
    }
  }
}

}  // namespace
}  // namespace loopscope::tests
