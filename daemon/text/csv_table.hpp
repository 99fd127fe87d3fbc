#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// What tells the cells of a line apart.
struct CsvForm {
  char separator = ',';          ///< a comma, a semicolon or a tab
  bool first_line_says = false;  ///< "sep=;", which spreadsheets write, stands before the header
};

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
  char separator = ',';  ///< of its lines
};

/// Whether a file with this header is of the kind that is read; none: commas it is.
using HeaderTest = std::function<bool(const std::vector<std::string>& header)>;

/// The form of a file, from its header alone: what a first line "sep=;" says; else the comma where
/// `fits` accepts the header that it gives; else the semicolon or the tab of which that is true;
/// else what gives the most cells. Throws Failure (unusable_data): an open quote, 60 million cells.
[[nodiscard]] CsvForm find_csv_form(std::string_view text, const std::string& name,
                                    const HeaderTest& fits);

/// Throws Failure (unusable_data): a missing, empty or unreadable file, one of more than 512 MiB or
/// 60 million cells, an open quote, a row with another number of cells than the header. Waits ten
/// minutes at most for a pipe (read_bounded()).
[[nodiscard]] CsvTable read_csv(const std::filesystem::path& file, const HeaderTest& fits = {});

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] CsvTable parse_csv(std::string_view text, const std::string& name, CsvForm form = {});

/// A separator in words: "commas", "semicolons", "tabs".
[[nodiscard]] std::string_view separators_text(char separator);

/// A cell as it is written: quoted when it holds a comma, a quote or a line break.
[[nodiscard]] std::string csv_cell(std::string_view text);

}  // namespace loopscope::daemon
