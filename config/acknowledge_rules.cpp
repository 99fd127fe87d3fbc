#include "config/acknowledge_rules.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "config/ip_network.hpp"
#include "config/web_origin.hpp"

namespace loopscope::config {
namespace {

constexpr const char* kProxies = "/daemon/acknowledge/trusted_proxies";
constexpr const char* kOrigin = "/daemon/acknowledge/origin";
constexpr std::size_t kLongestHeader = 64;

/// What browsers, and the way through proxies, set by themselves: whoever asks would be taken for
/// whatever they say.
constexpr std::array<std::string_view, 29> kOthersHeaders = {"age",
                                                             "authorization",
                                                             "cache-control",
                                                             "connection",
                                                             "cookie",
                                                             "date",
                                                             "dnt",
                                                             "expect",
                                                             "forwarded",
                                                             "from",
                                                             "host",
                                                             "keep-alive",
                                                             "max-forwards",
                                                             "origin",
                                                             "pragma",
                                                             "priority",
                                                             "purpose",
                                                             "range",
                                                             "referer",
                                                             "te",
                                                             "trailer",
                                                             "upgrade",
                                                             "user-agent",
                                                             "via",
                                                             "x-real-ip",
                                                             "x-requested-with",
                                                             "set-cookie",
                                                             "transfer-encoding",
                                                             "upgrade-insecure-requests"};
constexpr std::array<std::string_view, 7> kOthersPrefixes = {
    "accept", "content-", "if-", "sec-", "proxy-", "access-control-", "x-forwarded-for"};

std::string small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
}

/// Without _: proxies drop such headers, or take them for the same with -.
bool may_name_a_user(const std::string& header) {
  const std::string name = small_letters(header);
  return name.size() <= kLongestHeader && std::ranges::all_of(name, is_word) &&
         std::ranges::count(kOthersHeaders, name) == 0 &&
         std::ranges::none_of(kOthersPrefixes,
                              [&](std::string_view prefix) { return name.starts_with(prefix); });
}

void check_proxies(const std::vector<std::string>& proxies, ProblemList& problems) {
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const auto network = parse_ip_network(proxies[i]);
    const std::string path = std::string(kProxies) + '/' + std::to_string(i);
    if (!network)
      problems.add_unless_refused(
          {path}, "is no address and no network",
          R"(write "127.0.0.1", "10.1.0.0/16" or "fd00:1:2::/48", no names)");
    else if (network->bits == 0 || network->contains("0.0.0.0"))
      problems.add_unless_refused({path}, "is every address: anybody could write in anybody's name",
                                  "name the addresses of the proxies that sign people in");
  }
}

void check_header(const std::string& header, ProblemList& problems) {
  if (may_name_a_user(header)) return;
  problems.add_unless_refused(
      {"/daemon/acknowledge/user_header"}, "is no header that a proxy alone sets",
      "letters, digits and -, and none that browsers send by themselves: \"X-Remote-User\"");
}

void check_origin(const std::string& origin, ProblemList& problems) {
  if (origin.empty() || is_web_origin(origin)) return;
  problems.add_unless_refused(
      {kOrigin}, "is no origin as browsers send it",
      R"(write "https://loopscope.plant.example", in small letters, without path, slash at the )"
      R"(end, and a port that is the scheme's own)");
}

void check_needs(const Settings& settings, ProblemList& problems) {
  if (settings.daemon.acknowledge.origin.empty())
    problems.add_unless_refused({kOrigin, kProxies}, "is missing, and trusted_proxies are named",
                                "the address under which people see the pages, "
                                "\"https://loopscope.plant.example\"; or no trusted_proxies");
  if (settings.results.engineer_connection.empty())
    problems.add_unless_refused(
        {"/results/engineer_connection", kProxies},
        "is missing, and /daemon/acknowledge/trusted_proxies are named",
        "what people enter on the pages is written by a login of the role loopscope_engineer, "
        "never by the owner's; or no trusted_proxies");
  if (settings.daemon.http_address.empty())
    problems.add_unless_refused({"/daemon/http_address", kProxies},
                                "is empty, and /daemon/acknowledge/trusted_proxies are named",
                                "without an address there are no pages to acknowledge from");
}

}  // namespace

void check_acknowledge(const Settings& settings, ProblemList& problems) {
  const AcknowledgeSettings& acknowledge = settings.daemon.acknowledge;
  check_proxies(acknowledge.trusted_proxies, problems);
  check_header(acknowledge.user_header, problems);
  check_origin(acknowledge.origin, problems);
  if (acknowledge.on()) check_needs(settings, problems);
}

}  // namespace loopscope::config
