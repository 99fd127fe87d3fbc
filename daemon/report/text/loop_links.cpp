#include "daemon/report/text/loop_links.hpp"

#include <fmt/format.h>
#include <utility>

#include "daemon/report/text/html_text.hpp"

namespace loopscope::daemon {

LoopLinks LoopLinks::pages() {
  return {};
}

LoopLinks LoopLinks::sections(std::set<std::int64_t> with_section, std::string pages_address) {
  LoopLinks links;
  links.live_ = false;
  links.with_section_ = std::move(with_section);
  links.pages_address_ = std::move(pages_address);
  return links;
}

std::string LoopLinks::to_loop(std::int64_t loop_id, const std::string& loop_name) const {
  if (with_section_.contains(loop_id)) return fmt::format("#loop-{}", loop_id);
  return to_page(loop_name);
}

std::string LoopLinks::to_page(const std::string& loop_name) const {
  if (!live_ && pages_address_.empty()) return {};
  return pages_address_ + "/loop?name=" + url_value(loop_name);
}

std::string LoopLinks::to_loops(const std::string& query) const {
  if (!live_ && pages_address_.empty()) return {};
  return pages_address_ + "/loops" + query;
}

std::string annotate_link(const std::string& loop_name) {
  return "/annotate?name=" + url_value(loop_name);
}

}  // namespace loopscope::daemon
