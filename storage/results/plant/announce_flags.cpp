#include "storage/results/plant/announce_flags.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/plant/plant_statements.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

FlagNotice read_notice(const pqxx::row& row) {
  return {row["loop_id"].as<std::int64_t>(),
          row["loop_name"].c_str(),
          row["code"].c_str(),
          row["confidence"].as<double>(),
          row["rank"].as<std::int64_t>(),
          row["score"].as<double>(),
          row["status"].c_str(),
          row["summary"].c_str(),
          row["announced"].as<bool>()};
}

FlagAnnouncement note_flags(Transaction& transaction) {
  // A statement of its own: the next one then sees what the row's former holder has committed.
  transaction.run(statements::kLockFlags);
  FlagAnnouncement announcement;
  for (const pqxx::row& row : transaction.run(statements::kAnnounceFlags)) {
    const std::string change = row["change"].c_str();
    if (change == "ended") {
      ++announcement.ended;
      continue;
    }
    (change == "confirmed" ? announcement.confirmed : announcement.flagged)
        .push_back(read_notice(row));
    if (!row["message"].is_null())
      announcement.messages.emplace_back(change, row["message"].c_str());
  }
  return announcement;
}

void tell_listeners(Session& session, const FlagAnnouncement& announcement) {
  ArrayLiteral change, message;
  for (const auto& [channel, text] : announcement.messages) {
    change.add_text(channel);
    message.add_text(text);
  }
  session.transact([&](Transaction& transaction) {
    transaction.run(statements::kTellListeners, {change.text(), message.text()});
  });
}

}  // namespace

FlagAnnouncement announce_flags(Session& session, const ClockCheck& check) {
  FlagAnnouncement announcement = transact_in_time(session, check, note_flags);
  if (announcement.messages.empty()) return announcement;
  try {
    tell_listeners(session, announcement);
  } catch (const DatabaseError& error) {
    announcement.untold = error;
  }
  return announcement;
}

}  // namespace loopscope::storage
