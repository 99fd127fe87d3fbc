#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::config {

/// What kind of value a setting takes.
enum class Form {
  number,
  text,                 ///< not empty
  optional_text,        ///< may be empty
  connection,           ///< libpq connection string without secrets, not empty
  optional_connection,  ///< likewise, may be empty
  choice,               ///< one of a list of words
  toggle,               ///< true or false
  texts,                ///< a list of texts, each not empty; numbers are taken as their text
  numbers,              ///< likewise, each of them a number
  states,               ///< likewise, each "TEXT=NUMBER"
};

/// What a setting may be. Numbers have a range, choices have words.
struct Limits {
  Form form = Form::text;
  double low = 0.0;       ///< inclusive
  double high = 0.0;      ///< inclusive
  std::string_view unit;  ///< empty = a pure number
  bool even = false;
  std::span<const std::string_view> words;
};

[[nodiscard]] constexpr Limits range(double low, double high, std::string_view unit = {}) {
  return {Form::number, low, high, unit, false, {}};
}
[[nodiscard]] constexpr Limits even_range(double low, double high, std::string_view unit) {
  return {Form::number, low, high, unit, true, {}};
}
[[nodiscard]] constexpr Limits range(core::hos::Bounds bounds, std::string_view unit = {}) {
  return range(bounds.least, bounds.largest, unit);
}
[[nodiscard]] constexpr Limits even_range(core::hos::Bounds bounds, std::string_view unit) {
  return even_range(bounds.least, bounds.largest, unit);
}
[[nodiscard]] constexpr Limits any(Form form) {
  return {form, 0.0, 0.0, {}, false, {}};
}
[[nodiscard]] constexpr Limits one_of(std::span<const std::string_view> words) {
  return {Form::choice, 0.0, 0.0, {}, false, words};
}

[[nodiscard]] bool may_be_empty(Form form);
[[nodiscard]] bool is_connection(Form form);
[[nodiscard]] bool is_list(Form form);

/// The limits in words: "0.1 to 3600 s", "16 to 4096 samples, even", "debug, info, ...".
[[nodiscard]] std::string limits_text(const Limits& limits);

}  // namespace loopscope::config
