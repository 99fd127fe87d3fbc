#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "storage/historian/resolve_layout.hpp"

/// The parts that the statements on a historian's rows are put together of. The table is h, the
/// scans that are asked for are `request`.
namespace loopscope::storage::historian_statements {

/// The eight-byte type that native_time reads.
[[nodiscard]] std::string native(const ResolvedLayout& layout);

/// The time as that type.
[[nodiscard]] std::string time_sql(const ResolvedLayout& layout);
/// The same of another expression than the column, without nanoseconds.
[[nodiscard]] std::string time_sql(const ResolvedLayout& layout, const std::string& time);

/// A bound in the column's own type: a conversion of the column would keep its index from use.
[[nodiscard]] std::string bound_sql(const ResolvedLayout& layout, const std::string& bound);

/// $number::type
[[nodiscard]] std::string parameter(std::size_t number, const std::string& type);

/// "h"."key" = request.k0 AND ...
[[nodiscard]] std::string key_is_requested(const ResolvedLayout& layout);

/// SELECT `what` of every relation, put together; " AS u" still has to follow.
[[nodiscard]] std::string all_of(const std::vector<std::string>& relations, const std::string& what,
                                 const std::string& condition);

/// `rows` (all_of) so that no order of their expressions is offered to the server that has them.
[[nodiscard]] std::string fenced(const std::string& rows);

/// A query with one row, o0: the largest time among the rows of `relations` of which `within`
/// holds, as the column has it; NULL = there is none.
[[nodiscard]] std::string largest_time(const ResolvedLayout& layout,
                                       const std::vector<std::string>& relations,
                                       const std::string& within);

/// AND ...: rows of other fields must not take the place of a scan's own. Such scans have one
/// column.
[[nodiscard]] std::string has_value(const ResolvedLayout& layout, const std::string& value);

/// The columns that rows are ordered by, as they are: o0, o1, ...
struct Order {
  std::string columns;       ///< "h.time AS o0, h.id AS o1, "
  std::string newest_first;  ///< "u.o0 DESC, u.o1 DESC"
};
[[nodiscard]] Order order_of(const ResolvedLayout& layout);

}  // namespace loopscope::storage::historian_statements
