#pragma once

#include <optional>
#include <string>
#include <variant>

#include "config/settings.hpp"
#include "daemon/monitor/http_answer.hpp"
#include "daemon/monitor/http_request.hpp"

namespace loopscope::daemon {

/// Of a user's name as a proxy gives it.
inline constexpr std::size_t kMostUserBytes = 100;

/// Who asks: the name in the one user header of a request whose peer is a trusted proxy. Else 403
/// in plain words. What the peer says of those before it (X-Forwarded-For) counts for nothing.
[[nodiscard]] std::variant<std::string, HttpAnswer> signed_in_user(
    const HttpRequest& request, const config::AcknowledgeSettings& settings);

/// What refuses a request to the form by its head, before anything of its body is read: who asks,
/// and of a POST where it comes from, as the browser says: Origin has to be the one of the
/// settings, Sec-Fetch-Site, where it is sent, same-origin. A page is not handed out as a picture
/// or a frame (Sec-Fetch-Dest): each costs the user one of his tokens.
[[nodiscard]] std::optional<HttpAnswer> form_refusal(const HttpRequest& request,
                                                     const config::AcknowledgeSettings& settings);

}  // namespace loopscope::daemon
