#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// A CSV file after RFC 4180: a header and rows of as many cells, quotes resolved, blank lines and
/// a byte-order mark left out.
struct CsvTable {
  struct Row {
    std::size_t line = 0;  ///< where it starts in the file, from 1
    std::vector<std::string> cells;
  };
  std::string name;  ///< the file, for messages
  std::vector<std::string> header;
  std::vector<Row> rows;
};

/// Throws Failure (unusable_data): a missing, empty or unreadable file, one of more than 512 MiB or
/// 60 million cells, an open quote, a row with another number of cells than the header. Waits ten
/// minutes at most for a pipe (read_bounded()).
[[nodiscard]] CsvTable read_csv(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] CsvTable parse_csv(std::string_view text, const std::string& name);

/// A cell as it is written: quoted when it holds a comma, a quote or a line break.
[[nodiscard]] std::string csv_cell(std::string_view text);

}  // namespace loopscope::daemon
