#include "config/setting_table.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "config/read_value.hpp"
#include "tests/config/field_count.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::config::tests {
namespace {

/// How many settings stand directly in a section.
std::size_t settings_in(const std::string& section) {
  std::size_t count = 0;
  for (const Setting& setting : setting_table())
    if (setting.path.substr(0, setting.path.rfind('/')) == section) ++count;
  return count;
}

TEST(SettingTable, EveryFieldOfEveryStructHasItsRow) {
  EXPECT_EQ(settings_in("/results"), field_count<ResultsSettings>());
  EXPECT_EQ(settings_in("/historians/*"), field_count<HistorianSettings>());
  EXPECT_EQ(settings_in("/schedule"), field_count<ScheduleSettings>());
  EXPECT_EQ(settings_in("/daemon") + 1, field_count<DaemonSettings>());
  EXPECT_EQ(settings_in("/daemon/acknowledge"), field_count<AcknowledgeSettings>());
  EXPECT_EQ(settings_in("/flags"), field_count<FlagSettings>());
  EXPECT_EQ(settings_in("/plant"), field_count<PlantSettings>());
  EXPECT_EQ(settings_in("/discovery"), field_count<DiscoverySettings>());
  EXPECT_EQ(settings_in("/report"), field_count<ReportSettings>());
  // Those of the window, and the switch that belongs to no room.
  EXPECT_EQ(settings_in("/analysis"), field_count<core::signal::PrepareSettings>() + 1);
  EXPECT_EQ(settings_in("/analysis/hos"), field_count<core::hos::Settings>());
  EXPECT_EQ(settings_in("/analysis/oscillation"), field_count<core::loop::OscillationSettings>());
  EXPECT_EQ(settings_in("/analysis/performance"), field_count<core::loop::PerformanceSettings>());
  EXPECT_EQ(settings_in("/analysis/decision") + 1,
            field_count<core::diagnosis::DecisionSettings>());
  EXPECT_EQ(settings_in("/analysis/priors"), field_count<core::diagnosis::Priors>());
  EXPECT_EQ(field_count<core::AnalysisSettings>(), 6U) << "a section is not in the table";
  EXPECT_EQ(field_count<Settings>(), 9U) << "a section is not in the table";
}

TEST(SettingTable, NoPathAndNoPlaceStandsInItTwice) {
  Settings settings;
  settings.historians.resize(1);
  std::set<std::string_view> paths;
  std::set<const void*> places;
  for (const Setting& setting : setting_table()) {
    EXPECT_TRUE(paths.insert(setting.path).second) << setting.path;
    const void* place =
        std::visit([](auto* p) -> const void* { return p; }, setting.target(settings, 0));
    EXPECT_TRUE(places.insert(place).second) << setting.path;
    EXPECT_FALSE(setting.meaning.empty()) << setting.path;
  }
}

TEST(SettingTable, DefaultsAreWithinTheirLimitsOrRequired) {
  Settings settings;
  settings.historians.resize(1);
  for (const Setting& setting : setting_table()) {
    const SettingTarget target = setting.target(settings, 0);
    ProblemList problems;
    read_value(target_value(target), std::string(setting.path), setting.limits, target, problems);
    if (setting.limits.form == Form::connection)
      EXPECT_EQ(problems.problems().size(), 1U) << setting.path;
    else
      EXPECT_THAT(problems.problems(), testing::IsEmpty()) << setting.path;
  }
}

TEST(SettingTable, NumbersAreAcceptedUpToTheirLimitsAndNotBeyond) {
  Settings settings;
  settings.historians.resize(1);
  for (const Setting& setting : setting_table()) {
    if (setting.limits.form != Form::number) continue;
    const auto accepts = [&](double number) {
      ProblemList problems;
      read_value(number, "/x", setting.limits, setting.target(settings, 0), problems);
      return problems.problems().empty();
    };
    EXPECT_TRUE(accepts(setting.limits.low) && accepts(setting.limits.high)) << setting.path;
    EXPECT_FALSE(accepts(setting.limits.low - 2.0)) << setting.path;
    EXPECT_FALSE(accepts(setting.limits.high + 2.0)) << setting.path;
  }
}

/// Mutants of a file reach only what the file holds.
TEST(SettingTable, TheFuzzersSeedAndItsDictionaryHoldEverySetting) {
  const std::filesystem::path fuzz = loopscope::tests::source_dir() / "tests" / "fuzz";
  const auto seed = nlohmann::json::parse(
      loopscope::tests::content_of(fuzz / "corpus" / "settings" / "every_setting.json"));
  const std::string words = loopscope::tests::content_of(fuzz / "dictionaries" / "settings.dict");
  for (const Setting& setting : setting_table()) {
    std::string path(setting.path);
    if (const auto star = path.find('*'); star != std::string::npos) path[star] = '0';
    EXPECT_TRUE(seed.contains(nlohmann::json::json_pointer(path))) << path;
    const std::string key = path.substr(path.rfind('/') + 1);
    EXPECT_THAT(words, testing::HasSubstr("\"\\\"" + key + "\\\":\"")) << path;
  }
}

}  // namespace
}  // namespace loopscope::config::tests
