#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "config/limits.hpp"
#include "config/setting_target.hpp"
#include "config/settings.hpp"

namespace loopscope::config {

/// One setting. The default is what a default-constructed Settings holds in the target; a text that
/// is empty there and may not be empty is required.
struct Setting {
  std::string_view path;  ///< JSON path; "*" stands for the index into an array
  /// The place in `settings`; `index` says which element where the path has a "*".
  SettingTarget (*target)(Settings& settings, std::size_t index);
  Limits limits;
  std::string_view meaning;
};

/// The place that is reached from Settings over a chain of members, as Setting::target.
template <auto... members>
[[nodiscard]] SettingTarget target_at(Settings& settings, std::size_t) {
  return &(settings.*....*members);
}

/// Every setting of the file, in the order of the documentation. Reading, validation, documentation
/// and provenance all go by this table.
[[nodiscard]] std::span<const Setting> setting_table();

}  // namespace loopscope::config
