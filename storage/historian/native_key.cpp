#include "storage/historian/native_key.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

bool is_uuid(const std::string& text) {
  constexpr std::string_view kForm = "hhhhhhhh-hhhh-hhhh-hhhh-hhhhhhhhhhhh";
  const auto fits = [](char character, char form) {
    return form == '-' ? character == '-'
                       : std::isxdigit(static_cast<unsigned char>(character)) != 0;
  };
  return std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), fits);
}

bool is_int8(const std::string& text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

}  // namespace

std::string key_type(const std::string& column_type) {
  if (column_type.starts_with("int")) return "int8";
  if (column_type == "uuid" || column_type == "bpchar") return column_type;
  return "text";
}

std::optional<std::string> native_key(const std::string& key, const std::string& type) {
  const bool possible = type == "int8"   ? is_int8(key)
                        : type == "uuid" ? is_uuid(key)
                                         : is_storable(key);
  if (!possible) return std::nullopt;
  return key;
}

}  // namespace loopscope::storage
