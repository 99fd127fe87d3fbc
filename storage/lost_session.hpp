#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "storage/error.hpp"

namespace loopscope::storage {

/// The name of the check of a session (session_setup.hpp) is this and the number of its process:
/// the server does not know it in any other session.
inline constexpr const char* kCheckName = "loopscope_check_";

/// What the check makes the server say: the setting that does not hold stands between the two.
inline constexpr const char* kLostMark = "loopscope session lost [";
inline constexpr const char* kLostMarkEnd = "]";

/// In the place of an SQLSTATE, none of which begins like this.
inline constexpr const char* kLostSession = "LS000";

/// What the check of a session found, by the server's message in whatever language: the setting
/// that does not hold, nothing where it is another session; nullopt = the message is of something
/// else.
[[nodiscard]] std::optional<std::string> lost_setting(std::string_view message);

/// A session that was set up and is no longer the program's. Whoever connects anew finds out why.
[[nodiscard]] DatabaseError explain_lost_session(const std::string& setting,
                                                 const std::string& target);

/// A pooler that gives one client several sessions, or one to several clients, seen by `what`.
[[nodiscard]] DatabaseError lends_sessions(const std::string& what_where);

/// What to do about that.
extern const char* const kPoolerHint;

}  // namespace loopscope::storage
