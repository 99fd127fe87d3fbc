#pragma once

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

 private:
  Session& session_;
  std::unique_ptr<CheckedTransaction> reading_;
};

}  // namespace loopscope::storage
