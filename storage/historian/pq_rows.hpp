#pragma once

#include <cstddef>
#include <libpq-fe.h>
#include <memory>
#include <span>
#include <string>

namespace loopscope::storage {

struct PqDelete {
  void operator()(PGconn* connection) const { PQfinish(connection); }
  void operator()(PGresult* result) const { PQclear(result); }
  void operator()(char* text) const { PQfreemem(text); }
};

/// Rows of a statement. Row and column count from 0.
class PqRows {
 public:
  explicit PqRows(PGresult* result) : result_(result) {}
  /// Whether there is an answer at all.
  explicit operator bool() const { return result_ != nullptr; }
  [[nodiscard]] ExecStatusType status() const { return PQresultStatus(result_.get()); }
  /// Of an answer that is an error; the SQLSTATE is empty when libpq itself made it.
  [[nodiscard]] std::string message() const;
  [[nodiscard]] std::string sqlstate() const;

  [[nodiscard]] int size() const { return PQntuples(result_.get()); }
  [[nodiscard]] int columns() const { return PQnfields(result_.get()); }
  [[nodiscard]] bool is_null(int row, int column) const {
    return PQgetisnull(result_.get(), row, column) != 0;
  }
  /// The value as it was sent: text, or binary when the statement was run so; empty for NULL. Valid
  /// as long as this object.
  [[nodiscard]] std::span<const std::byte> bytes(int row, int column) const;
  /// The same of text; "" for NULL.
  [[nodiscard]] std::string text(int row, int column) const;
  /// Rows that an INSERT, DELETE or COPY wrote.
  [[nodiscard]] std::size_t affected() const;

 private:
  std::unique_ptr<PGresult, PqDelete> result_;
};

}  // namespace loopscope::storage
