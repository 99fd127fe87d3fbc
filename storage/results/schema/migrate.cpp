#include "storage/results/schema/migrate.hpp"

#include <set>

#include "storage/results/schema/brief_locks.hpp"
#include "storage/results/schema/embedded_migrations.hpp"
#include "storage/results/schema/replace_superseded.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/results/session/schema_owner.hpp"
#include "storage/results/session/schema_statements.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// This month and the next three: `maintain` may fail to run for a quarter of a year before rows
// end up in DEFAULT.
constexpr int kMonthsAhead = 4;

/// SQLSTATE unique_violation: another program made the schema while this one wanted to, and has
/// left little to do.
constexpr const char* kMadeMeanwhile = "23505";

/// Moving a month's rows out of DEFAULT or dropping a month may take longer than any query of the
/// worker is allowed to.
ConnectionSettings without_time_limit(ConnectionSettings settings) {
  settings.statement_timeout_s = 0;
  return settings;
}

/// Whether the recorded migrations are the first ones of this program's.
void check_applied(const pqxx::result& applied) {
  const auto compiled_in = embedded_migrations();
  for (const pqxx::row& row : applied) {
    const std::string name = row["name"].c_str();
    const int number = row["version"].as<int>();
    if (number > compiled_in.back().number) {
      refuse_schema("migration " + name + " is not known to this program",
                    "install the newer program");
    }
    const Migration& known =
        compiled_in[static_cast<std::size_t>(number - compiled_in.front().number)];
    if (name != known.name || row["sha256"].c_str() != std::string(known.sha256)) {
      refuse_schema(
          "migration " + name + " was applied with another text than this program's " + known.name,
          "use the program that made the schema, or start with an empty database");
    }
  }
}

std::vector<std::string> apply_pending(Transaction& transaction, std::size_t applied) {
  std::vector<std::string> names;
  for (const Migration& migration : embedded_migrations().subspan(applied)) {
    transaction.run_script(migration.name, migration.sql);
    transaction.run(statements::kRecordMigration,
                    {std::to_string(migration.number), migration.name, migration.sha256});
    names.emplace_back(migration.name);
  }
  return names;
}

std::vector<std::string> names_in(const pqxx::result& rows) {
  std::vector<std::string> names;
  for (const pqxx::row& row : rows) names.emplace_back(row["name"].c_str());
  return names;
}

std::vector<std::string> make_partitions(Transaction& transaction) {
  return names_in(transaction.run(statements::kMakePartitions, {std::to_string(kMonthsAhead)}));
}

/// Of the months before this one.
std::vector<std::string> make_past_partitions(Transaction& transaction, std::int64_t since_us) {
  return names_in(transaction.run(statements::kMakePastPartitions, {timestamp_text(since_us)}));
}

std::vector<std::string> migrate_all(Transaction& transaction) {
  transaction.run(statements::kBecomeOwner);
  if (find_schema_owner(transaction).owner.empty()) transaction.run(statements::kMakeSchema);
  transaction.run(statements::kLockSchema);
  std::size_t applied = 0;
  std::vector<std::string> names;
  if (transaction.run(statements::kHasSchema)[0][0].as<bool>()) {
    const pqxx::result rows = transaction.run(statements::kAppliedMigrations);
    if (made_by_superseded(rows)) {
      names = replace_superseded(transaction, rows);
      applied = names.size();
    } else {
      check_applied(rows);
      applied = rows.size();
    }
  }
  for (std::string& name : apply_pending(transaction, applied)) names.push_back(std::move(name));
  make_partitions(transaction);
  transaction.run(statements::kGrantRights);
  return names;
}

/// In tries that keep no reader waiting, each under a clock that is believed.
template <typename Work>
auto maintain_in_time(Session& session, const MaintenanceOrders& orders, Work work) {
  return transact_between_others(session, [&](Transaction& transaction) {
    if (orders.check) checked_clock(transaction, orders.check);
    return work(transaction);
  });
}

std::vector<std::string> expired_partitions(Transaction& transaction, const std::string& months) {
  return names_in(transaction.run(statements::kExpiredPartitions, {months}));
}

void refuse_many(const std::vector<std::string>& partitions) {
  std::set<std::string> months;
  for (const std::string& name : partitions) {
    months.insert(name.substr(name.size() - std::string("YYYY_MM").size()));
  }
  if (months.size() <= kMostMonthsAtOnce) return;
  refuse_schema(
      std::to_string(months.size()) + " months of results would be dropped at once, " +
          *months.begin() + " to " + *months.rbegin(),
      "look at the clock of the results server and at retention_months; if both are right: "
      "loopscope maintain --config F --accept-clock");
}

/// Each partition in its own transaction: its parent is locked only for that moment.
std::vector<std::string> drop_expired(Session& session, const MaintenanceOrders& orders) {
  const std::string months = std::to_string(orders.retention_months);
  std::vector<std::string> expired =
      maintain_in_time(session, orders, [&](Transaction& transaction) {
        transaction.run(statements::kBecomeOwner);
        std::vector<std::string> names = expired_partitions(transaction, months);
        if (!orders.drop_many) refuse_many(names);
        transaction.run(statements::kDeleteOldRows, {months});
        return names;
      });
  for (const std::string& name : expired) {
    maintain_in_time(session, orders, [&](Transaction& transaction) {
      transaction.run(statements::kBecomeOwner);
      transaction.run(statements::kDropPartition, {name});
    });
  }
  return expired;
}

/// What is no result goes by its own age, also where all results are kept: workers without a word
/// for a month, what stages cost two years ago.
void delete_old_notes(Session& session, const MaintenanceOrders& orders) {
  maintain_in_time(session, orders, [](Transaction& transaction) {
    transaction.run(statements::kBecomeOwner);
    transaction.run(statements::kDeleteLostWorkers);
    transaction.run(statements::kDeleteOldCosts);
  });
}

}  // namespace

int required_schema_version() {
  return embedded_migrations().back().number;
}

std::vector<std::string> migrate(const ConnectionSettings& owner) {
  Session session(without_time_limit(owner));
  try {
    return session.transact(migrate_all);
  } catch (const DatabaseError& error) {
    if (error.sqlstate() != kMadeMeanwhile) throw;
  }
  return session.transact(migrate_all);
}

MaintenanceResult maintain(const ConnectionSettings& owner, const MaintenanceOrders& orders) {
  Session session(without_time_limit(owner));
  require_schema_version(session);
  MaintenanceResult result;
  result.created = maintain_in_time(session, orders, [&](Transaction& transaction) {
    transaction.run(statements::kBecomeOwner);
    transaction.run(statements::kLockSchema);
    std::vector<std::string> names;
    if (orders.since_us) names = make_past_partitions(transaction, *orders.since_us);
    for (std::string& name : make_partitions(transaction)) names.push_back(std::move(name));
    return names;
  });
  if (orders.retention_months > 0) result.dropped = drop_expired(session, orders);
  delete_old_notes(session, orders);
  session.transact([&](Transaction& transaction) {
    const pqxx::row months = transaction.run(statements::kPartitionMonths)[0];
    result.first_month = months["first"].c_str();
    result.last_month = months["last"].c_str();
  });
  return result;
}

}  // namespace loopscope::storage
