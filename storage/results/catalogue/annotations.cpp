#include "storage/results/catalogue/annotations.hpp"

#include <algorithm>

#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

/// The columns of an Annotation out of a row of annotation_in_force.
std::string annotation_columns() {
  return R"(
    holds.loop_name, holds.kind, holds.code,
    (extract(epoch FROM holds.until) * 1000000)::bigint AS until_us, holds.reason, holds.author,
    holds.on_behalf_of, (extract(epoch FROM holds.entered_at) * 1000000)::bigint AS entered_at_us,
    holds.annotation_id)";
}

const Statement kListAnnotations{"list_annotations", "SELECT " + annotation_columns() + R"(
    FROM loopscope.annotation_in_force AS holds
    ORDER BY holds.loop_name, holds.entered_at, holds.annotation_id)"};

const Statement kAnnotationsOf{"annotations_of", "SELECT " + annotation_columns() + R"(
    FROM loopscope.annotation_in_force AS holds WHERE holds.loop_name = $1
    ORDER BY holds.entered_at, holds.annotation_id)"};

// Only the withdrawal is written: an engineer may change nothing else of what was said. It is asked
// for again, since another may have taken it back while this one waited for the row.
const Statement kReplaceAnnotations{"replace_annotations",
                                    R"(
    UPDATE loopscope.annotation AS said
    SET withdrawn_at = now(), withdrawn_on_behalf_of = nullif($4, '')
    FROM loopscope.annotation_in_force AS holds
    WHERE holds.annotation_id = said.annotation_id AND said.withdrawn_at IS NULL
      AND holds.loop_name = $1 AND holds.kind = $2
      AND holds.code IS NOT DISTINCT FROM nullif($3, '')
    RETURNING )" + annotation_columns()};

const Statement kAddAnnotation{"add_annotation", R"(
    INSERT INTO loopscope.annotation (loop_id, kind, code, until, reason, on_behalf_of)
    SELECT loop_id, $2, nullif($3, ''), nullif($4, '')::timestamptz, nullif($5, ''),
           nullif($6, '')
    FROM loopscope.loop WHERE name = $1
    RETURNING annotation_id)"};

const Statement kWithdrawAnnotations{"withdraw_annotations", R"(
    UPDATE loopscope.annotation AS said
    SET withdrawn_at = now(), withdrawn_on_behalf_of = nullif($3, '')
    FROM loopscope.annotation_in_force AS holds
    WHERE holds.annotation_id = said.annotation_id AND said.withdrawn_at IS NULL
      AND holds.loop_name = $1 AND ($2 = '' OR holds.code = $2)
    RETURNING said.annotation_id)"};

const Statement kWithdrawOne{"withdraw_annotation",
                             R"(
    UPDATE loopscope.annotation AS said
    SET withdrawn_at = now(), withdrawn_on_behalf_of = nullif($3, '')
    FROM loopscope.annotation_in_force AS holds
    WHERE holds.annotation_id = said.annotation_id AND said.withdrawn_at IS NULL
      AND holds.loop_name = $1 AND holds.annotation_id = $2::bigint
    RETURNING )" + annotation_columns()};

const Statement kNewestCode{"newest_code",
                            "SELECT code FROM loopscope.own_verdict WHERE loop_name = $1"};

// Of several who speak of a loop at once each sees what the one before has said.
const Statement kLockAnnotations{
    "lock_annotations",
    "SELECT pg_advisory_xact_lock(hashtextextended('loopscope annotation ' || $1, 0))"};

const Statement kFaultCodes{"fault_codes",
                            "SELECT code FROM loopscope.verdict_kind WHERE is_fault ORDER BY code"};

Annotation read_annotation(const pqxx::row& row) {
  Annotation annotation;
  annotation.loop_name = row["loop_name"].c_str();
  annotation.kind = row["kind"].c_str();
  if (!row["code"].is_null()) annotation.code = row["code"].c_str();
  annotation.until_us = read_integer(row["until_us"]);
  annotation.reason = read_text(row["reason"]);
  annotation.author = row["author"].c_str();
  annotation.on_behalf_of = maybe_text(row["on_behalf_of"]);
  annotation.entered_at_us = row["entered_at_us"].as<std::int64_t>();
  annotation.annotation_id = row["annotation_id"].as<std::int64_t>();
  return annotation;
}

