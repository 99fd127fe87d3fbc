#include "daemon/report/sections/loop_link.hpp"

#include <fmt/format.h>

#include "daemon/report/text/html_text.hpp"

namespace loopscope::daemon {

std::string loop_link(LoopLinks links, std::int64_t loop_id, const std::string& loop_name) {
  if (links == LoopLinks::sections) return fmt::format("#loop-{}", loop_id);
  return "/loop?name=" + url_value(loop_name);
}

}  // namespace loopscope::daemon
