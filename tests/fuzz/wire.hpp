#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "storage/historian/binary_array.hpp"
#include "storage/historian/pq_connection.hpp"

namespace loopscope::tests::fuzz {

using Bytes = std::vector<std::byte>;

/// Eight bytes as the server sends them.
[[nodiscard]] Bytes value_bytes(std::uint64_t value);

/// A one-dimensional array as the server sends it; elements that are `null_bits` are NULL.
[[nodiscard]] Bytes array_bytes(storage::ElementType type, std::span<const std::uint64_t> values,
                                std::uint64_t null_bits);

/// A cell of an answer; nullopt = NULL.
using Cell = std::optional<Bytes>;

/// An answer as libpq holds it once it has come from the server: binary, every row as wide as the
/// first one.
[[nodiscard]] storage::PqRows answer(std::span<const std::vector<Cell>> rows);

}  // namespace loopscope::tests::fuzz
