#include "daemon/text/csv_table.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

#include "config/read_bounded.hpp"
#include "core/text/counted.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

/// In the order in which they are tried.
constexpr std::string_view kSeparators = ",;\t";

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A recording of ten million samples fits in.
constexpr std::size_t kLargestFile = std::size_t{512} * 1024 * 1024;
/// A cell takes 32 bytes of memory and may have no more than a comma in the file.
constexpr std::size_t kMostCells = 60'000'000;
/// Whoever writes into a pipe may have to ask a database first.
constexpr int kReadTimeout_s = 600;

/// Splits text into records; keeps the line in which each starts.
class Splitter {
 public:
  Splitter(std::string_view text, const std::string& name, char separator)
      : text_(text), name_(name), separator_(separator), ends_{separator, '\r', '\n'} {}

  /// Next record that is not blank; false at the end of the text.
  bool next(CsvTable::Row& row) {
    while (at_ < text_.size()) {
      row = {line_, {}};
      read_record(row.cells);
      const bool blank = row.cells.size() == 1 && row.cells.front().empty();
      if (!blank) return true;
    }
    return false;
  }

 private:
  void read_record(std::vector<std::string>& cells) {
    bool more = true;
    while (more) {
      count_cell();
      cells.push_back(at_ < text_.size() && text_[at_] == '"' ? quoted_cell() : plain_cell());
      more = at_ < text_.size() && text_[at_] == separator_;
      if (more) ++at_;
    }
    end_line();
  }

  /// Here, because a single line may hold all of them.
  void count_cell() {
    if (++cells_ <= kMostCells) return;
    throw Failure(ExitCode::unusable_data,
                  fmt::format("{}, line {}: more than {} cells", name_, line_, kMostCells),
                  "split the file, or leave out the columns that are not needed");
  }

  std::string plain_cell() {
    const std::string_view ends(ends_.data(), ends_.size());
    const std::size_t end = std::min(text_.find_first_of(ends, at_), text_.size());
    std::string cell(text_.substr(at_, end - at_));
    at_ = end;
    return cell;
  }

  std::string quoted_cell() {
    const std::size_t opened = line_;
    std::string cell;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] == '"') {
        const bool doubled = at_ + 1 < text_.size() && text_[at_ + 1] == '"';
        ++at_;
        if (!doubled) return cell + plain_cell();
      }
      cell += text_[at_];
    }
    throw Failure(ExitCode::unusable_data,
                  fmt::format("{}, line {}: a quote is opened and never closed", name_, opened),
                  "close it, or double a quote that belongs to the text");
  }

  void end_line() {
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++line_;
  }

  std::string_view text_;
  const std::string& name_;
  char separator_;
  std::array<char, 3> ends_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t cells_ = 0;
};

void require_width(const CsvTable& table, const CsvTable::Row& row) {
  if (row.cells.size() == table.header.size()) return;
  throw Failure(
      ExitCode::unusable_data,
      fmt::format("{}, line {}: {} where the header has {}", table.name, row.line,
                  core::text::counted(row.cells.size(), "cell", "cells"), table.header.size()),
      fmt::format("separate cells by {} and leave missing ones empty{}",
                  separators_text(table.separator),
                  table.separator == ',' ? "; decimal point, not comma" : ""));
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

std::vector<std::string> header_of(std::string_view text, const std::string& name, char separator) {
  Splitter splitter(text, name, separator);
  CsvTable::Row row;
  return splitter.next(row) ? row.cells : std::vector<std::string>{};
}

/// What a first line "sep=;" says.
std::optional<char> said_separator(std::string_view text) {
  constexpr std::string_view kWord = "sep=";
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  if (line.size() != kWord.size() + 1 || !line.starts_with(kWord)) return std::nullopt;
  const char separator = line.back();
  return kSeparators.find(separator) == std::string_view::npos ? std::nullopt
                                                               : std::optional(separator);
}

}  // namespace

CsvForm find_csv_form(std::string_view text, const std::string& name, const HeaderTest& fits) {
  if (!fits) return {};
  text = without_mark(text);
  if (const auto said = said_separator(text)) return {*said, true};
  CsvForm form;
  std::size_t most = 0;
  for (const char separator : kSeparators) {
    const std::vector<std::string> header = header_of(text, name, separator);
    if (fits(header)) return {separator};
    if (header.size() <= most) continue;
    most = header.size();
    form.separator = separator;
  }
  return form;
}

CsvTable parse_csv(std::string_view text, const std::string& name, CsvForm form) {
  text = without_mark(text);
  CsvTable table{name, {}, {}, form.separator};
  Splitter splitter(text, name, form.separator);
  CsvTable::Row row;
  if (form.first_line_says) static_cast<void>(splitter.next(row));
  if (!splitter.next(row)) {
    throw Failure(ExitCode::unusable_data, name + ": the file is empty",
                  "give a CSV file with a header line: t_s,sp,pv,op");
  }
  table.header = std::move(row.cells);
  while (splitter.next(row)) {
    require_width(table, row);
    table.rows.push_back(std::move(row));
  }
  return table;
}

CsvTable read_csv(const std::filesystem::path& file, const HeaderTest& fits) {
  try {
    const std::string text = config::read_bounded(file, kLargestFile, kReadTimeout_s);
    return parse_csv(text, file.string(), find_csv_form(text, file.string(), fits));
  } catch (const config::UnreadableFile& error) {
    throw Failure(ExitCode::unusable_data, file.string() + ": the file " + error.what(),
                  error.hint());
  }
}

std::string_view separators_text(char separator) {
  if (separator == ';') return "semicolons";
  return separator == '\t' ? "tabs" : "commas";
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace loopscope::daemon
