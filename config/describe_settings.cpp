#include "config/describe_settings.hpp"

#include <nlohmann/json.hpp>

#include "config/number_text.hpp"
#include "config/setting_table.hpp"

namespace loopscope::config {

namespace {

std::string default_text(const Setting& setting, Settings& defaults) {
  const nlohmann::ordered_json value = target_value(setting.target(defaults, 0));
  if (value.is_number_float()) return "`" + number_text(value.get<double>()) + "`";
  const std::string text = value.dump();
  if (text != R"("")") return "`" + text + "`";
  return may_be_empty(setting.limits.form) ? "empty" : "required";
}

std::string values_text(const Setting& setting, Settings& defaults) {
  const bool whole = takes_whole_numbers(setting.target(defaults, 0));
  return (whole ? "whole number, " : "") + limits_text(setting.limits);
}

}  // namespace

std::string describe_settings() {
  Settings defaults;
  defaults.historians.resize(1);
  std::string table = "| setting | default | values | meaning |\n|---|---|---|---|\n";
  for (const Setting& setting : setting_table()) {
    table.append("| `").append(setting.path).append("` | ");
    table.append(default_text(setting, defaults)).append(" | ");
    table.append(values_text(setting, defaults)).append(" | ");
    table.append(setting.meaning).append(" |\n");
  }
  return table;
}

}  // namespace loopscope::config
