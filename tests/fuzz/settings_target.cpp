// Settings: any text is accepted or refused with reasons, never anything else. What is accepted
// can be used: storage/ and core/ take it, and its analysis part comes back to the last bit.

#include "config/read_settings.hpp"
#include "core/diagnosis/diagnose.hpp"
#include "daemon/catalogue/naming_rules.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace loopscope::tests::fuzz {
namespace {

void check_refusal(const config::SettingsError& error) {
  require(!error.problems().empty(), "a refused file has at least one problem");
  for (const config::Problem& problem : error.problems())
    require(!problem.message.empty(), "every problem has a message");
  require(std::string_view(error.what()).starts_with("settings: "), "the message names the file");
}

void check_round_trip(const config::Settings& settings) {
  const std::string analysis = config::analysis_settings_json(settings.analysis);
  const std::string text = R"({"results":{"connection":"service=r"},)"
                           R"("historians":[{"connection":"service=h"}],"analysis":)" +
                           analysis + "}";
  const config::Settings again = config::parse_settings(text, "again");
  require(config::analysis_settings_json(again.analysis) == analysis,
          "the analysis part comes back to the last bit");
}

/// What the daemon makes of the settings when it starts.
void check_use(const config::Settings& settings) {
  (void)daemon::results_connection(settings);
  (void)daemon::owner_connection(settings);
  (void)daemon::engineer_connection(settings);
  for (const config::HistorianSettings& historian : settings.historians) {
    (void)daemon::historian_connection(historian);
    (void)daemon::historian_layout(historian);
  }
  try {
    (void)daemon::naming_rules(settings.discovery, {}, {});
  } catch (const daemon::Failure& failure) {
    // Patterns are checked when they are used (loops discover).
    require(failure.exit_code() == daemon::ExitCode::configuration, "a refusal of the settings");
  }
  core::signal::LoopWindow window;
  window.pv.assign(600, 1.0);
  (void)core::first_look(window, settings.analysis);
  core::hos::validate(settings.analysis.hos);
}

}  // namespace

int fuzz_settings(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const config::Settings settings = config::parse_settings(text, "settings");
    check_use(settings);
    check_round_trip(settings);
  } catch (const config::SettingsError& error) {
    check_refusal(error);
  }
  return 0;
}

}  // namespace loopscope::tests::fuzz
