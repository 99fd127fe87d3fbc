#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "daemon/monitor/http_request.hpp"

namespace loopscope::daemon {

struct HttpAnswer {
  int status = 200;
  std::string body;
  std::string content_type = "text/plain; charset=utf-8";
  std::multimap<std::string, std::string> headers =
      {};                    ///< more of them; of a request nothing but %XX
  std::string gzipped = {};  ///< the body once more, for who wants it so; empty = not made
};

/// An answer as it goes to one client. Bodies are shared by all clients of a page.
struct HttpMessage {
  std::string head;
  std::shared_ptr<const std::string> body;
};

/// The form that the request asks for: 406 where it wants none that there is. An answer is stored
/// by nobody (no-store), nor guessed at (nosniff), and is the last one of its connection.
[[nodiscard]] HttpMessage make_message(std::shared_ptr<const HttpAnswer> answer,
                                       const HttpRequest& request);

/// Makes `gzipped`, where that saves anything: of bodies of a kilobyte and more. Throws as gzip().
void add_gzipped(HttpAnswer& answer);

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
