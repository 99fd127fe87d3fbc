#include "daemon/report/live/annotate_pages.hpp"

#include <utility>

#include "daemon/report/annotate/form_gate.hpp"

namespace loopscope::daemon {

AnnotatePages::AnnotatePages(std::function<AnnotateDesk::Settings()> settings,
                             std::function<void()> written)
    : settings_(settings), desk_(std::move(settings), std::move(written)) {}

void AnnotatePages::add_to(HttpServer& server) {
  server.handle_form("/annotate", {[this] { return settings_()->daemon.acknowledge.on(); },
                                   [this](const HttpRequest& request) {
                                     return form_refusal(request, settings_()->daemon.acknowledge);
                                   },
                                   [this](const HttpRequest& request, const HttpReply& reply) {
                                     answer(request, reply);
                                   }});
}

void AnnotatePages::answer(const HttpRequest& request, const HttpReply& reply) {
  // Once more: the settings may have been read again while the form came in.
  const config::AcknowledgeSettings settings = settings_()->daemon.acknowledge;
  if (auto refusal = form_refusal(request, settings)) return reply.send(*std::move(refusal));
  const std::string user = std::get<std::string>(signed_in_user(request, settings));
  if (!queue_) queue_.emplace();
  queue_->add({user, request.method == "POST",
               [this, request, user] { return made(request, user); }, reply});
}

HttpAnswer AnnotatePages::made(const HttpRequest& request, const std::string& user) {
  const AnnotateVisitor visitor{user, request.from, request.method == "HEAD"};
  if (request.method == "POST") return desk_.take(visitor, request.body);
  const auto name = request.query.find("name");
  return desk_.show(visitor, name == request.query.end() ? "" : name->second);
}

}  // namespace loopscope::daemon
