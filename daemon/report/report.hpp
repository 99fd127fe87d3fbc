#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "config/settings.hpp"

namespace loopscope::daemon {

/// What is to be written, and where.
struct ReportOptions {
  std::filesystem::path folder;  ///< made when it is not there
  std::string name = "report";   ///< of the files, without ending
  /// What began after this counts as new; microseconds UTC.
  std::int64_t since_us = 0;
  bool pdf = false;
  bool pictures = true;  ///< false: figures and words only, no gnuplot
};

struct ReportResult {
  std::vector<std::filesystem::path> files;
  std::size_t flagged = 0;     ///< loops of the work list
  std::size_t sections = 0;    ///< of those, with a section (report_page.hpp)
  std::size_t unpictured = 0;  ///< of those with one, without the pictures of their window
  std::string first_trouble;   ///< of those, why the first one has none
};

/// Writes the report of the flagged loops: FOLDER/NAME.html, one self-contained file, and with
/// `pdf` FOLDER/NAME.pdf of the same content. Each appears whole or not at all, and none before
/// both are made. A loop whose historian is away has its stored figures and a sentence. Throws
/// Failure (no plotting program, no PDF engine, folder), storage::DatabaseError (results) and
/// std::system_error (a program that cannot be started).
ReportResult write_report(const config::Settings& settings, const ReportOptions& options,
                          const std::stop_token& stop = {});

}  // namespace loopscope::daemon
