#include "storage/results/write_combined.hpp"

#include <algorithm>
#include <optional>
#include <pqxx/pqxx>
#include <string>
#include <tuple>

#include "core/diagnosis/combined_odds.hpp"
#include "storage/array_literal.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {
namespace {

namespace diagnosis = core::diagnosis;
using diagnosis::PerCause;

// Of each loop the slots from the first changed one on, and the combined one before them.
const Statement kWindowsToCombine{"windows_to_combine", R"(
    SELECT wanted.loop_id, (extract(epoch FROM slot.slot_end) * 1000000)::bigint AS slot_end_us,
           extract(epoch FROM slot.window_start)::float8 AS start_s,
           extract(epoch FROM slot.window_end)::float8 AS end_s,
           slot.model IS NOT NULL AS with_model, slot.is_before,
           slot.combined_windows::float8 AS windows,
           CASE WHEN slot.is_before THEN slot.combined_probabilities
                ELSE given.cause_probabilities END::text AS probabilities
    FROM unnest($1::bigint[], $3::timestamptz[], $4::timestamptz[])
      AS wanted (loop_id, first, earliest)
    CROSS JOIN LATERAL (
      (SELECT stored.*, true AS is_before FROM loopscope.analysis AS stored
       WHERE stored.loop_id = wanted.loop_id AND stored.algorithm_revision = $2::integer
         AND stored.slot_end < wanted.first AND stored.slot_end >= wanted.earliest
         AND stored.combined_windows IS NOT NULL
       ORDER BY stored.slot_end DESC LIMIT 1)
      UNION ALL
      (SELECT stored.*, false FROM loopscope.analysis AS stored
       WHERE stored.loop_id = wanted.loop_id AND stored.algorithm_revision = $2::integer
         AND stored.slot_end >= wanted.first)) AS slot
    LEFT JOIN LATERAL (
      SELECT said.cause_probabilities FROM loopscope.verdict AS said
      WHERE said.loop_id = slot.loop_id AND said.slot_end = slot.slot_end
        AND said.algorithm_revision = slot.algorithm_revision
        AND said.input_revision = slot.input_revision
      LIMIT 1) AS given ON true
    ORDER BY wanted.loop_id, slot.slot_end)"};

const Statement kSetCombined{"set_combined", R"(
    UPDATE loopscope.analysis AS stored
    SET combined_probabilities = row.probabilities::real[], combined_windows = row.windows
    FROM unnest($1::bigint[], $2::timestamptz[], $3::integer[], $4::text[], $5::float8[])
      AS row (loop_id, slot_end, algorithm_revision, probabilities, windows)
    WHERE stored.loop_id = row.loop_id AND stored.slot_end = row.slot_end
      AND stored.algorithm_revision = row.algorithm_revision)",
                             Rows::none};

/// "{0.1,NULL,...}"; no values for NULL.
PerCause read_probabilities(const pqxx::field& field) {
  PerCause values;
  if (field.is_null()) return values;
  pqxx::array_parser elements = field.as_array();
  for (auto [what, text] = elements.get_next(); what != pqxx::array_parser::done;
       std::tie(what, text) = elements.get_next()) {
    if (what == pqxx::array_parser::string_value)
      pqxx::from_string(text, values.emplace_back(0.0).value());
    else if (what == pqxx::array_parser::null_value)
      values.emplace_back(std::nullopt);
  }
  return values;
}

/// PostgreSQL refuses a real that is next to nothing.
PerCause storable(PerCause probabilities) {
  constexpr double kLeast = 1e-30;
  for (std::optional<double>& probability : probabilities)
    if (probability) probability = std::max(*probability, kLeast);
  return probabilities;
}

/// Rows of analysis to write, an array for each column.
struct CombinedRows {
  ArrayLiteral loop_id, slot_end, algorithm_revision, probabilities, windows;

  void add(const pqxx::row& row, int revision,
           const std::optional<diagnosis::CombinedOdds>& combined) {
    loop_id.add_integer(row["loop_id"].as<std::int64_t>());
    slot_end.add_time(row["slot_end_us"].as<std::int64_t>());
    algorithm_revision.add_integer(revision);
    probabilities.add_number_list(combined ? storable(combined->probabilities) : PerCause{});
    windows.add_number(combined ? std::optional(combined->windows) : std::nullopt);
  }
};

/// The slots of one loop, in their order.
class LoopWindows {
 public:
  explicit LoopWindows(const PerCause& priors) : priors_(&priors) {}

  void begin_with(const pqxx::row& row) {
    combined_ = diagnosis::CombinedOdds{row["end_s"].as<double>(), row["windows"].as<double>(),
                                        read_probabilities(row["probabilities"])};
  }

  /// nullopt where the window says nothing: it could not be judged, or holds nothing new.
  std::optional<diagnosis::CombinedOdds> next(const pqxx::row& row) {
    const diagnosis::JudgedWindow window{row["start_s"].as<double>(), row["end_s"].as<double>(),
                                         row["with_model"].as<bool>(),
                                         read_probabilities(row["probabilities"])};
    const bool is_new = !combined_ || window.end_s > combined_->end_s;
    if (window.probabilities.empty() || !(window.end_s > window.start_s)) return std::nullopt;
    if (is_new) combined_ = diagnosis::combine(combined_, window, *priors_);
    return combined_;
  }

 private:
  const PerCause* priors_;
  std::optional<diagnosis::CombinedOdds> combined_;
};

pqxx::result windows_of(Transaction& transaction, int algorithm_revision,
                        const std::map<std::int64_t, ChangedSlots>& changed) {
  ArrayLiteral loop_id, first, earliest;
  for (const auto& [id, slots] : changed) {
    loop_id.add_integer(id);
    first.add_time(slots.first_us);
    earliest.add_time(slots.earliest_us);
  }
  return transaction.run(kWindowsToCombine, {loop_id.text(), std::to_string(algorithm_revision),
                                             first.text(), earliest.text()});
}

}  // namespace

void write_combined(Transaction& transaction, int algorithm_revision,
                    const std::map<std::int64_t, ChangedSlots>& changed) {
  if (changed.empty()) return;
  CombinedRows rows;
  std::map<std::int64_t, LoopWindows> loops;
  for (const pqxx::row& row : windows_of(transaction, algorithm_revision, changed)) {
    const auto id = row["loop_id"].as<std::int64_t>();
    LoopWindows& loop = loops.try_emplace(id, changed.at(id).priors).first->second;
    if (row["is_before"].as<bool>())
      loop.begin_with(row);
    else
      rows.add(row, algorithm_revision, loop.next(row));
  }
  transaction.run(kSetCombined,
                  {rows.loop_id.text(), rows.slot_end.text(), rows.algorithm_revision.text(),
                   rows.probabilities.text(), rows.windows.text()});
}

}  // namespace loopscope::storage
