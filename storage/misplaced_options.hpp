#pragma once

#include <map>
#include <string>

namespace loopscope::storage {

/// Options of a connection by libpq's names.
using ConnectionOptions = std::map<std::string, std::string>;

/// Refuses what libpq would take as it is and every message would show: a connection string as the
/// name of a database, and a database, service, user or host with a password in it. None of these
/// names anything. Throws DatabaseError (give_up), which shows none of them.
void refuse_misplaced(const ConnectionOptions& options, const std::string& purpose);

}  // namespace loopscope::storage
