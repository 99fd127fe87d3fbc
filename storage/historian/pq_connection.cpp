#include "storage/historian/pq_connection.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <new>
#include <poll.h>

#include "storage/patience.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

std::string result_message(const PGresult* result) {
  return PQresultErrorMessage(result);
}

std::string result_sqlstate(const PGresult* result) {
  const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  return state == nullptr ? "" : state;
}

bool is_error(const PGresult* result) {
  const ExecStatusType status = PQresultStatus(result);
  return status == PGRES_FATAL_ERROR || status == PGRES_BAD_RESPONSE;
}

std::string conninfo_of(ConnectionSettings settings) {
  // It is taken over once the login's own one is known.
  settings.keep_search_path = true;
  return complete_conninfo(settings);
}

// Both are written so that no schema in the login's search path has a say in them.
const Statement kSearchPath{"search_path", R"(
    SELECT pg_catalog.current_schemas(false)::pg_catalog.text, source
    FROM pg_catalog.pg_settings WHERE name OPERATOR(pg_catalog.=) 'search_path')",
                            Rows::one};
const Statement kTakeSearchPath{
    "take_search_path", "SELECT pg_catalog.set_config('search_path', 'pg_catalog, pg_temp', false)",
    Rows::one};

/// libpq could not keep the answer: an error of its own, without a state.
bool ran_out_of_memory(const std::string& message, const std::string& sqlstate) {
  return sqlstate.empty() && message.starts_with("out of memory");
}

}  // namespace

std::span<const std::byte> PqRows::bytes(int row, int column) const {
  const char* value = PQgetvalue(result_.get(), row, column);
  const auto length = static_cast<std::size_t>(PQgetlength(result_.get(), row, column));
  return std::as_bytes(std::span(value, length));
}

std::string PqRows::text(int row, int column) const {
  return PQgetvalue(result_.get(), row, column);
}

std::size_t PqRows::affected() const {
  const char* text = PQcmdTuples(result_.get());
  std::size_t count = 0;
  std::from_chars(text, text + std::strlen(text), count);
  return count;
}

PqConnection::PqConnection(const ConnectionSettings& settings)
    : place_{DatabaseKind::historian, describe_target(settings), "", ""} {
  connection_.reset(PQconnectdb(conninfo_of(settings).c_str()));
  if (!connection_ || PQstatus(connection_.get()) != CONNECTION_OK) {
    throw explain({connection_ ? PQerrorMessage(connection_.get()) : "out of memory", "", true},
                  place_);
  }
  place_.user = PQuser(connection_.get());
  // What the server remarks beside its answers would go to standard error.
  PQsetNoticeProcessor(
      connection_.get(), [](void*, const char*) {}, nullptr);
  patience_ = patience(settings);
  PQsetnonblocking(connection_.get(), 1);
  take_search_path();
}

void PqConnection::take_search_path() {
  const PqRows own = run(kSearchPath);
  own_schemas_ = own.text(0, 0);
  const bool chosen_by_settings = own.text(0, 1) == "client";
  if (!chosen_by_settings) run(kTakeSearchPath);
}

PqRows PqConnection::run(const Statement& statement, const std::vector<std::string>& parameters,
                         ResultFormat format) {
  start(statement);
  std::vector<const char*> values;
  for (const std::string& parameter : parameters) values.push_back(parameter.c_str());
  if (PQsendQueryParams(connection_.get(), statement.sql.c_str(), static_cast<int>(values.size()),
                        nullptr, values.data(), nullptr, nullptr, static_cast<int>(format)) == 0) {
    fail_connection();
  }
  flush();
  PqRows rows = finish();
  check_rows(statement, static_cast<std::size_t>(rows.size()));
  if (told_) told_();
  return rows;
}

void PqConnection::begin_copy(const Statement& statement) {
  start(statement);
  if (PQsendQuery(connection_.get(), statement.sql.c_str()) == 0) fail_connection();
  flush();
  const PqRows ready(next_result());
}

