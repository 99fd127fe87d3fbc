#include "storage/results/catalogue/annotations.hpp"

#include "storage/results/catalogue/annotation_statements.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

Annotation read_annotation(const pqxx::row& row) {
  Annotation annotation;
  annotation.loop_name = row["loop_name"].c_str();
  annotation.kind = row["kind"].c_str();
  if (!row["code"].is_null()) annotation.code = row["code"].c_str();
  annotation.until_us = read_integer(row["until_us"]);
  annotation.reason = read_text(row["reason"]);
  annotation.author = row["author"].c_str();
  annotation.entered_at_us = row["entered_at_us"].as<std::int64_t>();
  return annotation;
}

std::optional<std::size_t> replace(Transaction& transaction, const Annotation& annotation) {
  const std::string code = annotation.code.value_or("");
  const std::size_t replaced =
      transaction
          .run(statements::kReplaceAnnotations, {annotation.loop_name, annotation.kind, code})
          .size();
  const std::string until = annotation.until_us ? timestamp_text(*annotation.until_us) : "";
  const pqxx::result added = transaction.run(
      statements::kAddAnnotation,
      {annotation.loop_name, annotation.kind, code, until, make_storable(annotation.reason)});
  if (added.empty()) return std::nullopt;
  return replaced;
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
  return impl_->session.transact([](Transaction& transaction) {
    std::vector<Annotation> annotations;
    for (const pqxx::row& row : transaction.run(statements::kListAnnotations)) {
      annotations.push_back(read_annotation(row));
    }
    return annotations;
  });
}

std::optional<std::size_t> Annotations::add(const Annotation& annotation) {
  // A name that PostgreSQL refuses cannot be in the catalogue.
  if (!is_storable(annotation.loop_name)) return std::nullopt;
  return impl_->session.transact(
      [&](Transaction& transaction) { return replace(transaction, annotation); });
}

std::size_t Annotations::withdraw(const std::string& loop_name,
                                  const std::optional<std::string>& code) {
  if (!is_storable(loop_name)) return 0;
  return impl_->session.transact([&](Transaction& transaction) {
    return static_cast<std::size_t>(
        transaction.run(statements::kWithdrawAnnotations, {loop_name, code.value_or("")}).size());
  });
}

std::optional<std::string> Annotations::newest_code(const std::string& loop_name) {
  if (!is_storable(loop_name)) return std::nullopt;
  return impl_->session.transact([&](Transaction& transaction) -> std::optional<std::string> {
    const pqxx::result rows = transaction.run(statements::kNewestCode, {loop_name});
    if (rows.empty()) return std::nullopt;
    return rows[0][0].c_str();
  });
}

std::vector<std::string> Annotations::fault_codes() {
  return impl_->session.transact([](Transaction& transaction) {
    std::vector<std::string> codes;
    for (const pqxx::row& row : transaction.run(statements::kFaultCodes)) {
      codes.emplace_back(row[0].c_str());
    }
    return codes;
  });
}

}  // namespace loopscope::storage
