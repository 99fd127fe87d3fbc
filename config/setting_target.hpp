#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::config {

/// Where the value of one setting lives; not null, and not owned.
using SettingTarget = std::variant<double*, int*, std::size_t*, bool*, std::string*,
                                   std::vector<std::string>*, core::hos::WindowShape*>;

/// Every window shape; the file calls them by their core::hos::name().
inline constexpr std::array kWindowShapes = {
    core::hos::WindowShape::hann, core::hos::WindowShape::hann_periodic,
    core::hos::WindowShape::hamming, core::hos::WindowShape::rectangular};

/// Whether the target takes whole numbers only.
[[nodiscard]] bool takes_whole_numbers(const SettingTarget& target);

/// The value as JSON.
[[nodiscard]] nlohmann::ordered_json target_value(const SettingTarget& target);

/// Stores a number that the target's type can hold (a whole one where it takes no other); throws
/// std::logic_error for a target of words and for a switch.
void store_number(const SettingTarget& target, double value);

/// Stores true or false; throws std::logic_error for a target that is no switch.
void store_switch(const SettingTarget& target, bool value);

/// Stores a text, or the window shape of that name; throws std::logic_error for another target
/// and for a name that no shape has.
void store_text(const SettingTarget& target, const std::string& value);

/// Stores a list of texts; throws std::logic_error for another target.
void store_list(const SettingTarget& target, std::vector<std::string> values);

}  // namespace loopscope::config
