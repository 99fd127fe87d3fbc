#include "storage/array_literal.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {

void ArrayLiteral::add_element(std::string_view raw) {
  if (!elements_.empty()) elements_ += ',';
  elements_ += raw;
}

void ArrayLiteral::add_null() {
  add_element("NULL");
}

void ArrayLiteral::add_integer(std::int64_t value) {
  add_element(std::to_string(value));
}

void ArrayLiteral::add_boolean(bool value) {
  add_element(value ? "t" : "f");
}

void ArrayLiteral::add_number(std::optional<double> value) {
  if (value && std::isfinite(*value)) {
    add_element(number_text(*value));
  } else {
    add_null();
  }
}

void ArrayLiteral::add_time(std::int64_t time_us) {
  add_text(timestamp_text(time_us));
}

void ArrayLiteral::add_text(std::string_view value) {
  std::string quoted = "\"";
  for (const char character : make_storable(value)) {
    if (character == '"' || character == '\\') quoted += '\\';
    quoted += character;
  }
  quoted += '"';
  add_element(quoted);
}

void ArrayLiteral::add_text_list(std::span<const std::string> values) {
  ArrayLiteral list;
  for (const std::string& value : values) list.add_text(value);
  add_text(list.text());
}

void ArrayLiteral::add_real_list(std::span<const std::optional<double>> values) {
  if (values.empty()) return add_null();
  constexpr double kLeast = std::numeric_limits<float>::min();
  ArrayLiteral list;
  for (const std::optional<double>& value : values)
    list.add_number(value && std::abs(*value) < kLeast ? 0.0 : value);
  add_text(list.text());
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace loopscope::storage
