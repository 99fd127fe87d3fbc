#include "storage/query_once.hpp"

#include <chrono>
#include <libpq-fe.h>
#include <memory>
#include <poll.h>

namespace loopscope::storage {
namespace {

using Clock = std::chrono::steady_clock;
using Connection = std::unique_ptr<PGconn, decltype(&PQfinish)>;

// The least that libpq takes for connecting.
constexpr const char* kConnecting_s = "2";
// Whoever asks holds something up. A server that has the time answers in milliseconds.
constexpr std::chrono::milliseconds kAnswering(1000);

/// Whether something came before `until`.
bool await_input(PGconn* connection, Clock::time_point until) {
  pollfd socket{PQsocket(connection), POLLIN, 0};
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
  return left.count() > 0 && poll(&socket, 1, static_cast<int>(left.count())) > 0 &&
         PQconsumeInput(connection) == 1;
}

std::optional<std::string> first_value(const PGresult* result) {
  if (PQresultStatus(result) != PGRES_TUPLES_OK || PQntuples(result) == 0) return std::nullopt;
  return PQgetvalue(result, 0, 0);
}

}  // namespace

std::optional<std::string> query_once(const ConnectionSettings& settings, const std::string& sql) {
  const std::string conninfo =
      complete_conninfo(settings) + " connect_timeout='" + kConnecting_s + "'";
  const Connection connection(PQconnectdb(conninfo.c_str()), &PQfinish);
  if (PQsendQuery(connection.get(), sql.c_str()) == 0) return std::nullopt;
  const Clock::time_point until = Clock::now() + kAnswering;
  while (PQisBusy(connection.get()) != 0) {
    if (!await_input(connection.get(), until)) return std::nullopt;
  }
  const std::unique_ptr<PGresult, decltype(&PQclear)> result(PQgetResult(connection.get()),
                                                             &PQclear);
  return first_value(result.get());
}

}  // namespace loopscope::storage
