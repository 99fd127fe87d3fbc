#include "tests/fuzz/wire.hpp"

#include <new>
#include <string>

namespace loopscope::tests::fuzz {
namespace {

template <typename Number>
void append(Bytes& bytes, Number value) {
  for (std::size_t shift = sizeof value * 8; shift > 0; shift -= 8)
    bytes.push_back(static_cast<std::byte>(value >> (shift - 8) & 0xFF));
}

void set_columns(PGresult* result, std::size_t columns) {
  std::string name = "c";
  std::vector<PGresAttDesc> described(
      columns, {name.data(), 0, 0, /* binary */ 1, /* any type */ 17, -1, -1});
  if (PQsetResultAttrs(result, static_cast<int>(columns), described.data()) == 0)
    throw std::bad_alloc();
}

void set_cell(PGresult* result, std::size_t row, std::size_t column, const Cell& cell) {
  Bytes bytes = cell.value_or(Bytes{});
  // libpq takes a null pointer for NULL.
  bytes.reserve(1);
  const int length = cell ? static_cast<int>(bytes.size()) : -1;
  if (PQsetvalue(result, static_cast<int>(row), static_cast<int>(column),
                 reinterpret_cast<char*>(bytes.data()), length) == 0)
    throw std::bad_alloc();
}

}  // namespace

Bytes value_bytes(std::uint64_t value) {
  Bytes bytes;
  append(bytes, value);
  return bytes;
}

Bytes array_bytes(storage::ElementType type, std::span<const std::uint64_t> values,
                  std::uint64_t null_bits) {
  Bytes bytes;
  append<std::uint32_t>(bytes, values.empty() ? 0 : 1);
  append<std::uint32_t>(bytes, 0);
  append(bytes, static_cast<std::uint32_t>(type));
  if (values.empty()) return bytes;
  append(bytes, static_cast<std::uint32_t>(values.size()));
  append<std::uint32_t>(bytes, 1);
  for (const std::uint64_t value : values) {
    append<std::uint32_t>(bytes, value == null_bits ? 0xFFFFFFFFU : 8U);
    if (value != null_bits) append(bytes, value);
  }
  return bytes;
}

storage::PqRows answer(std::span<const std::vector<Cell>> rows) {
  PGresult* result = PQmakeEmptyPGresult(nullptr, PGRES_TUPLES_OK);
  storage::PqRows owner(result);
  if (result == nullptr) throw std::bad_alloc();
  if (rows.empty()) return owner;
  set_columns(result, rows.front().size());
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t column = 0; column < rows.front().size(); ++column)
      set_cell(result, row, column, rows[row].at(column));
  return owner;
}

}  // namespace loopscope::tests::fuzz
