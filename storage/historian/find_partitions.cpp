#include "storage/historian/find_partitions.hpp"

#include <algorithm>
#include <set>

#include "storage/array_literal.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/statements.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {

Partitions::Partitions(PqConnection& connection, const ResolvedLayout& layout)
    : connection_(connection),
      list_(layout.partitions.value()),
      time_kind_(layout.layout.time_kind) {
  refresh();
}

void Partitions::refresh() {
  forget_dropped();
  run_decoded(connection_, historian_statements::list_partitions(list_, time_kind_), {},
              [this](const PqRows& rows) { take(rows); });
}

/// A table may be dropped before its line in the list is: reading it would fail.
void Partitions::forget_dropped() {
  if (known_.empty()) return;
  ArrayLiteral oids;
  for (const auto& [name, relation] : known_) oids.add_integer(relation.oid);
  const PqRows rows = connection_.run(historian_statements::kStillThere, {oids.text()});
  std::set<std::uint32_t> there;
  for (int row = 0; row < rows.size(); ++row) {
    there.insert(static_cast<std::uint32_t>(std::stoul(rows.text(row, 0))));
  }
  std::erase_if(known_, [&](const auto& known) { return !there.contains(known.second.oid); });
}

void Partitions::take(const PqRows& rows) {
  entries_.clear();
  for (int row = 0; row < rows.size(); ++row) {
    const auto time_at = [&](int column) {
      return microseconds(time_kind_, decode_value(rows.bytes(row, column)));
    };
    const std::int64_t from = rows.is_null(row, 1) ? kEarliestTimeUs : time_at(1);
    std::int64_t to = rows.is_null(row, 2) ? kLatestTimeUs : time_at(2);
    // The table that is being written may have no end yet.
    if (to < from) to = kLatestTimeUs;
    take(rows.text(row, 0), from, to);
  }
}

void Partitions::take(const std::string& name, std::int64_t from_us, std::int64_t to_us) {
  const auto [known, first] =
      entries_.try_emplace(name, Entry{quoted(name).value_or(""), from_us, to_us});
  if (first) return;
  known->second.from_us = std::min(known->second.from_us, from_us);
  known->second.to_us = std::max(known->second.to_us, to_us);
}

std::vector<std::string> Partitions::within(std::int64_t from_us, std::int64_t to_us) const {
  std::vector<std::string> relations;
  for (const auto& [name, entry] : entries_) {
    if (!entry.relation.empty() && entry.from_us <= to_us && entry.to_us >= from_us)
      relations.push_back(entry.relation);
  }
  return relations;
}

std::vector<Partitions::Missing> Partitions::missing(std::int64_t from_us,
                                                     std::int64_t to_us) const {
  std::int64_t last_us = kEarliestTimeUs;
  for (const auto& [name, entry] : entries_) last_us = std::max(last_us, entry.from_us);
  std::vector<Missing> missing;
  for (const auto& [name, entry] : entries_) {
    if (entry.relation.empty() && entry.from_us <= to_us && entry.to_us >= from_us)
      missing.push_back({name, entry.from_us, entry.from_us == last_us});
  }
  return missing;
}

std::optional<FoundRelation> Partitions::any() {
  if (known_.empty()) return std::nullopt;
  return known_.rbegin()->second;
}

std::optional<std::string> Partitions::quoted(const std::string& name) {
  auto known = known_.find(name);
  if (known == known_.end()) {
    auto found = find_relation(connection_, {list_.schema, name});
    if (!found) return std::nullopt;
    known = known_.emplace(name, *std::move(found)).first;
  }
  return known->second.sql;
}

}  // namespace loopscope::storage
