#include "config/syntax_problem.hpp"

#include <algorithm>

namespace loopscope::config {

namespace {

/// Offset of the first byte of what was not expected. The parser keeps reliable text for strings
/// alone; everything else is pointed at by its last character.
std::size_t offset_of(std::string_view text, std::size_t characters_read, std::string_view token) {
  const std::size_t end = std::min(characters_read, text.size());
  const bool whole_string = token.size() > 1 && token.front() == '"' && token.back() == '"';
  if (whole_string && text.substr(0, end).ends_with(token)) return end - token.size();
  return end == 0 || characters_read > text.size() ? end : end - 1;
}

std::string position_text(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string_view line_start = before.substr(before.rfind('\n') + 1);
  const auto column = std::count_if(line_start.begin(), line_start.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // UTF-8: not a continuation byte
  });
  return "line " + std::to_string(line) + ", column " + std::to_string(column + 1);
}

void replace(std::string& text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at != std::string::npos) text.replace(at, from.size(), to);
}

/// "... - unexpected '}'; expected string literal" in the words of a settings file. What follows
/// "last read" quotes the file and is cut off.
std::string message_of(std::string_view complaint) {
  if (complaint.find("out_of_range") != std::string_view::npos) return "the number is too large";
  const std::size_t dash = complaint.find(" - ");
  if (dash != std::string_view::npos) complaint.remove_prefix(dash + 3);
  std::string message(complaint.substr(0, complaint.find("; last read: ")));
  replace(message, "; expected string literal", "; expected a key in double quotes");
  replace(message, "expected '[', '{', or a literal", "expected a value");
  replace(message, "; expected '}'", "; expected ',' or '}'");
  replace(message, "; expected ']'", "; expected ',' or ']'");
  replace(message, "string literal", "text");
  replace(message, "number literal", "number");
  return message;
}

std::string hint_of(std::string_view text, std::size_t offset, std::string_view message) {
  std::string_view before = text.substr(0, offset);
  before = before.substr(0, before.find_last_not_of(" \t\r\n") + 1);
  if (before.empty()) return "a settings file is one JSON object: { ... }";
  if (before.ends_with(',')) return "no comma may follow the last member";
  if (message.find("expected ','") != std::string_view::npos)
    return "is a comma missing before it?";
  if (message.find("double quotes") != std::string_view::npos)
    return "every key stands in double quotes: \"poll_s\": 10";
  return {};
}

}  // namespace

Problem syntax_problem(std::string_view text, std::size_t characters_read, std::string_view token,
                       std::string_view complaint) {
  const std::size_t offset = offset_of(text, characters_read, token);
  const std::string message = message_of(complaint);
  return {position_text(text, offset), message, hint_of(text, offset, message)};
}

}  // namespace loopscope::config
