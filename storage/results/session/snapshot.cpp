#include "storage/results/session/snapshot.hpp"

namespace loopscope::storage {
namespace {

constexpr pqxx::result::size_type kPiece = 2000;
/// Planned for all rows, not for the first of them.
const Statement kForAllRows{"cursor_for_all_rows", "SET LOCAL cursor_tuple_fraction = 1",
                            Rows::none};
const Statement kClose{"close_cursor", "CLOSE piecewise", Rows::none};

}  // namespace

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

void Snapshot::run_by_pieces(const Statement& statement, const std::vector<std::string>& parameters,
                             const std::function<void(const pqxx::result&)>& take) {
  run(kForAllRows);
  run({statement.name, "DECLARE piecewise NO SCROLL CURSOR FOR " + statement.sql, Rows::none},
      parameters);
  const Statement next{statement.name, "FETCH " + std::to_string(kPiece) + " FROM piecewise"};
  while (true) {
    const pqxx::result piece = run(next);
    take(piece);
    if (piece.size() < kPiece) break;
  }
  run(kClose);
}

}  // namespace loopscope::storage
