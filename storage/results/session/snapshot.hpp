#pragma once

#include <functional>
#include <memory>
#include <pqxx/pqxx>
#include <string>
#include <vector>

#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// One moment of the database: a read-only transaction at REPEATABLE READ that lives as long as
/// this object, on a session that does nothing else meanwhile. What it answers is as of its
/// beginning.
class Snapshot {
 public:
  /// `session` must outlive it. Throws DatabaseError, as run() does.
  explicit Snapshot(Session& session);
  ~Snapshot();
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  /// As Transaction::run. After an error no further question is answered.
  pqxx::result run(const Statement& statement, const std::vector<std::string>& parameters = {});
  /// The rows of a statement by pieces of two thousand, in their order, the first one even when it
  /// is empty: the whole answer of a large plant would take a kilobyte a row. `take` must ask
  /// nothing here; where it throws, as after an error no further question is answered.
  void run_by_pieces(const Statement& statement, const std::vector<std::string>& parameters,
                     const std::function<void(const pqxx::result&)>& take);

 private:
  Session& session_;
  std::unique_ptr<CheckedTransaction> reading_;
};

}  // namespace loopscope::storage
