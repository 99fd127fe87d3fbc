#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace loopscope::tests {

/// A name as somebody might have typed it into a control system, or planted it there.
struct HostileName {
  const char* about;  ///< what it is aimed at
  std::string name;
};

/// Names that every part of the program has to carry unchanged: valid UTF-8, not empty, no zero
/// byte, no two equal. Aimed at SQL, arrays and COPY, CSV and spreadsheets, JSON, HTML, shells,
/// file names, options, format strings, logs and terminals.
[[nodiscard]] const std::vector<HostileName>& hostile_names();

/// What no database takes as text: it has to be refused in words.
[[nodiscard]] const std::vector<HostileName>& impossible_names();

/// Those of hostile_names() that can name a table or a column: at most 63 bytes.
[[nodiscard]] std::vector<HostileName> hostile_identifiers();

/// The bytes of `text` as hexadecimal digits.
[[nodiscard]] std::string hex(std::string_view text);

/// SQL of `text` (UTF-8 without zero bytes) that no quote or backslash in it can leave.
[[nodiscard]] std::string sql_text(std::string_view text);

/// `name` as SQL names a table or a column.
[[nodiscard]] std::string sql_identifier(std::string_view name);

/// Whether `text`, but for line breaks, has nothing that a terminal obeys, that turns the direction
/// of writing around or that breaks lines otherwise.
[[nodiscard]] bool is_harmless_on_a_terminal(std::string_view text);

}  // namespace loopscope::tests
