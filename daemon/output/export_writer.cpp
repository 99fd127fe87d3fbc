#include "daemon/output/export_writer.hpp"

#include <fmt/format.h>
#include <iostream>
#include <optional>

#include "core/text/counted.hpp"
#include "daemon/output/output_file.hpp"
#include "daemon/output/standard_output.hpp"
#include "daemon/output/write_csv.hpp"
#include "daemon/text/csv_table.hpp"

namespace loopscope::daemon {
namespace {

/// A file or standard output.
class Sink {
 public:
  explicit Sink(const std::string& file) {
    if (file != "-") file_.emplace(file);
  }
  void write(const std::string& text) {
    if (file_) {
      file_->write(text);
    } else {
      // Throws when nobody reads on: the rest of the view need not be asked for.
      write_to_standard_output(text);
    }
  }
  void finish() {
    if (file_) file_->finish();
  }

 private:
  std::optional<OutputFile> file_;
};

/// A line of cells, and how many of them look like formulas. Those get a quote, which a spreadsheet
/// takes for "this is text" and does not show: nothing reads a view in again.
class CsvLine {
 public:
  void add(const std::string& cell) {
    if (!first_) line_ += ',';
    first_ = false;
    const bool formula = is_formula(cell);
    line_ += csv_cell(formula ? "'" + cell : cell);
    if (formula) ++formulas_;
  }
  std::string take() {
    std::string whole = std::move(line_) + "\n";
    line_.clear();
    first_ = true;
    return whole;
  }
  [[nodiscard]] std::size_t formulas() const { return formulas_; }

 private:
  std::string line_;
  bool first_ = true;
  std::size_t formulas_ = 0;
};

void note_quoted(std::size_t count) {
  if (count == 0) return;
  std::cerr << fmt::format(
      "note: {} with =, +, - or @: a quote in front keeps spreadsheets from reading a formula; "
      "--format json has the text as it is\n",
      core::text::counted(count, "cell begins", "cells begin"));
}

}  // namespace

void export_csv(const storage::ConnectionSettings& connection,
                const storage::ExportRequest& request, const std::string& file) {
  Sink sink(file);
  CsvLine line;
  storage::export_rows(
      connection, request,
      [&](const std::vector<std::string>& names) {
        for (const std::string& name : names) line.add(name);
        sink.write(line.take());
      },
      [&](const std::vector<storage::ExportedValue>& values) {
        for (const storage::ExportedValue& value : values) line.add(value.value_or(""));
        sink.write(line.take());
      });
  sink.finish();
  note_quoted(line.formulas());
}

void export_json(const storage::ConnectionSettings& connection,
                 const storage::ExportRequest& request, const std::string& file) {
  Sink sink(file);
  const char* before = "[\n";
  storage::export_objects(connection, request, [&](const std::string& object) {
    sink.write(before + object);
    before = ",\n";
  });
  sink.write(*before == '[' ? "[]\n" : "\n]\n");
  sink.finish();
}

}  // namespace loopscope::daemon
