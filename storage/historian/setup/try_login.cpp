#include "storage/historian/setup/try_login.hpp"

#include "storage/error.hpp"
#include "storage/historian/pq_connection.hpp"

namespace loopscope::storage {

LoginTrial try_login(const ConnectionSettings& settings) {
  static_cast<void>(complete_conninfo(settings));
  try {
    const PqConnection connection(settings);
    return {};
  } catch (const DatabaseError& error) {
    const bool answered = error.remedy() == Remedy::give_up;
    return {answered ? LoginTrial::State::refused : LoginTrial::State::unreachable, error.what(),
            error.hint()};
  }
}

}  // namespace loopscope::storage
