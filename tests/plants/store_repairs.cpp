#include "tests/plants/store_repairs.hpp"

#include <map>
#include <stdexcept>

#include "daemon/plant/judge_repairs.hpp"
#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::tests::repairs {
namespace {

constexpr double kLeaseS = 600.0;

/// All windows of a repair in one completion: the last one is the newest slot, the others came
/// before it.
storage::CompletedLoop completion(const storage::ClaimedLoop& claim,
                                  const DiagnosedRepair& repair) {
  storage::CompletedLoop loop;
  loop.loop_id = claim.loop.loop_id;
  loop.fence = claim.fence;
  loop.record = repair.after.back();
  loop.slot_end_us = loop.record->slot_end_us;
  loop.next_due_us = claim.database_now_us + 3'600'000'000;
  loop.revised.assign(repair.before.begin(), repair.before.end());
  loop.revised.insert(loop.revised.end(), repair.after.begin(), repair.after.end() - 1);
  return loop;
}

void write_analyses(const storage::ConnectionSettings& database,
                    std::span<const DiagnosedRepair> repairs) {
  std::map<std::string, const DiagnosedRepair*> by_name;
  for (const DiagnosedRepair& repair : repairs) by_name[repair.loop.name] = &repair;
  storage::ResultsDatabase results(database);
  std::vector<storage::CompletedLoop> completed;
  for (const storage::ClaimedLoop& claim :
       results.claim_due("plant_repairs", kLeaseS, static_cast<int>(repairs.size())))
    completed.push_back(completion(claim, *by_name.at(claim.loop.name)));
  if (completed.size() != repairs.size() ||
      results.finish(completed, {}).inserted != repairs.size())
    throw std::runtime_error("not every repair was stored");
}

}  // namespace

std::vector<storage::MaintenanceRow> store_repairs(const storage::ConnectionSettings& database,
                                                   std::span<const DiagnosedRepair> repairs) {
  std::vector<storage::CatalogueEntry> loops;
  std::vector<storage::MaintenanceEntry> work;
  for (const DiagnosedRepair& repair : repairs) {
    loops.push_back(repair.loop);
    work.push_back({repair.loop.name, repair.done_at_us, repair.event_kind, repair.work});
  }
  storage::Catalogue(database).save(loops);
  write_analyses(database, repairs);
  storage::MaintenanceLog log(database);
  if (!log.add(work).empty()) throw std::runtime_error("the log of work refused a repair");
  storage::RepairJudgements judgements(database);
  daemon::JudgedBatch batch;
  do batch = daemon::judge_some_repairs(judgements, batch.last);
  while (batch.count > 0);
  std::map<std::string, storage::MaintenanceRow> by_name;
  for (storage::MaintenanceRow& row : log.list()) by_name[row.entry.loop_name] = std::move(row);
  std::vector<storage::MaintenanceRow> rows;
  for (const DiagnosedRepair& repair : repairs) rows.push_back(by_name.at(repair.loop.name));
  return rows;
}

}  // namespace loopscope::tests::repairs
