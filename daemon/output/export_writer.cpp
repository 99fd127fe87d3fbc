#include "daemon/output/export_writer.hpp"

#include <iostream>
#include <optional>

#include "daemon/failure.hpp"
#include "daemon/output/output_file.hpp"
#include "daemon/output/write_csv.hpp"
#include "daemon/recording/csv_table.hpp"

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
    } else if (!(std::cout << text)) {
      // Nobody reads on: the rest of the view need not be asked for.
      throw Failure(ExitCode::usage, "standard output could not be written",
                    "check the disk or the program behind the pipe");
    }
  }
  void finish() {
    if (file_) file_->finish();
  }

 private:
  std::optional<OutputFile> file_;
};

/// A line of cells, and how many of them look like formulas.
class CsvLine {
 public:
  void add(const std::string& cell) {
    if (!first_) line_ += ',';
    first_ = false;
    line_ += csv_cell(cell);
    if (is_formula(cell)) ++formulas_;
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
  note_formulas(line.formulas());
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
