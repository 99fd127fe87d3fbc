#include "config/time_zones.hpp"

#include <algorithm>
#include <date/tz.h>
#include <exception>
#include <optional>

#include "config/nearest_name.hpp"

namespace loopscope::config {
namespace {

std::vector<std::string> read_names() {
  std::vector<std::string> names;
  try {
    for (const date::time_zone& zone : date::get_tzdb().zones) {
      if (zone.name() != "localtime") names.push_back(zone.name());
    }
  } catch (const std::exception&) {
    return {};  // the library throws where the system has no database
  }
  std::ranges::sort(names);
  return names;
}

/// "berlin" stands for Europe/Berlin: whoever names no continent names the place, or a zone without
/// one.
std::optional<std::string> nearest_zone(std::string_view name, std::vector<std::string> names) {
  if (name.find('/') != std::string_view::npos) return nearest_name(name, names);
  std::stable_partition(names.begin(), names.end(), [](const std::string& zone) {
    return zone.find('/') == std::string::npos;
  });
  std::vector<std::string> places;
  for (const std::string& zone : names) places.push_back(zone.substr(zone.rfind('/') + 1));
  const auto nearest = nearest_name(name, places);
  if (!nearest) return std::nullopt;
  const auto at = std::ranges::find(places, *nearest) - places.begin();
  return names[static_cast<std::size_t>(at)];
}

}  // namespace

const std::vector<std::string>& time_zone_names() {
  static const std::vector<std::string> names = read_names();
  return names;
}

bool is_time_zone(std::string_view name) {
  return name == kUtc || std::ranges::binary_search(time_zone_names(), name);
}

std::string time_zone_hint(std::string_view name) {
  const std::vector<std::string>& names = time_zone_names();
  if (names.empty())
    return "this system has no time zone database: apt-get install tzdata, or leave it at \"UTC\"";
  if (const auto nearest = nearest_zone(name, names)) return "did you mean \"" + *nearest + "\"?";
  return R"(write a name of the IANA database, e.g. "Europe/Berlin"; `timedatectl list-timezones` )"
         "lists them";
}

}  // namespace loopscope::config
