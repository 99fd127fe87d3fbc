#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "config/settings.hpp"
#include "daemon/service/fault_log.hpp"

namespace loopscope::daemon {

/// Writes a report into `/report/folder` every `/report/every_s`, on a thread of low priority and
/// connections of its own, and keeps the last `/report/keep` of them. The files are named by the
/// end of their span, so that of several workers with one folder only one writes each: who finds
/// the file there, or the folder's lock taken, has nothing to do. A report that failed is tried
/// again, and the fault said once.
class ReportSchedule {
 public:
  ReportSchedule(std::shared_ptr<const config::Settings> settings, FaultLog& faults);
  /// What is being written is told to stop, and awaited.
  ~ReportSchedule() = default;
  ReportSchedule(const ReportSchedule&) = delete;
  ReportSchedule& operator=(const ReportSchedule&) = delete;

  void use(std::shared_ptr<const config::Settings> settings);

 private:
  void run(const std::stop_token& stop);
  void write_due(const config::Settings& settings, const std::stop_token& stop);

  FaultLog& faults_;
  std::mutex mutex_;  ///< over settings_
  std::condition_variable_any changed_;
  std::shared_ptr<const config::Settings> settings_;
  std::jthread thread_;  // last: it ends before what it uses
};

/// "loopscope-2026-03-01T0600Z": the name of the report whose span ends then, without ending.
[[nodiscard]] std::string report_name(std::int64_t end_us);

/// Removes all but `keep` reports of a folder, pages and PDFs: `newest` and those before it.
/// Reports of later times, which a clock that was ahead has named, neither count nor go; files of
/// other names stay.
void drop_old_reports(const std::filesystem::path& folder, int keep, const std::string& newest);

}  // namespace loopscope::daemon
