#include "daemon/service/historians/historian_pool.hpp"

#include <utility>

#include "daemon/service/historians/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

/// SQLSTATE of a statement that ran into its time-out.
constexpr const char* kQueryCanceled = "57014";

/// Whether the next user would most likely meet the same fault, after as long a wait.
bool speaks_of_the_source(const storage::DatabaseError& error) {
  return error.remedy() == storage::Remedy::reconnect || error.sqlstate() == kQueryCanceled;
}

}  // namespace

HistorianPool::Loan::Loan(HistorianPool& pool, const config::HistorianSettings& settings,
                          const SourceTerms& terms)
    : pool_(pool),
      source_(pool.source(settings.name)),
      terms_(terms),
      limit_(settings.max_connections) {
  source_.gate.enter(settings.name, limit_, terms_.patience);
  try {
    connect(settings);
  } catch (const storage::DatabaseError& error) {
    pool_.take_back(source_);
    source_.gate.leave_down(error, terms_.pause);
    throw;
  } catch (...) {
    pool_.take_back(source_);
    source_.gate.leave();
    throw;
  }
}

void HistorianPool::Loan::connect(const config::HistorianSettings& settings) {
  connection_ = pool_.take_idle(source_, settings);
  was_idle_ = connection_.has_value();
  if (was_idle_) return;
  connection_ =
      Connection{settings, storage::HistorianReader(historian_connection(settings, terms_.hold_s),
                                                    historian_layout(settings))};
}

HistorianPool::Loan::~Loan() {
  connection_.reset();
  if (!inside_) return;
  pool_.take_back(source_);
  source_.gate.leave();
}

void HistorianPool::Loan::give_back() {
  {
    // Before the place is: so that all connections together never exceed the limit.
    const std::lock_guard lock(pool_.mutex_);
    const auto kept = static_cast<int>(source_.idle.size()) + source_.lent;
    if (kept <= limit_) source_.idle.push_back(std::move(*connection_));
    --source_.lent;
  }
  connection_.reset();
  inside_ = false;
  source_.gate.leave();
}

void HistorianPool::Loan::fail(const storage::DatabaseError& error) {
  connection_.reset();
  inside_ = false;
  pool_.take_back(source_);
  speaks_of_the_source(error) ? source_.gate.leave_down(error, terms_.pause) : source_.gate.leave();
}

HistorianPool::Source& HistorianPool::source(const std::string& name) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<Source>& source = sources_[name];
  if (!source) source = std::make_unique<Source>();
  return *source;
}

std::optional<HistorianPool::Connection> HistorianPool::take_idle(
    Source& source, const config::HistorianSettings& settings) {
  const std::lock_guard lock(mutex_);
  ++source.lent;
  // After a reload the old connections may lead to another place.
  std::erase_if(source.idle, [&](const Connection& idle) { return !(idle.settings == settings); });
  if (source.idle.empty()) return std::nullopt;
  std::optional<Connection> connection(std::move(source.idle.back()));
  source.idle.pop_back();
  return connection;
}

void HistorianPool::take_back(Source& source) {
  const std::lock_guard lock(mutex_);
  --source.lent;
}

bool HistorianPool::is_down(const std::string& name) {
  return source(name).gate.is_down();
}

std::map<std::string, SourceGate::Duration> HistorianPool::closed() {
  const std::lock_guard lock(mutex_);
  std::map<std::string, SourceGate::Duration> closed;
  for (const auto& [name, source] : sources_) {
    if (const auto left = source->gate.closed_for()) closed.emplace(name, *left);
  }
  return closed;
}

int HistorianPool::in_use(const std::string& name) {
  return source(name).gate.inside();
}

void HistorianPool::forget_idle(const std::string& name) {
  Source& forgotten = source(name);
  const std::lock_guard lock(mutex_);
  forgotten.idle.clear();
}

void HistorianPool::forget_idle() {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, source] : sources_) source->idle.clear();
}

}  // namespace loopscope::daemon
