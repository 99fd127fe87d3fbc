#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "config/settings.hpp"
#include "daemon/monitor/http_server.hpp"
#include "daemon/report/annotate/annotate_desk.hpp"
#include "daemon/report/annotate/form_queue.hpp"

namespace loopscope::daemon {

/// `/annotate`, where people speak of findings: while /daemon/acknowledge is off it is not there.
/// Requests are served one by one, on a thread that begins with the first (FormQueue); no page of
/// one is handed to another, and whose time was over before his turn is not served any more.
class AnnotatePages {
 public:
  /// As AnnotateDesk; `written` is called on the own thread.
  AnnotatePages(std::function<AnnotateDesk::Settings()> settings, std::function<void()> written);

  /// Adds the page to a server that has not started yet and is stopped before this ends.
  void add_to(HttpServer& server);

 private:
  void answer(const HttpRequest& request, const HttpReply& reply);
  [[nodiscard]] HttpAnswer made(const HttpRequest& request, const std::string& user);

  std::function<AnnotateDesk::Settings()> settings_;
  AnnotateDesk desk_;               ///< the queue's
  std::optional<FormQueue> queue_;  // the server's thread's; last: it ends before what it uses
};

}  // namespace loopscope::daemon
