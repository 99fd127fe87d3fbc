#include "tests/support/sql_connection.hpp"

#include <libpq-fe.h>
#include <stdexcept>

namespace loopscope::tests {
namespace {

using Result = std::unique_ptr<PGresult, decltype(&PQclear)>;

TextRows text_rows(const PGresult* result, const std::string& null_text) {
  TextRows rows;
  for (int row = 0; row < PQntuples(result); ++row) {
    rows.emplace_back();
    for (int column = 0; column < PQnfields(result); ++column) {
      const bool is_null = PQgetisnull(result, row, column) != 0;
      rows.back().emplace_back(is_null ? null_text : PQgetvalue(result, row, column));
    }
  }
  return rows;
}

}  // namespace

void SqlConnection::Close::operator()(pg_conn* connection) const {
  PQfinish(connection);
}

SqlConnection::SqlConnection(const std::string& conninfo)
    : connection_(PQconnectdb((conninfo + " options='-c client_min_messages=warning'").c_str())) {}

TextRows SqlConnection::run(const std::string& sql, const std::string& null_text) const {
  const Result result(PQexec(connection_.get(), sql.c_str()), &PQclear);
  const ExecStatusType status = PQresultStatus(result.get());
  if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) {
    throw std::runtime_error(PQerrorMessage(connection_.get()) + std::string("in: ") + sql);
  }
  return text_rows(result.get(), null_text);
}

bool SqlConnection::is_idle() const {
  // Takes in what the server has sent meanwhile, its farewell among it.
  return PQconsumeInput(connection_.get()) == 1 &&
         PQtransactionStatus(connection_.get()) == PQTRANS_IDLE;
}

std::string with_key(const std::string& conninfo, const std::string& key,
                     const std::string& value) {
  return conninfo + " " + key + "=" + value;
}

}  // namespace loopscope::tests
