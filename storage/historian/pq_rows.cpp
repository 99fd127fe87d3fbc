#include "storage/historian/pq_rows.hpp"

#include <charconv>
#include <cstring>

namespace loopscope::storage {

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

std::string PqRows::message() const {
  return PQresultErrorMessage(result_.get());
}

std::string PqRows::sqlstate() const {
  const char* state = PQresultErrorField(result_.get(), PG_DIAG_SQLSTATE);
  return state == nullptr ? "" : state;
}

}  // namespace loopscope::storage
