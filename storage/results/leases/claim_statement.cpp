#include "storage/results/leases/claim_statement.hpp"

#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

namespace loopscope::storage {

std::optional<LastVerdict> read_last_verdict(const pqxx::row& row) {
  const auto code = core::diagnosis::verdict_code(read_text(row["last_code"]));
  if (!code) return std::nullopt;
  return LastVerdict{*code, row["last_confidence"].as<double>(), read_number(row["last_p"])};
}

ClaimedLoop read_claim(const pqxx::row& row) {
  return {read_loop(row),
          row["fence"].as<std::int64_t>(),
          row["attempts"].as<int>(),
          row["now_us"].as<std::int64_t>(),
          read_integer(row["last_slot_end_us"]),
          read_last_verdict(row),
          read_pv_past(row)};
}

std::vector<ClaimedLoop> read_claims(const pqxx::result& rows) {
  std::vector<ClaimedLoop> claimed;
  claimed.reserve(rows.size());
  for (const pqxx::row& row : rows) claimed.push_back(read_claim(row));
  return claimed;
}

}  // namespace loopscope::storage
