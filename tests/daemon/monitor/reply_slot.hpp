#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <utility>

#include "daemon/monitor/http_answer.hpp"

namespace loopscope::daemon {

/// A client that waits for one answer, without a server.
class ReplySlot {
 public:
  [[nodiscard]] HttpReply reply() {
    return {[state = state_](std::shared_ptr<const HttpAnswer> answer) {
              if (!state->wanted.exchange(false)) return;  // the first one counts
              state->answer.set_value(std::move(answer));
            },
            std::shared_ptr<const std::atomic<bool>>(state_, &state_->wanted)};
  }
  /// Waits for it.
  [[nodiscard]] HttpAnswer get() { return *answer_.get(); }
  [[nodiscard]] bool answered_within(std::chrono::milliseconds time) const {
    return answer_.wait_for(time) == std::future_status::ready;
  }
  void leave() { state_->wanted = false; }

 private:
  struct State {
    std::atomic<bool> wanted = true;
    std::promise<std::shared_ptr<const HttpAnswer>> answer;
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
  std::future<std::shared_ptr<const HttpAnswer>> answer_ = state_->answer.get_future();
};

}  // namespace loopscope::daemon
