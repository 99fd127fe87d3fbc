#pragma once

#include <string>

#include "daemon/monitor/http_answer.hpp"

namespace loopscope::daemon {

/// A page with the headers that keep it to itself: its policy, in no frame, Referrer-Policy as its
/// PageFrame says.
[[nodiscard]] HttpAnswer page_answer(int status, std::string html,
                                     const std::string& referrer = "no-referrer");

}  // namespace loopscope::daemon
