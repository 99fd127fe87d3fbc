#include "daemon/report/report_schedule.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <map>
#include <regex>
#include <spdlog/spdlog.h>
#include <system_error>
#include <utility>
#include <vector>

#include "core/signal/microseconds.hpp"
#include "core/text/counted.hpp"
#include "daemon/output/followed_path.hpp"
#include "daemon/report/folder_lock.hpp"
#include "daemon/report/report.hpp"
#include "daemon/service/threads/core_gate.hpp"
#include "daemon/service/windows/slot.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/error.hpp"

namespace loopscope::daemon {
namespace {

namespace fs = std::filesystem;
using std::chrono::system_clock;

constexpr const char* kReportSubject = "report";
/// How often the clock is looked at, and how soon a report that failed is tried again.
constexpr std::chrono::minutes kLookEvery{1};

std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             system_clock::now().time_since_epoch())
      .count();
}

/// Reports by name, with all files of each.
std::map<std::string, std::vector<fs::path>> reports_in(const Descriptor& opened) {
  static const std::regex names(R"((loopscope-\d{4}-\d{2}-\d{2}T\d{4}Z)\.(html|pdf))");
  std::map<std::string, std::vector<fs::path>> reports;
  const fs::path folder = "/proc/self/fd/" + std::to_string(opened.number());
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::smatch match;
    const std::string name = entry.path().filename().string();
    if (std::regex_match(name, match, names)) reports[match[1]].push_back(entry.path());
  }
  return reports;
}

}  // namespace

std::string report_name(std::int64_t end_us) {
  const std::string time = format_time(end_us);
  return "loopscope-" + time.substr(0, 13) + time.substr(14, 2) + "Z";
}

void drop_old_reports(const fs::path& folder, int keep, const std::string& newest) {
  const Descriptor opened = open_folder(folder);
  auto reports = reports_in(opened);
  reports.erase(reports.upper_bound(newest), reports.end());
  std::size_t left = reports.size();
  for (const auto& [name, files] : reports) {  // the oldest first
    if (left-- <= static_cast<std::size_t>(keep)) break;
    for (const fs::path& file : files) {
      std::error_code error;
      if (fs::remove(file, error); error)
        spdlog::warn("an old report stays, {}: {} HINT: remove it by hand",
                     (folder / file.filename()).string(), error.message());
    }
  }
}

ReportSchedule::ReportSchedule(std::shared_ptr<const config::Settings> settings, FaultLog& faults)
    : faults_(faults), settings_(std::move(settings)) {
  // Signals are the main thread's.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void ReportSchedule::use(std::shared_ptr<const config::Settings> settings) {
  const std::lock_guard lock(mutex_);
  settings_ = std::move(settings);
  changed_.notify_all();
}

void ReportSchedule::run(const std::stop_token& stop) {
  yield_to_analysis();
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const std::shared_ptr<const config::Settings> settings = settings_;
    lock.unlock();
    try {
      if (!settings->report.folder.empty()) write_due(*settings, stop);
      faults_.recovered(kReportSubject);
    } catch (const Failure& failure) {
      if (!stop.stop_requested())
        faults_.fault(kReportSubject, std::string(failure.what()) + " HINT: " + failure.hint());
    } catch (const storage::DatabaseError& error) {
      faults_.fault(kReportSubject, std::string(error.what()) + " HINT: " + error.hint());
    } catch (const std::exception& error) {
      faults_.fault(kReportSubject, error.what());
    }
    lock.lock();
    changed_.wait_for(lock, stop, kLookEvery, [&] { return settings_ != settings; });
  }
}

void LockPatience::was_taken(const config::ReportSettings& report) {
  const auto now = std::chrono::steady_clock::now();
  if (!taken_since_) taken_since_ = now;
  if (std::chrono::duration<double>(now - *taken_since_).count() <= report.every_s) return;
  throw Failure(
      ExitCode::usage,
      fmt::format("no report was written into the folder {} for {} s: somebody else holds "
                  "the lock .loopscope-report.lock there",
                  report.folder, report.every_s),
      "look who does, e.g. with lslocks as root: a worker that hangs, or a user who may "
      "write into the folder");
}

void ReportSchedule::write_due(const config::Settings& settings, const std::stop_token& stop) {
  const config::ReportSettings& report = settings.report;
  const fs::path folder = report.folder;
  const std::int64_t end_us = floor_to_period(now_us(), report.every_s);
  const std::string name = report_name(end_us);
  const fs::path page = folder / (name + ".html");
  if (fs::exists(page)) return lock_.was_free();
  make_folders(folder);
  const FolderLock lock(folder);
  if (!lock.held()) return lock_.was_taken(report);
  lock_.was_free();
  if (fs::exists(page)) return;
  const auto span_us =
      static_cast<std::int64_t>(report.every_s * core::signal::kMicrosecondsPerSecond);
  const ReportResult result = write_report(
      settings, {.folder = folder, .name = name, .since_us = end_us - span_us, .pdf = report.pdf},
      stop);
  spdlog::info("report written: {}, {}", page.string(),
               core::text::counted(result.flagged, "flagged loop", "flagged loops"));
  drop_old_reports(folder, report.keep, name);
}

}  // namespace loopscope::daemon
