#include "config/setting_target.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace loopscope::config {

namespace {

using core::hos::WindowShape;

void store(WindowShape& shape, const std::string& name) {
  const auto* found =
      std::find_if(kWindowShapes.begin(), kWindowShapes.end(),
                   [&name](WindowShape candidate) { return core::hos::name(candidate) == name; });
  if (found == kWindowShapes.end()) throw std::logic_error("no window shape is called " + name);
  shape = *found;
}

}  // namespace

bool takes_whole_numbers(const SettingTarget& target) {
  return std::holds_alternative<int*>(target) || std::holds_alternative<std::size_t*>(target);
}

nlohmann::ordered_json target_value(const SettingTarget& target) {
  if (const auto* shape = std::get_if<WindowShape*>(&target)) return core::hos::name(**shape);
  return std::visit([](const auto* place) { return nlohmann::ordered_json(*place); }, target);
}

void store_number(const SettingTarget& target, double value) {
  std::visit(
      [value](auto* place) {
        using Value = std::remove_pointer_t<decltype(place)>;
        if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>)
          *place = static_cast<Value>(value);
        else
          throw std::logic_error("a number was stored in a setting of words or a switch");
      },
      target);
}

void store_switch(const SettingTarget& target, bool value) {
  bool* const* place = std::get_if<bool*>(&target);
  if (place == nullptr) throw std::logic_error("a switch was stored in another setting");
  **place = value;
}

void store_text(const SettingTarget& target, const std::string& value) {
  if (auto* const* text = std::get_if<std::string*>(&target))
    **text = value;
  else if (auto* const* shape = std::get_if<WindowShape*>(&target))
    store(**shape, value);
  else
    throw std::logic_error("a text was stored in a setting of numbers or a switch");
}

void store_list(const SettingTarget& target, std::vector<std::string> values) {
  auto* const* list = std::get_if<std::vector<std::string>*>(&target);
  if (list == nullptr) throw std::logic_error("a list was stored in another setting");
  **list = std::move(values);
}

}  // namespace loopscope::config
