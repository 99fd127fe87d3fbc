#include "storage/lost_session.hpp"

namespace loopscope::storage {

const char* const kPoolerHint =
    "a pooler between has to keep one session for one client: set pool_mode = session for this "
    "database in PgBouncer's settings and leave server_reset_query = DISCARD ALL, or connect past "
    "the pooler to the server itself";

std::optional<std::string> lost_setting(std::string_view message) {
  if (message.find(kCheckName) != std::string_view::npos) return "";
  const std::size_t mark = message.find(kLostMark);
  if (mark == std::string_view::npos) return std::nullopt;
  message.remove_prefix(mark + std::string_view(kLostMark).size());
  return std::string(message.substr(0, message.find(kLostMarkEnd)));
}

DatabaseError explain_lost_session(const std::string& setting, const std::string& target) {
  const std::string what = setting.empty()
                               ? "the session is no longer the one that was set up"
                               : "the session no longer has the program's setting " + setting;
  return {what + ", " + target, kPoolerHint, Remedy::reconnect, kLostSession};
}

DatabaseError lends_sessions(const std::string& what_where) {
  return {what_where, kPoolerHint, Remedy::give_up, kLostSession};
}

}  // namespace loopscope::storage
