#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "daemon/monitor/metrics.hpp"
#include "daemon/service/historians/source_gate.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// The connections of this process to its historians, shared by all workers: at most
/// `max_connections` to each, made when they are needed and kept for the next user. Thread-safe.
class HistorianPool {
 public:
  explicit HistorianPool(Metrics& metrics) : metrics_(metrics) {}

  /// Calls `use(storage::HistorianReader&)` with a connection of its own and returns what it
  /// returned, which is not void. Waits for a free one for at most `terms.patience`. A connection
  /// that died while it was idle says nothing about the server: one new one is tried, and `use` is
  /// called again. Throws storage::DatabaseError, and what `use` throws.
  template <typename Use>
  auto with_reader(const config::HistorianSettings& source, const SourceTerms& terms, Use use) {
    for (bool retried = false;; retried = true) {
      Loan loan(*this, source, terms);
      try {
        auto result = use(loan.reader());
        loan.give_back();
        return result;
      } catch (const storage::DatabaseError& error) {
        if (retried || !loan.was_idle() || error.remedy() != storage::Remedy::reconnect) {
          loan.fail(error);
          throw;
        }
      }
      metrics_.reconnected("historian " + source.name);
      // Its neighbours were left by the same server.
      forget_idle(source.name);
    }
  }

  /// Whether the last use of the source failed.
  [[nodiscard]] bool is_down(const std::string& name);
  /// Sources that admit nobody just now, with the time until one may try (SourceGate::closed_for).
  [[nodiscard]] std::map<std::string, SourceGate::Duration> closed();
  /// Users of the source that have a connection or are just getting one.
  [[nodiscard]] int in_use(const std::string& name);
  /// Closes connections that nobody uses, of one source or of all: after a reload they may lead to
  /// the wrong place.
  void forget_idle(const std::string& name);
  void forget_idle();

 private:
  struct Connection {
    config::HistorianSettings settings;
    storage::HistorianReader reader;
  };
  struct Source {
    SourceGate gate;
    std::vector<Connection> idle;
    /// Connections in use. Fewer than are inside the gate: who has just entered may yet take an
    /// idle one, and one that is closed for his sake counts at the server until its process has
    /// ended.
    int lent = 0;
  };

  /// A place inside the gate, with a connection.
  class Loan {
   public:
    Loan(HistorianPool& pool, const config::HistorianSettings& settings, const SourceTerms& terms);
    /// Neither given back nor failed: the connection is closed.
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    [[nodiscard]] storage::HistorianReader& reader() { return connection_->reader; }
    [[nodiscard]] bool was_idle() const { return was_idle_; }
    void give_back();
    void fail(const storage::DatabaseError& error);

   private:
    void connect(const config::HistorianSettings& settings);
    HistorianPool& pool_;
    Source& source_;
    SourceTerms terms_;
    int limit_;
    bool inside_ = true;
    bool was_idle_ = false;
    std::optional<Connection> connection_;
  };

  [[nodiscard]] Source& source(const std::string& name);
  /// Counts one as lent, whether an idle one was found or the caller makes one.
  [[nodiscard]] std::optional<Connection> take_idle(Source& source,
                                                    const config::HistorianSettings& settings);
  /// One that was lent is in use no longer.
  void take_back(Source& source);

  Metrics& metrics_;
  std::mutex mutex_;  ///< over `sources_` and their idle connections
  std::map<std::string, std::unique_ptr<Source>> sources_;
};

}  // namespace loopscope::daemon
