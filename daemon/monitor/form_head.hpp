#pragma once

#include <cstddef>
#include <variant>

#include "daemon/monitor/http_answer.hpp"
#include "daemon/monitor/http_request.hpp"

namespace loopscope::daemon {

/// Of a form; what people type into one is a tenth of it.
inline constexpr std::size_t kMostFormBytes = std::size_t{8} * 1024;

/// What the head of a POST says of the form behind it.
struct FormHead {
  std::size_t bytes = 0;       ///< of the body
  bool asks_to_go_on = false;  ///< the client waits for 100 (Continue)
};

/// How long the form is, or why it is not read: 400 where its length is said twice, not as digits
/// or besides Transfer-Encoding, 411 where it is not said, 413 above kMostFormBytes, 415 where it
/// is anything but application/x-www-form-urlencoded, 417 for another expectation than 100-continue
/// (RFC 9110, 10.1.1; RFC 9112, 6.3).
[[nodiscard]] std::variant<FormHead, HttpAnswer> read_form_head(const HttpRequest& request);

}  // namespace loopscope::daemon
