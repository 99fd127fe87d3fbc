#include "config/analysis_settings_json.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "config/read_settings.hpp"
#include "config/setting_table.hpp"

namespace loopscope::config {

std::string analysis_settings_json(const core::AnalysisSettings& settings) {
  using Json = nlohmann::ordered_json;
  constexpr std::string_view kSection = "/analysis";
  Settings holder;
  holder.analysis = settings;
  Json json = Json::object();
  for (const Setting& setting : setting_table()) {
    if (!setting.path.starts_with(kSection)) continue;
    const std::string path(setting.path.substr(kSection.size()));
    json[Json::json_pointer(path)] = target_value(setting.target(holder, 0));
  }
  return json.dump();
}

core::AnalysisSettings parse_analysis_settings(const std::string& json) {
  // A settings file of which nothing but this section is used.
  return parse_settings(R"({"results": {"connection": "dbname=none"}, "historians": [{"connection":
                            "dbname=none"}], "analysis": )" +
                            json + "}",
                        "stored settings")
      .analysis;
}

}  // namespace loopscope::config
