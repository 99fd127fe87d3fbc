#include "tests/storage/results/lease_model.hpp"

#include <algorithm>

namespace loopscope::storage {

void LeaseModel::claim(const std::string& worker) {
  // A lease that ended without a word is a failure.
  if (!owner.empty()) ++attempts;
  lost_leases = lost();
  owner = worker;
  visible = false;
  ++fence;
}

bool LeaseModel::complete(const CompletedLoop& done, WriteCount& count) {
  if (done.fence != fence) {
    ++count.fenced_off;
    return false;
  }
  owner.clear();
  visible = false;
  attempts = lost_leases = 0;
  last_slot_us = std::max(last_slot_us.value_or(done.slot_end_us), done.slot_end_us);
  if (!done.record) {
    ++count.unchanged;
    return true;
  }
  const auto [row, is_new] = rows.try_emplace(done.slot_end_us, Row{done.record->input_digest, 1});
  if (is_new) {
    ++count.inserted;
  } else if (row->second.digest == done.record->input_digest) {
    ++count.unchanged;
  } else {
    row->second = {done.record->input_digest, row->second.input_revision + 1};
    ++count.revised;
  }
  return true;
}

bool LeaseModel::fail(std::int64_t claimed_with, WriteCount& count) {
  if (claimed_with != fence) {
    ++count.fenced_off;
    return false;
  }
  // A repeat finds no owner and is no second failure.
  if (!owner.empty()) ++attempts;
  lost_leases = 0;
  owner.clear();
  visible = false;
  ++count.failed;
  return true;
}

void LeaseModel::release(std::int64_t claimed_with) {
  if (claimed_with != fence || owner.empty()) return;
  owner.clear();
  visible = true;
}

void LeaseModel::rest() {
  owner.clear();
  visible = false;
  ++attempts;
  ++lost_leases;
}

tests::TextRows schedule_rows(const LeaseModels& loops) {
  tests::TextRows rows;
  for (const auto& [loop_id, loop] : loops) {
    rows.push_back({std::to_string(loop_id), std::to_string(loop.fence),
                    loop.owner.empty() ? "NULL" : loop.owner, loop.visible ? "t" : "f",
                    std::to_string(loop.attempts), std::to_string(loop.lost_leases),
                    loop.last_slot_us ? std::to_string(*loop.last_slot_us) : "NULL"});
  }
  return rows;
}

tests::TextRows analysis_rows(const LeaseModels& loops) {
  tests::TextRows rows;
  for (const auto& [loop_id, loop] : loops) {
    for (const auto& [slot_end_us, row] : loop.rows) {
      const std::string revision = std::to_string(row.input_revision);
      rows.push_back({std::to_string(loop_id), std::to_string(slot_end_us), row.digest, revision,
                      revision, "t"});
    }
  }
  return rows;
}

}  // namespace loopscope::storage
