#include "storage/historian/pq_connection.hpp"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <new>
#include <poll.h>

#include "storage/connection_settings.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

bool is_error(ExecStatusType status) {
  return status == PGRES_FATAL_ERROR || status == PGRES_BAD_RESPONSE;
}

// Written so that no schema in the login's search path has a say in it.
const Statement kOwnSchemas{"own_schemas",
                            "SELECT pg_catalog.current_schemas(false)::pg_catalog.text", Rows::one};

std::vector<std::string> first_row(const PqRows& rows) {
  std::vector<std::string> columns;
  for (int column = 0; rows.size() > 0 && column < rows.columns(); ++column) {
    columns.push_back(rows.text(0, column));
  }
  return columns;
}

/// libpq could not keep the answer: an error of its own, without a state.
bool ran_out_of_memory(const std::string& message, const std::string& sqlstate) {
  return sqlstate.empty() && message.starts_with("out of memory");
}

}  // namespace

PqConnection::PqConnection(const ConnectionSettings& settings)
    : settings_(settings), place_{DatabaseKind::historian, describe_target(settings), "", ""} {
  connection_.reset(PQconnectdb(complete_conninfo(settings).c_str()));
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
  set_up();
}

void PqConnection::set_up() {
  // A search path that the user names in the connection string counts as the login's own.
  const bool chosen = user_settings(settings_).contains("search_path");
  if (!chosen) own_schemas_ = run(kOwnSchemas).text(0, 0);
  session_ =
      set_up_session(settings_, PQbackendPID(connection_.get()),
                     [this](const Statement& statement) { return first_row(run(statement)); });
  if (chosen) own_schemas_ = run(kOwnSchemas).text(0, 0);
}

PqRows PqConnection::run(const Statement& statement, const std::vector<std::string>& parameters,
                         ResultFormat format) {
  start_pipeline(statement, parameters, format);
  PqRows rows = finish_pipeline();
  check_rows(statement, static_cast<std::size_t>(rows.size()));
  if (told_) told_();
  return rows;
}

void PqConnection::run_by_row(const Statement& statement,
                              const std::vector<std::string>& parameters, const TakeRow& take) {
  start_pipeline(statement, parameters, ResultFormat::binary);
  std::size_t count = 0;
  std::exception_ptr thrown;
  const PqRows last = finish_pipeline([&](const PqRows& row) {
    ++count;
    if (thrown) return;
    try {
      take(row);
    } catch (...) {
      // The rest of the answer has to be fetched before the next statement.
      thrown = std::current_exception();
    }
  });
  if (thrown) std::rethrow_exception(thrown);
  // Behind the rows one by one stands an answer without any: another one would be rows that nobody
  // took, or that of the check before them.
  if (last.size() != 0) fail("the rows did not come one by one", "08P01");
  check_rows(statement, count);
  if (told_) told_();
}

void PqConnection::start_pipeline(const Statement& statement,
                                  const std::vector<std::string>& parameters, ResultFormat format) {
  start(statement);
  if (PQenterPipelineMode(connection_.get()) == 0) fail_connection();
  // One round trip and one transaction: where the check fails the server passes over the rest.
  if (!session_.check_sql.empty()) send(session_.check_sql, {}, ResultFormat::text);
  send(statement.sql, parameters, format);
  if (PQpipelineSync(connection_.get()) == 0) fail_connection();
  flush();
}

void PqConnection::send(const std::string& sql, const std::vector<std::string>& parameters,
                        ResultFormat format) {
  std::vector<const char*> values;
  for (const std::string& parameter : parameters) values.push_back(parameter.c_str());
  if (PQsendQueryParams(connection_.get(), sql.c_str(), static_cast<int>(values.size()), nullptr,
                        values.data(), nullptr, nullptr, static_cast<int>(format)) == 0) {
    fail_connection();
  }
}

void PqConnection::begin_copy(const Statement& statement) {
  start(statement);
  const std::string checked = session_.check_sql + "; " + statement.sql;
  if (PQsendQuery(connection_.get(), checked.c_str()) == 0) fail_connection();
  flush();
  const PqRows check = next_result();
  const PqRows ready = next_result();
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
  PqRows rows = next_result();
  // The protocol ends a statement with an empty result; without it the next one is refused.
  while (const PqRows rest = next_result()) {
  }
  return rows;
}

PqRows PqConnection::finish_pipeline(const TakeRow& take) {
  PqRows rows(nullptr);
  PqRows error(nullptr);
  if (take && session_.check_sql.empty()) PQsetSingleRowMode(connection_.get());
  for (ExecStatusType status = PGRES_EMPTY_QUERY; status != PGRES_PIPELINE_SYNC;) {
    PqRows answer = next_of_pipeline(take != nullptr);
    if (!answer) break;
    status = answer.status();
    if (is_error(status)) {
      if (!error) error = std::move(answer);
    } else if (status == PGRES_SINGLE_TUPLE) {
      take(answer);
    } else if (status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK) {
      rows = std::move(answer);
    }
  }
  // Leaves the connection ready for the next statement.
  PQexitPipelineMode(connection_.get());
  if (error) fail(error);
  if (!rows) fail_connection();
  return rows;
}

PqRows PqConnection::next_of_pipeline(bool by_row) {
  PqRows answer(await_result());
  if (answer) return answer;
  // Between two answers there is an empty one; a connection that broke has nothing else left. The
  // next one's form is settled now or never.
  if (by_row) PQsetSingleRowMode(connection_.get());
  return PqRows(await_result());
}

PGresult* PqConnection::await_result() {
  while (PQisBusy(connection_.get()) != 0) {
    wait(POLLIN);
    if (PQconsumeInput(connection_.get()) == 0) fail_connection();
  }
  return PQgetResult(connection_.get());
}

PqRows PqConnection::next_result() {
  PqRows result(await_result());
  if (!result || !is_error(result.status())) return result;
  // Leaves the connection ready for the next statement.
  while (const PqRows rest{await_result()}) {
  }
  fail(result);
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
    if (ready == 0) give_up();
    if (errno != EINTR) fail("the socket cannot be waited for", "08006");
  }
}

void PqConnection::give_up() {
  cancel_statement(settings_, session_.process);
  fail("the server did not answer in time", "08006");
}

void PqConnection::fail(const PqRows& error) {
  if (ran_out_of_memory(error.message(), error.sqlstate())) throw std::bad_alloc();
  fail(error.message(), error.sqlstate());
}

void PqConnection::fail(const std::string& message, const std::string& sqlstate) {
  throw explain({message, sqlstate, PQstatus(connection_.get()) != CONNECTION_OK}, place_);
}

void PqConnection::fail_connection() {
  fail(PQerrorMessage(connection_.get()), "08006");
}

}  // namespace loopscope::storage
