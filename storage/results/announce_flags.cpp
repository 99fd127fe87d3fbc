#include "storage/results/announce_flags.hpp"

#include "storage/results/plant_statements.hpp"
#include "storage/results/session.hpp"

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

}  // namespace

FlagAnnouncement announce_flags(Transaction& transaction) {
  // A statement of its own: the next one then sees what the row's former holder has committed.
  transaction.run(statements::kLockFlags);
  FlagAnnouncement announcement;
  for (const pqxx::row& row : transaction.run(statements::kAnnounceFlags)) {
    const std::string change = row["change"].c_str();
    if (change == "ended") {
      ++announcement.ended;
    } else {
      (change == "confirmed" ? announcement.confirmed : announcement.flagged)
          .push_back(read_notice(row));
    }
  }
  return announcement;
}

}  // namespace loopscope::storage
