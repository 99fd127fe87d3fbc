#include "tests/support/login_session.hpp"

#include <libpq-fe.h>
#include <stdexcept>

namespace loopscope::tests {

void LoginSession::Close::operator()(pg_conn* connection) const {
  PQfinish(connection);
}

LoginSession::LoginSession(const std::string& conninfo)
    : connection_(
          PQconnectdb((conninfo + " options='-c client_min_messages=error -c lock_timeout=1s'"
                                  " application_name=attempt")
                          .c_str())) {
  if (PQstatus(connection_.get()) != CONNECTION_OK)
    throw std::runtime_error(PQerrorMessage(connection_.get()));
}

std::string LoginSession::state_of(const std::string& command) const {
  const std::string state = state_of_bare("BEGIN; " + command + "; ROLLBACK");
  if (!state.empty()) PQclear(PQexec(connection_.get(), "ROLLBACK"));
  return state;
}

std::string LoginSession::state_of_bare(const std::string& command) const {
  PGresult* result = PQexec(connection_.get(), command.c_str());
  const ExecStatusType status = PQresultStatus(result);
  const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const std::string found = state != nullptr              ? state
                            : status == PGRES_FATAL_ERROR ? "connection"
                                                          : "";
  PQclear(result);
  // A command may have begun a COPY: end it, so that the next one is heard.
  if (status == PGRES_COPY_IN || status == PGRES_COPY_OUT || status == PGRES_COPY_BOTH)
    PQputCopyEnd(connection_.get(), "not meant");
  while ((result = PQgetResult(connection_.get())) != nullptr) PQclear(result);
  return found;
}

}  // namespace loopscope::tests
