#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

#include "daemon/monitor/http_answer.hpp"

namespace loopscope::daemon {

/// The way of an answer back to who asked; copies are the same way. The first answer counts, and
/// one for a client that has gone is dropped. Thread-safe; may outlive the server.
class HttpReply {
 public:
  using Send = std::function<void(std::shared_ptr<const HttpAnswer>)>;

  HttpReply(Send send, std::shared_ptr<const std::atomic<bool>> wanted)
      : send_(std::move(send)), wanted_(std::move(wanted)) {}

  void send(std::shared_ptr<const HttpAnswer> answer) const { send_(std::move(answer)); }
  void send(HttpAnswer answer) const {
    send(std::make_shared<const HttpAnswer>(std::move(answer)));
  }
  /// Whether somebody waits still.
  [[nodiscard]] bool wanted() const { return wanted_->load(); }

 private:
  Send send_;
  std::shared_ptr<const std::atomic<bool>> wanted_;
};

}  // namespace loopscope::daemon
