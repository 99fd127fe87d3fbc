#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "daemon/monitor/http_answer.hpp"

namespace loopscope::daemon {

/// Requests of people who press a button, carried out one by one on a thread of low priority: what
/// is sent before what is only looked at, who came first before who came later. A user has a few
/// places, and pages leave some to forms, so that nobody keeps others from writing. Thread-safe;
/// nobody waits here but the thread.
class FormQueue {
 public:
  static constexpr std::size_t kMostWaiting = 16;
  static constexpr std::size_t kMostPagesWaiting = 12;  ///< what is only looked at
  static constexpr std::size_t kMostOfUser = 2;

  struct Request {
    std::string user;
    bool writes = false;
    std::function<HttpAnswer()> make;
    HttpReply reply;
  };

  FormQueue();
  /// What is being made is awaited; what waits is dropped.
  ~FormQueue() = default;
  FormQueue(const FormQueue&) = delete;
  FormQueue& operator=(const FormQueue&) = delete;

  /// Replies when it is its turn; at once with 429 where too many of the user's wait, with 503
  /// where too many wait in all. Whose time is over by then is not begun. What `make` throws
  /// becomes 500 and a line of the log.
  void add(Request request);

 private:
  void run(const std::stop_token& stop);
  [[nodiscard]] Request take_next();

  std::mutex mutex_;  ///< over all below
  std::condition_variable_any changed_;
  std::vector<Request> waiting_;  ///< who came first is first
  std::jthread thread_;           // last: it ends before what it uses
};

}  // namespace loopscope::daemon
