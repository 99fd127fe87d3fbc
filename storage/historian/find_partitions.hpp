#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// The tables that hold a span of time, by the historian's own list of them.
///
/// The list is the only thing to go by: a table's name says neither its span nor whose rows it
/// holds (the number in Ignition's names changes with the gateway's name). A listed table that does
/// not exist is passed over, and missing() tells of it; one that is listed twice is read once.
class Partitions {
 public:
  /// `layout.partitions` must be there. Reads the list: throws as refresh().
  Partitions(PqConnection& connection, const ResolvedLayout& layout);

  /// Reads the list again: tables come and go. Throws DatabaseError.
  void refresh();
  /// The tables that overlap a span, microseconds UTC, both ends included; quoted for SQL, by name;
  /// empty = none of them holds such rows.
  [[nodiscard]] std::vector<std::string> within(std::int64_t from_us, std::int64_t to_us) const;
  /// A listed table that does not exist.
  struct Missing {
    std::string name;
    std::int64_t from_us = 0;
    bool last = false;  ///< no other table of the list begins later: it is being written
  };
  /// Those that overlap a span, by name.
  [[nodiscard]] std::vector<Missing> missing(std::int64_t from_us, std::int64_t to_us) const;
  /// A table of the list that exists: the last one by name, which is the youngest where names hold
  /// dates. nullopt = no listed table exists.
  [[nodiscard]] std::optional<FoundRelation> any();

 private:
  struct Entry {
    std::string relation;  ///< quoted; empty = there is no such table
    std::int64_t from_us = 0;
    std::int64_t to_us = 0;
  };
  void forget_dropped();
  void take(const PqRows& rows);
  void take(const std::string& name, std::int64_t from_us, std::int64_t to_us);
  /// nullopt for a table that does not exist.
  std::optional<std::string> quoted(const std::string& name);

  PqConnection& connection_;
  ResolvedPartitions list_;
  TimeKind time_kind_;
  std::map<std::string, FoundRelation> known_;
  std::map<std::string, Entry> entries_;  ///< by name
};

}  // namespace loopscope::storage
