#include "daemon/report/sections/loop_request.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "daemon/report/text/html_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::LoopOrder;
using storage::LoopQuery;

constexpr std::array<std::string_view, 8> kOrders{"rank",    "name",       "area",  "unit",
                                                  "verdict", "confidence", "state", "window"};
/// More rows than any catalogue has.
constexpr std::int64_t kLastPage = 1'000'000;

std::int64_t page_number(const std::string& text) {
  std::int64_t number = 1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return std::clamp<std::int64_t>(number, 1, kLastPage);
}

}  // namespace

std::string name(LoopOrder order) {
  return std::string(kOrders.at(static_cast<std::size_t>(order)));
}

LoopQuery loop_query(const std::multimap<std::string, std::string>& query) {
  const auto value = [&](const std::string& key) {
    const auto found = query.find(key);
    return found == query.end() ? std::string() : found->second;
  };
  LoopQuery asked;
  asked.part = value("q");
  asked.area = value("area");
  asked.unit = value("unit");
  asked.verdict = value("verdict");
  asked.state = value("state");
  const auto order = std::ranges::find(kOrders, value("order"));
  if (order != kOrders.end()) asked.order = static_cast<LoopOrder>(order - kOrders.begin());
  asked.backwards = value("dir") == "desc";
  asked.most = kLoopsOnPage;
  asked.skip = (page_number(value("page")) - 1) * kLoopsOnPage;
  return asked;
}

std::string loops_address(const LoopQuery& query) {
  std::string address = "/loops";
  const auto add = [&](const std::string& key, const std::string& value) {
    if (!value.empty())
      address += (address.ends_with("/loops") ? "?" : "&") + key + "=" + url_value(value);
  };
  add("q", query.part);
  add("area", query.area);
  add("unit", query.unit);
  add("verdict", query.verdict);
  add("state", query.state);
  if (query.order != LoopOrder::rank) add("order", name(query.order));
  if (query.backwards) add("dir", "desc");
  if (query.skip > 0) add("page", std::to_string(query.skip / kLoopsOnPage + 1));
  return address;
}

}  // namespace loopscope::daemon
