#include "config/first_settings.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "config/historian_presets.hpp"
#include "config/historian_setting_table.hpp"

namespace loopscope::config {
namespace {

constexpr const char* kHead =
    "// Settings of Loopscope, written by `loopscope init`. What is not named here has its "
    "default:\n"
    "// `loopscope check-config --describe` lists every setting with its range and unit.\n"
    "// Passwords are refused here: they stand in ~/.pgpass (mode 0600) or in what PGPASSFILE "
    "names.\n";

/// What sites change first, ready to be uncommented.
constexpr const char* kEngineer =
    "    // The login under which people annotate and enter work; without it the owner's:\n";
constexpr const char* kPlant =
    "  // The clock of the plant, for times that people read and write; without it UTC:\n"
    "  // \"plant\": { \"time_zone\": \"Europe/Berlin\" },\n";

std::string text_of(const std::string& text) {
  return nlohmann::json(text).dump();
}

/// Whatever a table is called, it stays on its line.
std::string comment(const std::string& note) {
  std::string line = "      // ";
  for (const char character : note)
    line += character == '\n' || character == '\r' ? ' ' : character;
  return line + "\n";
}

/// The settings of one historian, in which the rows of the table find it.
Settings with(const HistorianSettings& historian) {
  Settings settings;
  settings.historians.push_back(historian);
  return settings;
}

bool is_always_named(std::string_view key) {
  return key == "name" || key == "preset" || key == "connection" || key == "table";
}

std::string historian_text(const HistorianSettings& historian) {
  Settings wanted = with(historian), usual = with(historian_preset(historian.preset));
  std::string text;
  for (const Setting& setting : historian_setting_table()) {
    const std::string_view key = setting.path.substr(setting.path.rfind('/') + 1);
    const auto value = target_value(setting.target(wanted, 0));
    if (!is_always_named(key) && value == target_value(setting.target(usual, 0))) continue;
    text += (text.empty() ? "      \"" : ",\n      \"") + std::string(key) + "\": " + value.dump();
  }
  return text;
}

}  // namespace

std::string first_settings_text(const FirstSettings& first) {
  std::string notes;
  for (const std::string& note : first.notes) notes += comment(note);
  return std::string(kHead) + "{\n  \"results\": {\n    \"connection\": " + text_of(first.results) +
         ",\n" + kEngineer + "    // \"engineer_connection\": " + text_of(first.engineer) + ",\n" +
         "    // Of the schema's owner: migrate, maintain, loops. Workers alone need none.\n" +
         "    \"owner_connection\": " + text_of(first.owner) + "\n  },\n" + kPlant +
         "  \"historians\": [\n    {\n" + notes + historian_text(first.historian) +
         "\n    }\n  ]\n}\n";
}

}  // namespace loopscope::config
