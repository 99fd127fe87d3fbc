#include "storage/results/catalogue/catalogue.hpp"

#include <unordered_set>

#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

const Statement kListLoops{"list_loops",
                           "SELECT " LOOPSCOPE_LOOP_COLUMNS " FROM loopscope.loop ORDER BY name"};

// Whoever else changes loops waits until these are saved; workers, who only refer to them, do not.
const Statement kListLoopsToChange{"list_loops_to_change",
                                   "SELECT " LOOPSCOPE_LOOP_COLUMNS
                                   " FROM loopscope.loop ORDER BY name FOR NO KEY UPDATE"};

const Statement kFindLoop{"find_loop",
                          "SELECT " LOOPSCOPE_LOOP_COLUMNS " FROM loopscope.loop WHERE name = $1"};

// xmax is 0 in a row that was inserted and the updating transaction in one that was there before.
// A row that stays as it is does not come back.
const Statement kSaveLoops{"save_loops", R"(
    INSERT INTO loopscope.loop AS kept (name, source, sp_tag, pv_tag, op_tag, mv_tag, mode_tag,
                                        interval_s, period_s, op_low, op_high, loop_type,
                                        importance, enabled, area, unit, description, pv_unit,
                                        owner, pv_low, pv_high)
    SELECT name, source, nullif(sp_tag, ''), pv_tag, nullif(op_tag, ''), nullif(mv_tag, ''),
           nullif(mode_tag, ''), interval_s, period_s, op_low, op_high, nullif(loop_type, ''),
           importance, enabled, nullif(area, ''), nullif(unit, ''), nullif(description, ''),
           nullif(pv_unit, ''), nullif(owner, ''), pv_low, pv_high
    FROM unnest($1::text[], $2::text[], $3::text[], $4::text[], $5::text[], $6::text[], $7::text[],
                $8::float8[], $9::float8[], $10::float8[], $11::float8[], $12::text[],
                $13::float8[], $14::boolean[], $15::text[], $16::text[], $17::text[], $18::text[],
                $19::text[], $20::float8[], $21::float8[])
      AS entry (name, source, sp_tag, pv_tag, op_tag, mv_tag, mode_tag, interval_s, period_s,
                op_low, op_high, loop_type, importance, enabled, area, unit, description, pv_unit,
                owner, pv_low, pv_high)
    ON CONFLICT (name) DO UPDATE SET
      source = EXCLUDED.source, sp_tag = EXCLUDED.sp_tag, pv_tag = EXCLUDED.pv_tag,
      op_tag = EXCLUDED.op_tag, mv_tag = EXCLUDED.mv_tag, mode_tag = EXCLUDED.mode_tag,
      interval_s = EXCLUDED.interval_s, period_s = EXCLUDED.period_s, op_low = EXCLUDED.op_low,
      op_high = EXCLUDED.op_high, loop_type = EXCLUDED.loop_type,
      importance = EXCLUDED.importance, enabled = EXCLUDED.enabled, area = EXCLUDED.area,
      unit = EXCLUDED.unit, description = EXCLUDED.description, pv_unit = EXCLUDED.pv_unit,
      owner = EXCLUDED.owner, pv_low = EXCLUDED.pv_low, pv_high = EXCLUDED.pv_high,
      changed_at = now()
    WHERE
      (kept.source, kept.sp_tag, kept.pv_tag, kept.op_tag, kept.mv_tag, kept.mode_tag,
       kept.interval_s, kept.period_s, kept.op_low, kept.op_high, kept.loop_type,
       kept.importance, kept.enabled, kept.area, kept.unit, kept.description, kept.pv_unit,
       kept.owner, kept.pv_low, kept.pv_high)
      IS DISTINCT FROM
      (EXCLUDED.source, EXCLUDED.sp_tag, EXCLUDED.pv_tag, EXCLUDED.op_tag, EXCLUDED.mv_tag,
       EXCLUDED.mode_tag, EXCLUDED.interval_s, EXCLUDED.period_s, EXCLUDED.op_low,
       EXCLUDED.op_high, EXCLUDED.loop_type, EXCLUDED.importance, EXCLUDED.enabled,
       EXCLUDED.area, EXCLUDED.unit, EXCLUDED.description, EXCLUDED.pv_unit, EXCLUDED.owner,
       EXCLUDED.pv_low, EXCLUDED.pv_high)
    RETURNING kept.xmax = 0 AS is_new)"};

const Statement kSetEnabled{"set_enabled", R"(
    UPDATE loopscope.loop SET enabled = $2::boolean, changed_at = now()
    WHERE name = ANY ($1::text[]) AND enabled <> $2::boolean RETURNING loop_id)"};

// A loop that a worker holds becomes due when the worker is done with it.
const Statement kMakeDue{"make_due", R"(
    UPDATE loopscope.schedule SET visible_at = now()
    WHERE owner IS NULL
      AND loop_id = ANY (ARRAY(SELECT loop_id FROM loopscope.loop WHERE name = ANY ($1::text[]))))",
                         Rows::none};

