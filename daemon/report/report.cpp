#include "daemon/report/report.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "daemon/output/followed_path.hpp"
#include "daemon/output/output_file.hpp"
#include "daemon/report/evidence/window_source.hpp"
#include "daemon/report/figures/draw_figures.hpp"
#include "daemon/report/loop_report.hpp"
#include "daemon/report/make_pdf.hpp"
#include "daemon/report/read_plant_facts.hpp"
#include "daemon/report/report_page.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/threads/in_threads.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/reports/report_database.hpp"

namespace loopscope::daemon {
namespace {

/// As many as the page has room for (kMostPageBytes, some 180 kB each); a plant with more has
/// other worries than the picture of its 26th loop.
constexpr std::size_t kMostPictured = 25;

struct Content {
  PlantFacts facts;
  std::vector<LoopReport> loop_reports;
};

using LoopsById = std::map<std::int64_t, storage::CatalogueEntry>;

LoopsById catalogue_of(const config::Settings& settings) {
  LoopsById loops;
  for (storage::CatalogueEntry& entry : storage::Catalogue(results_connection(settings)).list()) {
    const std::int64_t loop_id = entry.loop_id;
    loops.emplace(loop_id, std::move(entry));
  }
  return loops;
}

/// All that the results know, of one moment; the view is let go before pictures are made.
Content read_content(const config::Settings& settings, std::int64_t since_us) {
  storage::ReportDatabase database(results_connection(settings));
  Content content;
  content.facts = read_plant_facts(database, settings, since_us);
  for (const storage::FlaggedRow& row : content.facts.flagged)
    content.loop_reports.push_back(read_loop_report(database, row, content.facts.zone));
  return content;
}

/// A loop that has left the catalogue since the results were read has no tags any more.
storage::CatalogueEntry entry_of(const LoopsById& loops, const storage::FlaggedRow& row) {
  if (const auto found = loops.find(row.loop_id); found != loops.end()) return found->second;
  storage::CatalogueEntry gone;
  gone.loop_id = row.loop_id;
  gone.name = row.loop_name;
  gone.source = row.source;
  return gone;
}

/// Windows are read one after the other, looked at and drawn on all cores.
void illustrate_all(const config::Settings& settings, std::span<LoopReport> loop_reports,
                    const std::stop_token& stop) {
  const std::filesystem::path gnuplot = find_gnuplot();
  const LoopsById loops = catalogue_of(settings);
  WindowSource windows(settings);
  std::vector<WindowSource::Reading> readings;
  std::vector<storage::CatalogueEntry> entries;
  for (const LoopReport& loop_report : loop_reports) {
    entries.push_back(entry_of(loops, loop_report.row));
    readings.push_back(windows.read(entries.back(), loop_report.row.slot_end_us));
  }
  const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  in_threads(loop_reports.size(), threads, [&]() -> IndexedTask {
    return [&](std::size_t k) {
      add_figures(loop_reports[k], entries[k], readings[k], settings.analysis, gnuplot, stop);
    };
  });
}

void leave_without_pictures(std::span<LoopReport> loop_reports, const std::string& why) {
  for (LoopReport& loop_report : loop_reports) loop_report.trouble = why;
}

void add_event_pictures(PlantFacts& facts, bool wanted, const std::stop_token& stop) {
  EventAlbum album = event_album(facts.oscillations, facts.zone);
  if (album.figures.empty()) return;
  if (!wanted) {
    facts.picture_trouble = "none were asked for.";
    return;
  }
  const std::filesystem::path gnuplot = find_gnuplot();
  try {
    album.pictures = draw_figures(album.figures, gnuplot, stop);
    facts.album = std::move(album);
  } catch (const Failure& failure) {
    facts.picture_trouble = failure.what();
  }
}

void add_pictures(const config::Settings& settings, bool wanted,
                  std::vector<LoopReport>& loop_reports, const std::stop_token& stop) {
  const std::size_t pictured = wanted ? std::min(loop_reports.size(), kMostPictured) : 0;
  const std::span<LoopReport> all(loop_reports);
  if (pictured > 0) illustrate_all(settings, all.first(pictured), stop);
  leave_without_pictures(all.subspan(pictured),
                         wanted ? kNoRoomForPictures : "none were asked for.");
}

const std::string& pages_origin(const config::Settings& settings) {
  const std::string& own = settings.report.pages_origin;
  return own.empty() ? settings.daemon.acknowledge.origin : own;
}

void make_folder(const std::filesystem::path& folder) {
  try {
    make_folders(folder);
  } catch (const std::system_error& error) {
    throw Failure(
        ExitCode::usage,
        fmt::format("cannot make the folder {}: {}", folder.string(), error.code().message()),
        "name a folder that exists or can be made");
  }
}

}  // namespace

ReportResult write_report(const config::Settings& settings, const ReportOptions& options,
                          const std::stop_token& stop) {
  const auto engine = options.pdf ? std::optional(find_pdf_engine()) : std::nullopt;
  Content content = read_content(settings, options.since_us);
  add_pictures(settings, options.pictures, content.loop_reports, stop);
  add_event_pictures(content.facts, options.pictures, stop);
  if (stop.stop_requested())
    throw Failure(ExitCode::fault, "stopped before the report was made", "make it again");
  const ReportPage page = report_page(content.facts, content.loop_reports, pages_origin(settings));
  const std::string pdf = engine ? make_pdf(page.html, *engine, stop) : "";
  make_folder(options.folder);
  ReportResult result;
  const auto write = [&](const char* ending, const std::string& text) {
    result.files.push_back(options.folder / (options.name + ending));
    write_file(result.files.back(), text);
  };
  // The page last: a report whose page is there is complete, and the daemon makes no other.
  if (options.pdf) write(".pdf", pdf);
  write(".html", page.html);
  result.flagged = content.facts.flagged.size();
  result.sections = page.sections;
  result.unpictured = page.sections - page.pictured;
  for (const LoopReport& loop_report : content.loop_reports) {
    if (loop_report.trouble.empty()) continue;
    result.first_trouble = loop_report.trouble;
    break;
  }
  return result;
}

}  // namespace loopscope::daemon
