#include "daemon/catalogue/unknown_loop.hpp"

#include <fmt/format.h>
#include <optional>
#include <vector>

#include "config/nearest_name.hpp"

namespace loopscope::daemon {

Failure unknown_loop(const std::string& name, std::span<const storage::CatalogueEntry> all) {
  std::vector<std::string> names;
  for (const storage::CatalogueEntry& entry : all) names.push_back(entry.name);
  const std::optional<std::string> nearest = config::nearest_name(name, names);
  const std::string where = "loopscope loops --config F lists them";
  return {ExitCode::usage, fmt::format("no loop named \"{}\" in the catalogue", name),
          nearest ? fmt::format("did you mean \"{}\"? {}", *nearest, where) : where};
}

Failure unknown_loop(const std::string& name, storage::Catalogue& catalogue) {
  return unknown_loop(name, catalogue.list());
}

void require_loop(const std::string& name, storage::Catalogue& catalogue) {
  if (!catalogue.find(name)) throw unknown_loop(name, catalogue);
}

}  // namespace loopscope::daemon
