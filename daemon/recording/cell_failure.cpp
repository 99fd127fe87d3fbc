#include "daemon/recording/cell_failure.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "daemon/recording/cells.hpp"

namespace loopscope::daemon {
namespace {

/// One line of a terminal still holds the file, the place and this much of the cell.
constexpr std::size_t kMostCharacters = 60;

unsigned byte_of(char c) {
  return static_cast<unsigned char>(c);
}

bool continues_character(char c) {
  return (byte_of(c) & 0xC0U) == 0x80U;
}

/// Bytes of a character of UTF-8 by its first one; 0 where none starts with it.
std::size_t character_length(unsigned first) {
  if (first < 0x80U) return 1;
  if (first >= 0xC2U && first <= 0xDFU) return 2;
  if (first >= 0xE0U && first <= 0xEFU) return 3;
  return first >= 0xF0U && first <= 0xF4U ? 4 : 0;
}

/// Length of the printable character that `text` starts with; 0 = its first byte is to be escaped.
std::size_t printable_length(std::string_view text) {
  const std::size_t length = character_length(byte_of(text.front()));
  if (length == 1) return text.front() >= ' ' && text.front() <= '~' ? 1 : 0;
  if (length == 0 || length > text.size()) return 0;
  const std::string_view rest = text.substr(1, length - 1);
  if (!std::all_of(rest.begin(), rest.end(), continues_character)) return 0;
  // U+0080 to U+009F steer a terminal.
  const bool control = byte_of(text[0]) == 0xC2U && byte_of(text[1]) < 0xA0U;
  return control ? 0 : length;
}

}  // namespace

std::string shown(std::string_view cell) {
  std::string text = "\"";
  for (std::size_t count = 0; !cell.empty() && count < kMostCharacters; ++count) {
    const std::size_t length = printable_length(cell);
    text += length > 0 ? std::string(cell.substr(0, length))
                       : fmt::format("\\x{:02x}", byte_of(cell.front()));
    cell.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text + (cell.empty() ? "\"" : "...\"");
}

Failure cell_failure(const CsvTable& table, const CsvTable::Row& row, std::size_t column,
                     const std::string& problem, const std::string& hint) {
  return {ExitCode::unusable_data,
          fmt::format("{}, line {}, column \"{}\": {}", table.name, row.line,
                      trimmed(table.header[column]), problem),
          hint};
}

}  // namespace loopscope::daemon
