#pragma once

#include <functional>
#include <map>
#include <string>

#include "daemon/monitor/http_answer.hpp"
#include "daemon/monitor/http_request.hpp"

namespace loopscope::daemon {

/// Called on the one thread that serves everybody: it has to answer within a millisecond or so.
using HttpHandler = std::function<HttpAnswer(const HttpRequest&)>;
/// The same of an answer that takes longer: returns at once, and replies later, on any thread.
using DeferredHandler = std::function<void(const HttpRequest&, const HttpReply&)>;

/// Which handler answers which path. Reading only: GET and HEAD, everything else is 405.
class HttpRoutes {
 public:
  /// `path` is decoded and has to match as a whole; of several handlers of one the last counts.
  void add(const std::string& path, HttpHandler handler);
  void add_deferred(const std::string& path, DeferredHandler handler);

  /// Never throws for a handler's sake: what one throws goes to the log, its words not to the
  /// client, who gets 500.
  void answer(const HttpRequest& request, const HttpReply& reply) const;

 private:
  std::map<std::string, DeferredHandler> handlers_;
};

}  // namespace loopscope::daemon
