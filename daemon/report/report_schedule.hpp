#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "config/settings.hpp"
#include "daemon/service/observe/fault_log.hpp"

namespace loopscope::daemon {

/// Others may write the reports, but not hold the folder's lock for ever. Of one thread.
class LockPatience {
 public:
  /// Throws Failure (usage) once it was never free for `every_s`.
  void was_taken(const config::ReportSettings& report);
  void was_free() { taken_since_.reset(); }

 private:
  std::optional<std::chrono::steady_clock::time_point> taken_since_;
};

/// Writes a report into `/report/folder` every `/report/every_s`, on a thread of low priority and
/// connections of its own, and keeps the last `/report/keep` of them. The files are named by the
/// end of their span, so that of several workers with one folder only one writes each: who finds
/// the file there, or the folder's lock taken, has nothing to do. A report that failed is tried
/// again, and the fault said once, as is a lock that is not free for a whole period.
class ReportSchedule {
 public:
  ReportSchedule(std::shared_ptr<const config::Settings> settings, FaultLog& faults);
  /// What is being written is told to stop, and awaited.
  ~ReportSchedule() = default;
  ReportSchedule(const ReportSchedule&) = delete;
  ReportSchedule& operator=(const ReportSchedule&) = delete;

  /// These settings from the next report on. Thread-safe.
  void use(std::shared_ptr<const config::Settings> settings);

 private:
  void run(const std::stop_token& stop);
  void write_due(const config::Settings& settings, const std::stop_token& stop);

  FaultLog& faults_;
  LockPatience lock_;
  std::mutex mutex_;  ///< over settings_
  std::condition_variable_any changed_;
  std::shared_ptr<const config::Settings> settings_;
  std::jthread thread_;  // last: it ends before what it uses
};

/// "loopscope-2026-03-01T0600Z": the name of the report whose span ends then, without ending.
[[nodiscard]] std::string report_name(std::int64_t end_us);

/// Removes all but `keep` (>= 1) reports of a folder, pages and PDFs: `newest` and those before it.
/// Reports of later times, which a clock that was ahead has named, neither count nor go; files of
/// other names stay. What cannot be removed is said and left. Links to the folder are followed as
/// follow() does, and it throws as that does.
void drop_old_reports(const std::filesystem::path& folder, int keep, const std::string& newest);

}  // namespace loopscope::daemon
