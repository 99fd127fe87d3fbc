#include "daemon/report/sections/loop_request.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "daemon/report/text/html_text.hpp"

namespace loopscope::daemon {
namespace {

/// Every link of a page repeats them; no area of a plant has a longer name.
constexpr std::size_t kLongestWords = 300;
/// More rows than any catalogue has.
constexpr std::int64_t kLastPage = 1'000'000;

std::int64_t page_number(const std::string& text) {
  std::int64_t number = 1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return std::clamp<std::int64_t>(number, 1, kLastPage);
}

/// Whole characters.
std::string in_few_bytes(const std::string& text) {
  std::size_t end = std::min(text.size(), kLongestWords);
  const auto continues = [&](std::size_t at) { return (text[at] & '\xC0') == '\x80'; };
  while (end > 0 && end < text.size() && continues(end)) --end;
  return text.substr(0, end);
}

}  // namespace

std::string name(LoopOrder order) {
  return loop_orders().at(static_cast<std::size_t>(order));
}

LoopQuery loop_query(const std::multimap<std::string, std::string>& query) {
  const auto value = [&](const std::string& key) {
    const auto found = query.find(key);
    return found == query.end() ? std::string() : found->second;
  };
  LoopQuery asked;
  asked.part = in_few_bytes(value("q"));
  asked.area = in_few_bytes(value("area"));
  asked.unit = in_few_bytes(value("unit"));
  asked.verdict = in_few_bytes(value("verdict"));
  asked.state = in_few_bytes(value("state"));
  const std::vector<std::string>& orders = loop_orders();
  const auto order = std::ranges::find(orders, value("order"));
  if (order != orders.end()) asked.order = static_cast<LoopOrder>(order - orders.begin());
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
