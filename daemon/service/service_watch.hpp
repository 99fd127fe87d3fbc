#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "config/http_address.hpp"
#include "config/settings.hpp"
#include "daemon/monitor/health.hpp"
#include "daemon/monitor/http_server.hpp"
#include "daemon/report/live/live_pages.hpp"
#include "daemon/report/report_schedule.hpp"
#include "daemon/service/heartbeat.hpp"
#include "daemon/service/shared/shared_services.hpp"

namespace loopscope::daemon {

/// What others see of the daemon: its HTTP pages and reports, its state for systemd, and the state
/// of the schedule, asked for once a poll on a thread and a connection of its own. The watchdog is
/// fed by pulse() alone, which the scheduling thread calls, and only while heartbeat and workers
/// get on.
class ServiceWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// An HTTP address that cannot be had is a fault for the log: the work goes on without.
  ServiceWatch(std::shared_ptr<const config::Settings> settings, SharedServices& tools,
               Heartbeat& heartbeat);
  ~ServiceWatch();

  /// These settings from now on; the HTTP address stays. Thread-safe.
  void use(std::shared_ptr<const config::Settings> settings);
  /// The scheduling thread is at work: once a second.
  void pulse();
  /// A stop was requested, and what is in hand is finished: systemd is asked for patience at every
  /// pulse.
  void stopping();

 private:
  [[nodiscard]] std::optional<std::string> why_not_live();
  [[nodiscard]] double silence_s();
  void open_pages();
  void run(const std::stop_token& stop);
  void look(ResultsLink& link, const config::Settings& settings);
  void recall_stray(ResultsLink& link, double settle_s);
  void look_at_plant(ResultsLink& link);
  [[nodiscard]] std::shared_ptr<const config::Settings> settings();

  SharedServices& tools_;
  Heartbeat& heartbeat_;
  std::mutex mutex_;  ///< over settings_ and pulsed_at_
  std::shared_ptr<const config::Settings> settings_;
  Clock::time_point pulsed_at_ = Clock::now();
  Clock::time_point stopping_since_;             ///< the scheduling thread's
  std::optional<Clock::time_point> plant_seen_;  ///< the own thread's
  std::condition_variable_any changed_;
  Health health_;
  LivePages pages_;
  std::optional<HttpServer> server_;
  ReportSchedule reports_;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace loopscope::daemon
