#include "storage/results/session/session.hpp"

#include "storage/connection_settings.hpp"
#include "storage/results/session/schema_owner.hpp"

namespace loopscope::storage {
namespace {

pqxx::connection connect(const ConnectionSettings& settings, const ErrorPlace& place) {
  try {
    return pqxx::connection(complete_conninfo(settings));
  } catch (const pqxx::failure& error) {
    throw explain({error.what(), "", true}, place);
  }
}

std::vector<std::string> first_row(const pqxx::result& rows) {
  std::vector<std::string> columns;
  if (rows.empty()) return columns;
  for (const pqxx::field& field : rows.front()) columns.emplace_back(field.c_str());
  return columns;
}

}  // namespace

pqxx::result Transaction::run(const Statement& statement,
                              const std::vector<std::string>& parameters) {
  statement_ = statement.name;
  deadline_.restart();
  const pqxx::result result = execute(statement, parameters);
  check_rows(statement, result.size());
  return result;
}

pqxx::result Transaction::execute(const Statement& statement,
                                  const std::vector<std::string>& parameters) {
  keep_plans(statement.kept == Kept::plan);
  const auto values = pqxx::prepare::make_dynamic_params(parameters);
  if (statement.kept == Kept::nothing) return work_.exec_params(statement.sql, values);
  work_.conn().prepare(statement.name, statement.sql);  // sent with its first use
  return work_.exec_prepared(statement.name, values);
}

/// Until the transaction ends: what the session says of plans holds for all others.
void Transaction::keep_plans(bool keep) {
  if (keeps_plans_ == keep) return;
  work_.exec(keep ? "SET LOCAL plan_cache_mode = force_generic_plan"
                  : "SET LOCAL plan_cache_mode = force_custom_plan");
  keeps_plans_ = keep;
}

void Transaction::run_script(const char* name, const char* sql) {
  statement_ = name;
  deadline_.restart();
  work_.exec(sql);
}

Session::Session(const ConnectionSettings& settings)
    : settings_(settings),
      place_{DatabaseKind::results, describe_target(settings), "", ""},
      connection_(connect(settings, place_)),
      deadline_(connection_.sock(), patience(settings),
                [this] { cancel_statement(settings_, process_); }) {
  place_.user = connection_.username();
  set_up();
  transact(enter_schema);
}

void Session::set_up() {
  const auto ask = [this](const Statement& statement) {
    return watched(statement.name, [&] {
      deadline_.restart();
      pqxx::nontransaction autocommit(connection_);
      return first_row(autocommit.exec(statement.sql));
    });
  };
  session_ = set_up_session(settings_, connection_.backendpid(), ask);
  process_ = session_.process;
}

void Session::commit(pqxx::dbtransaction& transaction) {
  statement_ = "commit";
  deadline_.restart();
  transaction.commit();
}

void Session::refuse_if_dead() const {
  if (dead_) {
    throw DatabaseError("the connection was lost before, " + place_.target,
                        "make a new one: this object must be thrown away", Remedy::reconnect);
  }
}

void Session::fail(const std::string& message, const std::string& sqlstate, bool connection_lost) {
  place_.statement = statement_;
  // Its answer may have come all the same: that the statement was cancelled.
  const bool late = deadline_.expired();
  const DatabaseError error =
      explain({late ? "the server did not answer in time" : message,
               late && sqlstate != kOutcomeUnknown ? "" : sqlstate, late || connection_lost},
              place_);
  dead_ = error.remedy() == Remedy::reconnect;
  throw error;
}

void Session::explain_current_exception() {
  try {
    throw;
  } catch (const pqxx::in_doubt_error& error) {
    fail(std::string("commit in doubt: ") + error.what(), kOutcomeUnknown, true);
  } catch (const pqxx::broken_connection& error) {
    fail(error.what(), "", true);
  } catch (const pqxx::insufficient_privilege& error) {
    // libpqxx 6.4 drops the SQLSTATE of this one and of the two further below.
    fail(error.what(), "42501", false);
  } catch (const pqxx::sql_error& error) {
    fail(error.what(), error.sqlstate(), !connection_.is_open());
  } catch (const pqxx::serialization_failure& error) {
    fail(error.what(), "40001", false);
  } catch (const pqxx::deadlock_detected& error) {
    fail(error.what(), "40P01", false);
  } catch (const pqxx::failure& error) {
    // With a dead server it may speak of something else ("Could not obtain client encoding").
    fail(error.what(), "", !connection_.is_open());
  } catch (const pqxx::conversion_error& error) {
    throw DatabaseError(
        std::string(error.what()) + ", statement " + statement_ + ", " + place_.target,
        "the schema is not the one of this program: run `loopscope migrate "
        "--config F` as the owner",
        Remedy::give_up);
  }
}

}  // namespace loopscope::storage