void PqConnection::send_copy(std::string_view chunk) {
  int sent = 0;
  while ((sent = PQputCopyData(connection_.get(), chunk.data(), static_cast<int>(chunk.size()))) ==
         0) {
    wait(POLLOUT);
  }
  if (sent < 0) fail_connection();
  flush();
}

std::size_t PqConnection::end_copy() {
  while (PQputCopyEnd(connection_.get(), nullptr) == 0) wait(POLLOUT);
  flush();
  return finish().affected();
}

std::string PqConnection::quote(const std::string& name) const {
  if (!is_storable(name) || name.size() > kLongestIdentifier) {
    throw DatabaseError(
        "not a name of a table or a column: " + make_storable(name) + ", " + place_.target,
        "names are UTF-8 text of at most " + std::to_string(kLongestIdentifier) + " bytes",
        Remedy::give_up);
  }
  const std::unique_ptr<char, PqDelete> quoted(
      PQescapeIdentifier(connection_.get(), name.data(), name.size()));
  if (!quoted) {
    throw DatabaseError("not a name, " + place_.target, "names are UTF-8 text", Remedy::give_up);
  }
  return quoted.get();
}

std::string PqConnection::quote_literal(const std::string& text) const {
  const std::unique_ptr<char, PqDelete> quoted(
      PQescapeLiteral(connection_.get(), text.data(), text.size()));
  if (!quoted || !is_storable(text)) {
    throw DatabaseError("not a text, " + place_.target, "texts are UTF-8", Remedy::give_up);
  }
  return quoted.get();
}

void PqConnection::start(const Statement& statement) {
  place_.statement = statement.name;
  deadline_ = Clock::now() + patience_.value_or(std::chrono::seconds(0));
}

void PqConnection::flush() {
  int pending = 0;
  while ((pending = PQflush(connection_.get())) == 1) {
    // The server may have to be read from before it takes more.
    wait(POLLIN | POLLOUT);
    if (PQconsumeInput(connection_.get()) == 0) fail_connection();
  }
  if (pending < 0) fail_connection();
}

PqRows PqConnection::finish() {
  PqRows rows(next_result());
  // The protocol ends a statement with an empty result; without it the next one is refused.
  while (PGresult* rest = next_result()) PqRows dropped(rest);
  return rows;
}

PGresult* PqConnection::await_result() {
  while (PQisBusy(connection_.get()) != 0) {
    wait(POLLIN);
    if (PQconsumeInput(connection_.get()) == 0) fail_connection();
  }
  return PQgetResult(connection_.get());
}

PGresult* PqConnection::next_result() {
  PGresult* result = await_result();
  if (result != nullptr && is_error(result)) {
    const PqRows owner(result);
    const std::string message = result_message(result);
    const std::string sqlstate = result_sqlstate(result);
    // Leaves the connection ready for the next statement.
    while (PGresult* rest = await_result()) PQclear(rest);
    if (ran_out_of_memory(message, sqlstate)) throw std::bad_alloc();
    fail(message, sqlstate);
  }
  return result;
}

void PqConnection::wait(short events) {
  pollfd socket{PQsocket(connection_.get()), events, 0};
  while (true) {
    int timeout_ms = -1;
    if (patience_) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
      timeout_ms = static_cast<int>(std::max<std::int64_t>(left, 0));
    }
    const int ready = poll(&socket, 1, timeout_ms);
    if (ready > 0) return;
    if (ready == 0) fail("the server did not answer in time", "08006");
    if (errno != EINTR) fail("the socket cannot be waited for", "08006");
  }
}

void PqConnection::fail(const std::string& message, const std::string& sqlstate) {
  throw explain({message, sqlstate, PQstatus(connection_.get()) != CONNECTION_OK}, place_);
}

void PqConnection::fail_connection() {
  fail(PQerrorMessage(connection_.get()), "08006");
}

}  // namespace loopscope::storage
