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

using Names = std::vector<std::string>;

/// The name among `parts` that is nearest, as the zone of the same place in `zones`. Cities are
/// short names: two wrong letters of six make Munich of Zurich.
std::optional<std::string> zone_of_nearest(std::string_view name, const Names& parts,
                                           const Names& zones) {
  const auto nearest = nearest_name(name, parts);
  const std::size_t most = std::max<std::size_t>(name.size() / 4, 1);
  if (!nearest || spelling_distance(name, *nearest) > most) return std::nullopt;
  return zones[static_cast<std::size_t>(std::ranges::find(parts, *nearest) - parts.begin())];
}

Names places_of(const Names& zones) {
  Names places;
  for (const std::string& zone : zones) places.push_back(zone.substr(zone.rfind('/') + 1));
  return places;
}

/// "berlin" stands for Europe/Berlin: whoever names no continent names the place, or a zone without
/// one.
std::optional<std::string> nearest_place(std::string_view name, Names zones) {
  std::stable_partition(zones.begin(), zones.end(), [](const std::string& zone) {
    return zone.find('/') == std::string::npos;
  });
  return zone_of_nearest(name, places_of(zones), zones);
}

/// Within its region: the letters of "Europe/" are no likeness of two cities. A place may also
/// stand behind the wrong region.
std::optional<std::string> nearest_in_region(std::string_view name, const Names& zones) {
  const std::size_t slash = name.find('/');
  Names regions;
  for (const std::string& zone : zones) regions.push_back(zone.substr(0, zone.find('/')));
  const auto region = nearest_name(name.substr(0, slash), regions);
  Names cities, of_region;
  for (const std::string& zone : zones) {
    if (!region || !zone.starts_with(*region + "/")) continue;
    cities.push_back(zone.substr(region->size() + 1));
    of_region.push_back(zone);
  }
  if (auto zone = zone_of_nearest(name.substr(slash + 1), cities, of_region)) return zone;
  const std::string_view place = name.substr(name.rfind('/') + 1);
  const Names places = places_of(zones);
  const auto same = std::ranges::find_if(
      places, [&](const std::string& known) { return spelling_distance(place, known) == 0; });
  if (same == places.end()) return std::nullopt;
  return zones[static_cast<std::size_t>(same - places.begin())];
}

std::optional<std::string> nearest_zone(std::string_view name, const Names& zones) {
  return name.find('/') == std::string_view::npos ? nearest_place(name, zones)
                                                  : nearest_in_region(name, zones);
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
  return "write a name of the IANA database, region and a large city of the zone, e.g. "
         "\"Europe/Berlin\"; `timedatectl list-timezones` lists them";
}

}  // namespace loopscope::config
