#include "config/read_tree.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/document.hpp"
#include "config/historian_presets.hpp"
#include "config/nearest_name.hpp"
#include "config/read_value.hpp"
#include "config/setting_table.hpp"

namespace loopscope::config {

namespace {

using Json = nlohmann::ordered_json;

/// Where the reader stands: the path in the file, the same path as the table writes it ("*" for an
/// index), and that index.
struct Place {
  std::string path;
  std::string pattern;
  std::size_t index = 0;
};

/// The names that the table has directly below a pattern, each once, in its order.
std::vector<std::string> names_below(const std::string& pattern) {
  std::vector<std::string> names;
  for (const Setting& setting : setting_table()) {
    if (!setting.path.starts_with(pattern + "/")) continue;
    const std::string_view rest = setting.path.substr(pattern.size() + 1);
    const std::string name(rest.substr(0, rest.find('/')));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

const Setting* find_setting(std::string_view pattern) {
  const auto table = setting_table();
  const auto found = std::find_if(table.begin(), table.end(), [pattern](const Setting& setting) {
    return setting.path == pattern;
  });
  return found == table.end() ? nullptr : &*found;
}

/// A key that is right in another object has most likely been put into the wrong one.
std::string hint_for_unknown(const std::string& key, const std::vector<std::string>& known) {
  if (const auto nearest = nearest_name(key, known)) return "did you mean \"" + *nearest + "\"?";
  for (const Setting& setting : setting_table())
    if (setting.path.ends_with("/" + key)) return "it belongs to " + std::string(setting.path);
  std::string hint = "known here:";
  for (const std::string& name : known) hint += (hint.back() == ':' ? " " : ", ") + name;
  return hint;
}

/// What a historian's other keys change: the preset that it names, wherever it names it.
HistorianSettings defaults_for(const Json& historian) {
  const auto named = historian.is_object() ? historian.find("preset") : historian.end();
  if (named == historian.end() || !named->is_string()) return {};
  const auto name = named->get<std::string>();
  const auto known = preset_names();
  return std::find(known.begin(), known.end(), name) == known.end() ? HistorianSettings{}
                                                                    : historian_preset(name);
}

class TreeReader {
 public:
  TreeReader(Settings& settings, ProblemList& problems)
      : settings_(settings), problems_(problems) {}

  void read(const Json& node, const Place& place) {
    if (const Setting* setting = find_setting(place.pattern)) {
      read_value(node, place.path, setting->limits, setting->target(settings_, place.index),
                 problems_);
      return;
    }
    const std::vector<std::string> names = names_below(place.pattern);
    if (names.front() == "*")
      read_array(node, place);
    else
      read_object(node, place, names);
  }

 private:
  /// The historians are the one array of the file.
  void read_array(const Json& node, const Place& place) {
    if (!node.is_array()) {
      problems_.add({place.path, "is " + kind_of(node) + ", not an array of objects",
                     node.is_object() ? "put it into brackets: [ ... ]" : ""});
      return;
    }
    for (const Json& historian : node) settings_.historians.push_back(defaults_for(historian));
    for (std::size_t i = 0; i < node.size(); ++i)
      read(node[i], {place.path + "/" + std::to_string(i), place.pattern + "/*", i});
  }

  void read_object(const Json& node, const Place& place, const std::vector<std::string>& names) {
    if (!node.is_object()) {
      problems_.add({place.path, "is " + kind_of(node) + ", not an object", {}});
      return;
    }
    for (const auto& [key, value] : node.items()) {
      const std::string path = member_path(place.path, key);
      if (std::find(names.begin(), names.end(), key) == names.end())
        problems_.add({path, "is not a known setting", hint_for_unknown(key, names)});
      else
        read(value, {path, place.pattern + "/" + key, place.index});
    }
  }

  Settings& settings_;
  ProblemList& problems_;
};

void require(const Setting& setting, Settings& settings, std::size_t index, ProblemList& problems) {
  const SettingTarget target = setting.target(settings, index);
  const auto* const* text = std::get_if<std::string*>(&target);
  if (text == nullptr || !(*text)->empty() || may_be_empty(setting.limits.form)) return;
  std::string path(setting.path);
  const std::size_t star = path.find('*');
  if (star != std::string::npos) path.replace(star, 1, std::to_string(index));
  problems.add_unless_refused({path}, "is missing", std::string(setting.meaning));
}

void require_all(Settings& settings, ProblemList& problems) {
  for (const Setting& setting : setting_table()) {
    const bool repeated = setting.path.find('*') != std::string_view::npos;
    const std::size_t count = repeated ? settings.historians.size() : 1;
    for (std::size_t index = 0; index < count; ++index) require(setting, settings, index, problems);
  }
}

}  // namespace

Settings read_tree(const Json& root, ProblemList& problems) {
  Settings settings;
  TreeReader(settings, problems).read(root, {});
  require_all(settings, problems);
  return settings;
}

}  // namespace loopscope::config
