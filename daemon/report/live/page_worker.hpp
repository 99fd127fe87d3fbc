#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "daemon/monitor/http_answer.hpp"

namespace loopscope::daemon {

/// Makes pages that take more than milliseconds, one at a time, on one thread of low priority, so
/// that readers do not disturb the analysis. A page is compressed when it is made, once for all its
/// readers, and handed out again while it is fresh. Thread-safe; nobody waits here but the thread.
class PageWorker {
 public:
  using Make = std::function<HttpAnswer(const std::stop_token&)>;
  using Clock = std::chrono::steady_clock;

  struct Limits {
    Clock::duration freshness = std::chrono::seconds(5);  ///< of a page that is handed out again
    /// Readers that wait at a time: half of the connections that one address may have, so that
    /// others of that address (a proxy, this host) get theirs (ConnectionTable).
    std::size_t most_waiting = 128;
    Clock::duration pause = std::chrono::seconds(1);  ///< after which nobody is expected at once
  };

  PageWorker() : PageWorker(Limits{}) {}
  /// `between`: what is done after every pause in which nobody waited, and as often as pages are
  /// made anew where there is none, on the same thread; it must not throw, and lives as long as
  /// this.
  explicit PageWorker(Limits limits, std::function<void()> between = {});
  /// What is being made is told to stop, and awaited.
  ~PageWorker() = default;
  PageWorker(const PageWorker&) = delete;
  PageWorker& operator=(const PageWorker&) = delete;

  /// Replies with the page `key`, made by `make` unless it is at hand; with 503 and Retry-After
  /// when too many wait. A page that is being made when its last reader goes is finished all the
  /// same, and there when it is asked for again. What `make` throws becomes 500 and a line of the
  /// log.
  void answer(const std::string& key, const Make& make, const HttpReply& reply);
  /// What is at hand is handed out no more, and who asks from now on gets a page that was begun
  /// from now on.
  void forget_pages();

 private:
  using Answer = std::shared_ptr<const HttpAnswer>;
  struct Page {
    Answer answer;
    Clock::time_point made_at;
  };
  struct Reader {
    std::string key;
    Make make;
    HttpReply reply;
    std::uint64_t edition = 0;  ///< in which it was asked
  };

  [[nodiscard]] const Page* at_hand(const std::string& key) const;
  void forget_readers_that_left();
  void keep(const std::string& key, Answer answer);
  /// To those who asked in this edition, or before it.
  void hand_out(const std::string& key, const Answer& answer, std::uint64_t edition);
  void run(const std::stop_token& stop);
  void make_next(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);

  Limits limits_;
  std::function<void()> between_;
  std::mutex mutex_;  ///< over all below
  std::condition_variable_any changed_;
  std::map<std::string, Page> pages_;
  std::vector<Reader> waiting_;  ///< who came first is first
  std::uint64_t edition_ = 0;    ///< how often pages were forgotten
  std::jthread thread_;          // last: it ends before what it uses
};

}  // namespace loopscope::daemon
