#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "daemon/monitor/http_routes.hpp"

namespace loopscope::daemon {

/// Makes pages that take more than milliseconds, one at a time, on one thread of low priority, so
/// that readers neither disturb the analysis nor hold the few threads of the HTTP server. A page
/// that was just made is handed out again. Thread-safe.
class PageWorker {
 public:
  using Make = std::function<HttpAnswer(const std::stop_token&)>;
  using Clock = std::chrono::steady_clock;

  /// How long things last; tests shorten them.
  struct Limits {
    Clock::duration patience = std::chrono::seconds(4);   ///< of a reader
    Clock::duration freshness = std::chrono::seconds(5);  ///< of a page that is handed out again
    int most_waiting = 2;                                 ///< readers that wait at a time
  };

  PageWorker() : PageWorker(Limits{}) {}
  explicit PageWorker(Limits limits);
  /// What is being made is told to stop, and awaited.
  ~PageWorker() = default;
  PageWorker(const PageWorker&) = delete;
  PageWorker& operator=(const PageWorker&) = delete;

  /// The page `key`, made by `make` unless it is at hand. 503 with Retry-After when others are in
  /// the way or it takes too long: it is finished all the same, and there when it is asked for
  /// again. What `make` throws becomes 500 and a line of the log.
  [[nodiscard]] HttpAnswer answer(const std::string& key, const Make& make);

 private:
  struct Page {
    HttpAnswer answer;
    Clock::time_point made_at;
  };
  struct Job {
    std::string key;
    Make make;
  };

  [[nodiscard]] const Page* at_hand(const std::string& key) const;
  void keep(const std::string& key, HttpAnswer answer);
  void run(const std::stop_token& stop);

  Limits limits_;
  std::mutex mutex_;  ///< over all below
  std::condition_variable_any changed_;
  std::map<std::string, Page> pages_;
  std::optional<Job> job_;  ///< wanted, or being made
  int waiting_ = 0;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace loopscope::daemon
