#include "config/limits.hpp"

#include "config/number_text.hpp"

namespace loopscope::config {

namespace {

std::string range_text(const Limits& limits) {
  std::string text = number_text(limits.low) + " to " + number_text(limits.high);
  if (!limits.unit.empty()) text.append(" ").append(limits.unit);
  if (limits.even) text += ", even";
  return text;
}

std::string words_text(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

}  // namespace

bool may_be_empty(Form form) {
  return form == Form::optional_text || form == Form::optional_connection;
}

bool is_connection(Form form) {
  return form == Form::connection || form == Form::optional_connection;
}

bool is_list(Form form) {
  return form == Form::texts || form == Form::numbers || form == Form::states;
}

std::string limits_text(const Limits& limits) {
  switch (limits.form) {
    case Form::number:
      return range_text(limits);
    case Form::choice:
      return words_text(limits.words);
    case Form::toggle:
      return "true or false";
    case Form::texts:
      return "list of texts";
    case Form::numbers:
      return "list of numbers";
    case Form::states:
      return "list of \"TEXT=NUMBER\"";
    case Form::text:
      return "text";
    case Form::optional_text:
      return "text or empty";
    case Form::connection:
      return "connection string without a password";
    case Form::optional_connection:
      return "connection string without a password, or empty";
  }
  return {};
}

}  // namespace loopscope::config
