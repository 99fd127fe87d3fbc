#include "daemon/monitor/http_routes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>

#include "tests/daemon/monitor/reply_slot.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::Pair;

HttpHandler saying(const std::string& words) {
  return [words](const HttpRequest&) { return HttpAnswer{200, words}; };
}

HttpAnswer answer(const HttpRoutes& routes, const std::string& path,
                  const std::string& method = "GET") {
  ReplySlot slot;
  routes.answer({path, {}, method}, slot.reply());
  return slot.get();
}

TEST(HttpRoutes, WhatHasNoHandlerIsNotThere) {
  HttpRoutes routes;
  routes.add("/a", saying("a"));
  EXPECT_EQ(answer(routes, "/a").body, "a");
  for (const char* path : {"", "/", "/A", "/a/", "/ab", "/b", "a"})
    EXPECT_EQ(answer(routes, path).status, 404) << path;
}

TEST(HttpRoutes, OnlyReadingIsAllowedWhateverThePath) {
  HttpRoutes routes;
  routes.add("/a", saying("a"));
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "get", ""}) {
    const HttpAnswer refusal = answer(routes, "/a", method);
    EXPECT_EQ(refusal.status, 405) << method;
    EXPECT_THAT(refusal.headers, ElementsAre(Pair("Allow", "GET, HEAD")));
  }
  EXPECT_EQ(answer(routes, "/a", "HEAD").status, 200);
}

TEST(HttpRoutes, AFormIsThereWhileItIsOpen) {
  bool open = false;
  HttpRoutes routes;
  routes.add_form("/f", {[&] { return open; },
                         [](const HttpRequest& request) -> std::optional<HttpAnswer> {
                           if (request.from.empty()) return HttpAnswer{403, "who?"};
                           return std::nullopt;
                         },
                         [](const HttpRequest& request, const HttpReply& reply) {
                           reply.send(HttpAnswer{200, request.body});
                         }});
  HttpRequest form{"/f", {}, "POST"};
  EXPECT_FALSE(routes.takes_form(form));
  EXPECT_FALSE(routes.is_of_form({"/f", {}}));
  EXPECT_FALSE(routes.refusal(form));
  EXPECT_EQ(answer(routes, "/f").status, 404);
  EXPECT_EQ(answer(routes, "/f", "POST").status, 405);
  open = true;
  EXPECT_TRUE(routes.takes_form(form));
  EXPECT_TRUE(routes.is_of_form({"/f", {}}));
  EXPECT_FALSE(routes.is_of_form({"/g", {}}));
  EXPECT_EQ(routes.refusal(form)->status, 403);
  form.from = "::1";
  EXPECT_FALSE(routes.refusal(form));
  EXPECT_EQ(answer(routes, "/f").status, 200);
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "post", ""}) {
    form.method = method;
    EXPECT_FALSE(routes.takes_form(form)) << method;
    EXPECT_EQ(routes.refusal(form)->status, 405) << method;
  }
  EXPECT_EQ(answer(routes, "/g", "POST").status, 405);
}

TEST(HttpRoutes, FaultOfAHandlerKeepsItsWords) {
  HttpRoutes routes;
  routes.add("/a", [](const HttpRequest&) -> HttpAnswer { throw std::runtime_error("secret"); });
  const HttpAnswer fault = answer(routes, "/a");
  EXPECT_EQ(fault.status, 500);
  EXPECT_EQ(fault.body.find("secret"), std::string::npos);
}

TEST(HttpRoutes, DeferredAnswerComesWhenItIsThere) {
  HttpRoutes routes;
  std::optional<HttpReply> later;
  routes.add_deferred("/a", [&](const HttpRequest&, const HttpReply& reply) { later = reply; });
  ReplySlot slot;
  routes.answer({"/a", {}}, slot.reply());
  EXPECT_FALSE(slot.answered_within(std::chrono::milliseconds(1)));
  later->send(HttpAnswer{200, "at last"});
  EXPECT_EQ(slot.get().body, "at last");
}

}  // namespace
}  // namespace loopscope::daemon
