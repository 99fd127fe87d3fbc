#include "daemon/report/annotate/form_gate.hpp"

#include <algorithm>

#include "config/ip_network.hpp"
#include "daemon/catalogue/on_behalf_of.hpp"

namespace loopscope::daemon {
namespace {

constexpr int kForbidden = 403;

HttpAnswer not_by_a_proxy() {
  return {kForbidden,
          "acknowledging works by way of the proxy that signs people in; this request did not come "
          "that way\n"
          "HINT: open the address under which these pages ask you to sign in\n"};
}

HttpAnswer nobody_named() {
  return {kForbidden,
          "the proxy did not say, once and as printable text of at most 100 bytes, who is signed "
          "in\n"
          "HINT: whoever runs the proxy: deploy/GUIDE.md, \"Acknowledging from the page\"\n"};
}

HttpAnswer from_elsewhere() {
  return {kForbidden,
          "this did not come from a page of this address, so nothing was entered\n"
          "HINT: open the page here and send it from there; where that is what you did, "
          "/daemon/acknowledge/origin is not the address that you see\n"};
}

HttpAnswer not_as_a_page() {
  return {kForbidden, "this is a page of its own, and no part of another\n"};
}

bool is_trusted(const std::string& peer, const std::vector<std::string>& proxies) {
  return std::ranges::any_of(proxies, [&](const std::string& proxy) {
    const auto network = config::parse_ip_network(proxy);
    return network && network->contains(peer);
  });
}

/// Whether the header was sent, and with anything but the value.
bool says_otherwise(const HttpRequest& request, const char* header, const char* value) {
  const std::vector<std::string> values = request.values(header);
  return std::ranges::any_of(values, [&](const std::string& one) { return one != value; });
}

}  // namespace

std::variant<std::string, HttpAnswer> signed_in_user(const HttpRequest& request,
                                                     const config::AcknowledgeSettings& settings) {
  if (!is_trusted(request.from, settings.trusted_proxies)) return not_by_a_proxy();
  const std::optional<std::string> user = request.only_value(settings.user_header);
  if (!user || user->size() > kMostUserBytes || !name_complaint(*user).empty())
    return nobody_named();
  return *user;
}

std::optional<HttpAnswer> form_refusal(const HttpRequest& request,
                                       const config::AcknowledgeSettings& settings) {
  const auto user = signed_in_user(request, settings);
  if (const auto* refusal = std::get_if<HttpAnswer>(&user)) return *refusal;
  if (says_otherwise(request, "Sec-Fetch-Dest", "document")) return not_as_a_page();
  if (request.method != "POST") return std::nullopt;
  if (settings.origin.empty() || request.only_value("Origin") != settings.origin ||
      says_otherwise(request, "Sec-Fetch-Site", "same-origin"))
    return from_elsewhere();
  return std::nullopt;
}

}  // namespace loopscope::daemon
