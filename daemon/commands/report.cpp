#include "daemon/report/report.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/output/what_if_text.hpp"
#include "daemon/report/report_page.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/read_time.hpp"
#include "storage/results/reports/report_database.hpp"

namespace loopscope::daemon {
namespace {

struct CommandOptions {
  std::string config;
  std::string out;
  std::string since;
  std::string what_if;  ///< THRESHOLD=VALUE,...; empty = a report
  bool pdf = false;
  bool no_pictures = false;
};

/// A report is read on Monday: what is new is new since the last one.
std::int64_t a_week_ago_us() {
  const auto ago = std::chrono::system_clock::now() - std::chrono::days(7);
  return std::chrono::duration_cast<std::chrono::microseconds>(ago.time_since_epoch()).count();
}

std::int64_t since_of(const CommandOptions& options, const config::Settings& settings) {
  if (options.since.empty()) return a_week_ago_us();
  return time_option("--since", options.since, TimeZone(settings.plant.time_zone));
}

/// Other thresholds than those in force; nullopt = as it is.
struct Thresholds {
  std::optional<double> rate;
  std::optional<int> dependence;
  std::optional<double> confidence;
};

[[noreturn]] void refuse_threshold(const std::string& part) {
  throw Failure(ExitCode::usage, fmt::format("--what-if: \"{}\" is not a threshold", part),
                "write e.g. rate=0.1,confidence=0.5,dependence=arbitrary (or positive); rate and "
                "confidence lie within 0 and 1");
}

double share_of(const std::string& part, const std::string& value) {
  const auto number = parse_number(value);
  if (!number || !(*number >= 0.0 && *number <= 1.0)) refuse_threshold(part);
  return *number;
}

void set_threshold(const std::string& part, Thresholds& thresholds) {
  const std::size_t equals = std::min(part.find('='), part.size());
  const std::string name = part.substr(0, equals);
  const std::string value = equals == part.size() ? "" : part.substr(equals + 1);
  if (name == "rate")
    thresholds.rate = share_of(part, value);
  else if (name == "confidence")
    thresholds.confidence = share_of(part, value);
  else if (name == "dependence" && (value == "positive" || value == "arbitrary"))
    thresholds.dependence = value == "arbitrary" ? 1 : 0;
  else
    refuse_threshold(part);
}

void try_thresholds(const CommandOptions& options) {
  Thresholds thresholds;
  std::istringstream parts(options.what_if);
  for (std::string part; std::getline(parts, part, ',');) set_threshold(part, thresholds);
  const config::Settings settings = config::read_settings(options.config);
  storage::ReportDatabase database(results_connection(settings));
  std::cout << what_if_text(
      database.what_if(thresholds.rate, thresholds.dependence, thresholds.confidence));
}

void require_folder(const CommandOptions& options) {
  if (!options.out.empty()) return;
  throw Failure(ExitCode::usage, "report: --out is missing",
                "name the folder for report.html, or --what-if for a list of what other "
                "thresholds would flag");
}

void report(const CommandOptions& options) {
  if (!options.what_if.empty()) return try_thresholds(options);
  require_folder(options);
  const config::Settings settings = config::read_settings(options.config);
  const ReportOptions wanted{.folder = options.out,
                             .since_us = since_of(options, settings),
                             .pdf = options.pdf,
                             .pictures = !options.no_pictures};
  const ReportResult result = write_report(settings, wanted);
  for (const auto& file : result.files) std::cout << "wrote " << file.string() << '\n';
  std::cout << core::text::counted(result.flagged, "flagged loop", "flagged loops") << '\n';
  if (result.sections < result.flagged)
    std::cerr << fmt::format(
        "note: {} of them in the work list alone, so that the file stays below {} MB\n",
        result.flagged - result.sections, kMostPageBytes / 1'000'000);
  if (result.unpictured == 0 || options.no_pictures) return;
  std::cerr << fmt::format(
      "note: {} of them without pictures of their window, the first because "
      "{}\n",
      result.unpictured, result.first_trouble);
}

}  // namespace

void add_report(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "report", "The report of flagged loops: one page, and a PDF of it if wanted");
  const auto options = std::make_shared<CommandOptions>();
  command.add_option("--config", options->config, "Settings file")->required();
  command.add_option("--out", options->out, "Folder for report.html and report.pdf");
  command.add_option(
      "--since", options->since,
      "What began after this time counts as new (default: a week ago); without an offset "
      "it is meant in the plant's zone");
  command.add_flag("--pdf", options->pdf, "A PDF beside the page (wants WeasyPrint)");
  command.add_flag("--no-pictures", options->no_pictures, "Figures and words only, no gnuplot");
  command.add_option("--what-if", options->what_if,
                     "Instead: what other thresholds would flag, e.g. rate=0.1,confidence=0.5");
  command.callback([options] { report(*options); });
}

}  // namespace loopscope::daemon