std::vector<Annotation> read_annotations(const pqxx::result& rows) {
  std::vector<Annotation> annotations;
  for (const pqxx::row& row : rows) annotations.push_back(read_annotation(row));
  return annotations;
}

std::optional<OthersInForce> replace(Transaction& transaction, const Annotation& annotation) {
  const std::string code = annotation.code.value_or("");
  const std::string name = make_storable(annotation.on_behalf_of.value_or(""));
  transaction.run(kLockAnnotations, {annotation.loop_name});
  OthersInForce others;
  others.replaced = read_annotations(
      transaction.run(kReplaceAnnotations, {annotation.loop_name, annotation.kind, code, name}));
  std::ranges::sort(others.replaced, {}, &Annotation::entered_at_us);
  others.beside = read_annotations(transaction.run(kAnnotationsOf, {annotation.loop_name}));
  const std::string until = annotation.until_us ? timestamp_text(*annotation.until_us) : "";
  const pqxx::result added = transaction.run(
      kAddAnnotation,
      {annotation.loop_name, annotation.kind, code, until, make_storable(annotation.reason), name});
  if (added.empty()) return std::nullopt;
  return others;
}

}  // namespace

struct Annotations::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
  }
  Session session;
};

Annotations::Annotations(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
Annotations::~Annotations() = default;

std::vector<Annotation> Annotations::in_force() {
  return impl_->session.transact(
      [](Transaction& transaction) { return read_annotations(transaction.run(kListAnnotations)); });
}

std::vector<Annotation> Annotations::in_force(const std::string& loop_name) {
  if (!is_storable(loop_name)) return {};
  return impl_->session.transact([&](Transaction& transaction) {
    return read_annotations(transaction.run(kAnnotationsOf, {loop_name}));
  });
}

std::optional<OthersInForce> Annotations::add(const Annotation& annotation) {
  // A name that PostgreSQL refuses cannot be in the catalogue.
  if (!is_storable(annotation.loop_name)) return std::nullopt;
  return impl_->session.transact(
      [&](Transaction& transaction) { return replace(transaction, annotation); });
}

std::size_t Annotations::withdraw(const std::string& loop_name,
                                  const std::optional<std::string>& code,
                                  const std::optional<std::string>& on_behalf_of) {
  if (!is_storable(loop_name)) return 0;
  return impl_->session.transact([&](Transaction& transaction) {
    return static_cast<std::size_t>(
        transaction
            .run(kWithdrawAnnotations,
                 {loop_name, code.value_or(""), make_storable(on_behalf_of.value_or(""))})
            .size());
  });
}

std::optional<Annotation> Annotations::withdraw_one(
    const std::string& loop_name, std::int64_t annotation_id,
    const std::optional<std::string>& on_behalf_of) {
  if (!is_storable(loop_name)) return std::nullopt;
  const std::vector<std::string> parameters = {loop_name, std::to_string(annotation_id),
                                               make_storable(on_behalf_of.value_or(""))};
  return impl_->session.transact([&](Transaction& transaction) -> std::optional<Annotation> {
    const auto withdrawn = read_annotations(transaction.run(kWithdrawOne, parameters));
    return withdrawn.empty() ? std::nullopt : std::optional(withdrawn.front());
  });
}

std::optional<std::string> Annotations::newest_code(const std::string& loop_name) {
  if (!is_storable(loop_name)) return std::nullopt;
  return impl_->session.transact([&](Transaction& transaction) -> std::optional<std::string> {
    const pqxx::result rows = transaction.run(kNewestCode, {loop_name});
    if (rows.empty()) return std::nullopt;
    return rows[0][0].c_str();
  });
}

std::vector<std::string> Annotations::fault_codes() {
  return impl_->session.transact([](Transaction& transaction) {
    std::vector<std::string> codes;
    for (const pqxx::row& row : transaction.run(kFaultCodes)) {
      codes.emplace_back(row[0].c_str());
    }
    return codes;
  });
}

}  // namespace loopscope::storage
