#include "storage/results/session/snapshot.hpp"

namespace loopscope::storage {

Snapshot::Snapshot(Session& session) : session_(session) {
  session_.watched("begin", [this] {
    reading_ = std::make_unique<CheckedTransaction>(session_.connection_, kOneMoment,
                                                    session_.session_.check_sql);
  });
}

Snapshot::~Snapshot() {
  try {
    session_.watched("rollback", [this] { reading_.reset(); });
  } catch (const DatabaseError&) {
    // Nothing was written, so that nothing is lost with the connection.
  }
}

pqxx::result Snapshot::run(const Statement& statement, const std::vector<std::string>& parameters) {
  return session_.watched(statement.name, [&] {
    return Transaction(*reading_, session_.statement_, session_.deadline_)
        .run(statement, parameters);
  });
}

}  // namespace loopscope::storage
