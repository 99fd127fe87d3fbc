#include "tests/config/settings_text.hpp"

#include <nlohmann/json.hpp>

#include "config/setting_table.hpp"

namespace loopscope::config::tests {

std::string complete_text() {
  using Json = nlohmann::ordered_json;
  Settings defaults;
  defaults.historians.resize(1);
  Json file = Json::object();
  for (const Setting& setting : setting_table()) {
    std::string path(setting.path);
    if (const std::size_t star = path.find('*'); star != std::string::npos) path[star] = '0';
    Json value = target_value(setting.target(defaults, 0));
    if (value == "" && !may_be_empty(setting.limits.form)) value = "service=any";
    file[Json::json_pointer(path)] = value;
  }
  return file.dump(2);
}

}  // namespace loopscope::config::tests
