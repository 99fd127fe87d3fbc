#include "daemon/monitor/http_routes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::Pair;

HttpHandler saying(const std::string& words) {
  return [words](const HttpRequest&) { return HttpAnswer{200, words}; };
}

std::string body(const HttpRoutes& routes, const std::string& path) {
  return routes.answer("GET", {path, {}}).body;
}

TEST(HttpRoutes, ExactPathGoesBeforePrefixAndLongPrefixBeforeShort) {
  HttpRoutes routes;
  routes.add_below("/loop/", saying("loop"));
  routes.add_below("/loop/list/", saying("list"));
  routes.add_below("/loop/list", saying("shorter"));
  routes.add("/loop/list/all", saying("all"));
  EXPECT_EQ(body(routes, "/loop/x"), "loop");
  EXPECT_EQ(body(routes, "/loop/list/x"), "list");
  EXPECT_EQ(body(routes, "/loop/list/all"), "all");
  EXPECT_EQ(body(routes, "/loop/list/all/"), "list");
}

TEST(HttpRoutes, WhatHasNoHandlerIsNotThere) {
  HttpRoutes routes;
  routes.add("/a", saying("a"));
  routes.add_below("/b/", saying("b"));
  for (const char* path : {"", "/", "/A", "/a/", "/ab", "/b", "a"})
    EXPECT_EQ(routes.answer("GET", {path, {}}).status, 404) << path;
}

TEST(HttpRoutes, OnlyReadingIsAllowedWhateverThePath) {
  HttpRoutes routes;
  routes.add("/a", saying("a"));
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "get", ""}) {
    const HttpAnswer answer = routes.answer(method, {"/a", {}});
    EXPECT_EQ(answer.status, 405) << method;
    EXPECT_THAT(answer.headers, ElementsAre(Pair("Allow", "GET, HEAD")));
  }
  EXPECT_EQ(routes.answer("HEAD", {"/a", {}}).status, 200);
}

TEST(HttpRoutes, FaultOfAHandlerKeepsItsWords) {
  HttpRoutes routes;
  routes.add("/a", [](const HttpRequest&) -> HttpAnswer { throw std::runtime_error("secret"); });
  const HttpAnswer answer = routes.answer("GET", {"/a", {}});
  EXPECT_EQ(answer.status, 500);
  EXPECT_EQ(answer.body.find("secret"), std::string::npos);
}

}  // namespace
}  // namespace loopscope::daemon