/// What the arrays would silently change or PostgreSQL would refuse in words that name no loop.
void check_entries(std::span<const CatalogueEntry> entries) {
  std::unordered_set<std::string> names;
  for (const CatalogueEntry& entry : entries) {
    for (const std::string* text :
         {&entry.name, &entry.source, &entry.sp_tag, &entry.pv_tag, &entry.op_tag, &entry.mv_tag,
          &entry.mode_tag, &entry.loop_type, &entry.area, &entry.unit, &entry.description,
          &entry.pv_unit, &entry.owner}) {
      if (!is_storable(*text)) {
        throw DatabaseError("not UTF-8, loop " + make_storable(entry.name),
                            "save the list of loops as UTF-8", Remedy::give_up);
      }
    }
    if (!names.insert(entry.name).second) {
      throw DatabaseError("the loop is listed twice, loop " + entry.name,
                          "give every loop a name of its own", Remedy::give_up);
    }
  }
}

template <typename Add>
std::string column(std::span<const CatalogueEntry> entries, Add add) {
  ArrayLiteral array;
  for (const CatalogueEntry& entry : entries) add(array, entry);
  return array.text();
}

std::string texts(std::span<const CatalogueEntry> entries, std::string CatalogueEntry::*member) {
  return column(entries, [member](ArrayLiteral& array, const CatalogueEntry& entry) {
    array.add_text(entry.*member);
  });
}

std::vector<std::string> entry_parameters(std::span<const CatalogueEntry> entries) {
  using Entry = CatalogueEntry;
  using core::signal::OpRange;
  const auto limit = [](std::optional<OpRange> Entry::*range, double OpRange::*end) {
    return [range, end](ArrayLiteral& array, const Entry& entry) {
      entry.*range ? array.add_number(*(entry.*range).*end) : array.add_null();
    };
  };
  return {
      texts(entries, &Entry::name),
      texts(entries, &Entry::source),
      texts(entries, &Entry::sp_tag),
      texts(entries, &Entry::pv_tag),
      texts(entries, &Entry::op_tag),
      texts(entries, &Entry::mv_tag),
      texts(entries, &Entry::mode_tag),
      column(entries,
             [](ArrayLiteral& array, const Entry& entry) { array.add_number(entry.interval_s); }),
      column(entries,
             [](ArrayLiteral& array, const Entry& entry) { array.add_number(entry.period_s); }),
      column(entries, limit(&Entry::op_range, &OpRange::low)),
      column(entries, limit(&Entry::op_range, &OpRange::high)),
      texts(entries, &Entry::loop_type),
      column(entries,
             [](ArrayLiteral& array, const Entry& entry) { array.add_number(entry.importance); }),
      column(entries,
             [](ArrayLiteral& array, const Entry& entry) { array.add_boolean(entry.enabled); }),
      texts(entries, &Entry::area),
      texts(entries, &Entry::unit),
      texts(entries, &Entry::description),
      texts(entries, &Entry::pv_unit),
      texts(entries, &Entry::owner),
      column(entries, limit(&Entry::pv_range, &OpRange::low)),
      column(entries, limit(&Entry::pv_range, &OpRange::high)),
  };
}

SavedLoops save_all(Transaction& transaction, std::span<const CatalogueEntry> entries) {
  check_entries(entries);
  SavedLoops saved;
  for (const pqxx::row& row : transaction.run(kSaveLoops, entry_parameters(entries)))
    ++(row["is_new"].as<bool>() ? saved.added : saved.changed);
  saved.unchanged = entries.size() - saved.added - saved.changed;
  transaction.run(kMakeDue, {texts(entries, &CatalogueEntry::name)});
  return saved;
}

std::vector<CatalogueEntry> list_all(Transaction& transaction, const Statement& statement) {
  std::vector<CatalogueEntry> entries;
  for (const pqxx::row& row : transaction.run(statement)) entries.push_back(read_loop(row));
  return entries;
}

}  // namespace

struct Catalogue::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
  }
  Session session;
};

Catalogue::Catalogue(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
Catalogue::~Catalogue() = default;

std::vector<CatalogueEntry> Catalogue::list() {
  return impl_->session.transact(
      [](Transaction& transaction) { return list_all(transaction, kListLoops); });
}

std::optional<CatalogueEntry> Catalogue::find(const std::string& name) {
  // A name that PostgreSQL refuses cannot be in the catalogue.
  if (!is_storable(name)) return std::nullopt;
  return impl_->session.transact([&](Transaction& transaction) -> std::optional<CatalogueEntry> {
    const pqxx::result rows = transaction.run(kFindLoop, {name});
    if (rows.empty()) return std::nullopt;
    return read_loop(rows[0]);
  });
}

SavedLoops Catalogue::save(std::span<const CatalogueEntry> entries) {
  return impl_->session.transact(
      [&](Transaction& transaction) { return save_all(transaction, entries); });
}

SavedLoops Catalogue::change(
    const std::function<std::vector<CatalogueEntry>(const std::vector<CatalogueEntry>&)>& edit) {
  return impl_->session.transact([&](Transaction& transaction) {
    return save_all(transaction, edit(list_all(transaction, kListLoopsToChange)));
  });
}

std::size_t Catalogue::set_enabled(std::span<const std::string> names, bool enabled) {
  ArrayLiteral list;
  for (const std::string& name : names) list.add_text(name);
  return impl_->session.transact([&](Transaction& transaction) {
    return static_cast<std::size_t>(
        transaction.run(kSetEnabled, {list.text(), enabled ? "t" : "f"}).size());
  });
}

}  // namespace loopscope::storage
