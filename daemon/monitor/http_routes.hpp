#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "daemon/monitor/http_answer.hpp"
#include "daemon/monitor/http_request.hpp"

namespace loopscope::daemon {

/// Called on the one thread that serves everybody: it has to answer within a millisecond or so.
using HttpHandler = std::function<HttpAnswer(const HttpRequest&)>;
/// The same of an answer that takes longer: returns at once, and replies later, on any thread.
using DeferredHandler = std::function<void(const HttpRequest&, const HttpReply&)>;

/// A path that people send forms to. While it is closed it is not there, and no body is read.
struct FormRoute {
  std::function<bool()> is_open;
  /// By the head alone, before anything of a body is read: an answer = refused.
  std::function<std::optional<HttpAnswer>(const HttpRequest&)> refuse;
  DeferredHandler answer;  ///< GET, HEAD, and POST with its body
};

/// Which handler answers which path. GET and HEAD, and POST to a form that is open; everything else
/// is 405.
class HttpRoutes {
 public:
  /// `path` is decoded and has to match as a whole; of several handlers of one the last counts.
  void add(const std::string& path, HttpHandler handler);
  void add_deferred(const std::string& path, DeferredHandler handler);
  void add_form(const std::string& path, FormRoute form);

  /// Whether the request sends a form to one that is open.
  [[nodiscard]] bool takes_form(const HttpRequest& request) const;
  /// Whether it asks for the page of one, or sends it.
  [[nodiscard]] bool is_of_form(const HttpRequest& request) const;
  /// What the head alone is refused for; nullopt = nothing.
  [[nodiscard]] std::optional<HttpAnswer> refusal(const HttpRequest& request) const;
  /// Never throws for a handler's sake: what one throws goes to the log, its words not to the
  /// client, who gets 500.
  void answer(const HttpRequest& request, const HttpReply& reply) const;

 private:
  [[nodiscard]] const FormRoute* open_form(const HttpRequest& request) const;

  std::map<std::string, DeferredHandler> handlers_;
  std::map<std::string, FormRoute> forms_;
};

}  // namespace loopscope::daemon
