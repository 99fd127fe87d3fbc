#include "daemon/monitor/http_routes.hpp"

#include <exception>
#include <spdlog/spdlog.h>
#include <utility>

#include "daemon/monitor/plain_line.hpp"

namespace loopscope::daemon {
namespace {

HttpAnswer reading_only() {
  HttpAnswer refusal{405, "only GET and HEAD\n"};
  refusal.headers.emplace("Allow", "GET, HEAD");
  return refusal;
}

HttpAnswer forms_too() {
  HttpAnswer refusal{405, "only GET, HEAD and POST\n"};
  refusal.headers.emplace("Allow", "GET, HEAD, POST");
  return refusal;
}

bool only_reads(const HttpRequest& request) {
  return request.method == "GET" || request.method == "HEAD";
}

void carry_out(const DeferredHandler& handler, const HttpRequest& request, const HttpReply& reply) {
  try {
    handler(request, reply);
  } catch (const std::exception& error) {
    constexpr std::size_t kMostPathBytes = 200;
    spdlog::error("HTTP: {}: {}", plain_line(request.path, kMostPathBytes), error.what());
    reply.send(HttpAnswer{500, "this failed: the log says why\n"});
  }
}

}  // namespace

void HttpRoutes::add(const std::string& path, HttpHandler handler) {
  add_deferred(path,
               [handler = std::move(handler)](const HttpRequest& request, const HttpReply& reply) {
                 reply.send(handler(request));
               });
}

void HttpRoutes::add_deferred(const std::string& path, DeferredHandler handler) {
  handlers_[path] = std::move(handler);
}

void HttpRoutes::add_form(const std::string& path, FormRoute form) {
  forms_[path] = std::move(form);
}

const FormRoute* HttpRoutes::open_form(const HttpRequest& request) const {
  const auto found = forms_.find(request.path);
  return found != forms_.end() && found->second.is_open() ? &found->second : nullptr;
}

bool HttpRoutes::takes_form(const HttpRequest& request) const {
  return request.method == "POST" && open_form(request) != nullptr;
}

bool HttpRoutes::is_of_form(const HttpRequest& request) const {
  return open_form(request) != nullptr;
}

std::optional<HttpAnswer> HttpRoutes::refusal(const HttpRequest& request) const {
  const FormRoute* form = open_form(request);
  if (form == nullptr) return std::nullopt;
  if (!only_reads(request) && request.method != "POST") return forms_too();
  return form->refuse(request);
}

void HttpRoutes::answer(const HttpRequest& request, const HttpReply& reply) const {
  if (const FormRoute* form = open_form(request)) return carry_out(form->answer, request, reply);
  if (!only_reads(request)) return reply.send(reading_only());
  const auto found = handlers_.find(request.path);
  if (found == handlers_.end()) return reply.send(HttpAnswer{404, "there is nothing here\n"});
  carry_out(found->second, request, reply);
}

}  // namespace loopscope::daemon
