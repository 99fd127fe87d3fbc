#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan.hpp"
#include "storage/historian/scan_statements.hpp"

namespace loopscope::storage {

/// When a batch of scans is one pass over the table instead of one index scan a key.
///
/// A historian appends: the samples of one tag lie on a page each, and an index on (tag, time) that
/// does not hold the values fetches all of those pages for every tag anew. Where tags are many to a
/// page, a bitmap of all keys' rows fetches each page once. The planner knows which it is: it is
/// asked, and believed where it would go by bitmaps and expects no more rows than the scans want.
class HeapOrder {
 public:
  /// Whether scans of one span can be read so at all: eight of them at least, each of 256 rows or
  /// more, keys of one part, nothing but the time to order rows by.
  [[nodiscard]] static bool fits(const std::vector<Scan>& batch, const ResolvedLayout& layout);

  /// Whether the planner would; `parameters` as heap_order_parameters() makes them. Asks once in 64
  /// calls: statistics change slowly. Throws DatabaseError.
  [[nodiscard]] bool is_better(PqConnection& connection, const Statement& plan,
                               const std::vector<Scan>& batch,
                               const std::vector<std::string>& parameters);

  /// Not for a while: a key has more rows than its scan wants, and only an index tells which are
  /// the newest.
  void give_up(const Statement& plan);

 private:
  struct Answer {
    bool better = false;
    int uses_left = 0;
  };
  std::map<std::string, Answer> answers_;  ///< by statement
};

/// The scans in groups of one span each, by span; within one in their order.
[[nodiscard]] std::vector<std::vector<Scan>> by_span(std::vector<Scan> scans);

/// Parameters of read_in_heap_order() for a batch (not empty) of one span that fits().
[[nodiscard]] std::vector<std::string> heap_order_parameters(const std::vector<Scan>& batch,
                                                             const ResolvedLayout& layout);

}  // namespace loopscope::storage
