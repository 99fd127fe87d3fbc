#include "storage/results/plant/announce_flags.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

// Rows of task_lease can be locked by workers alone, advisory locks by everybody who may connect.
const Statement kLockFlags{"lock_flags", R"(
    SELECT FROM loopscope.task_lease WHERE task = 'announce_flags' FOR UPDATE)",
                           Rows::one};

// A message may have 7999 bytes. The longer form nearly always fits; the shorter one always does,
// because no character takes more than six bytes in JSON.
const Statement kAnnounceFlags{"announce_flags", R"(
    WITH list AS MATERIALIZED (SELECT * FROM loopscope.flagged_loop),
    firm AS (
      UPDATE loopscope.flag_notice AS notice SET status = 'confirmed', confirmed_at = now()
      FROM list
      WHERE notice.loop_id = list.loop_id AND notice.ended_at IS NULL
        AND notice.status = 'watch' AND list.status = 'confirmed'
      RETURNING notice.loop_id, list.code
    ), came AS (
      INSERT INTO loopscope.flag_notice (loop_id, code, announced, slot_end, since, status,
                                         confidence, rank, score, summary, confirmed_at)
      SELECT loop_id, code,
             NOT EXISTS (
               SELECT FROM loopscope.flag_notice AS former
               JOIN loopscope.parameter AS quiet ON quiet.name = 'flag_quiet_hours'
               WHERE former.loop_id = list.loop_id
                 AND former.ended_at > now() - quiet.value * interval '1 h'
                 AND former.ended_at <= now()),
             slot_end, since, status, confidence, rank, score, summary,
             CASE WHEN status = 'confirmed' THEN now() END
      FROM list
      WHERE NOT EXISTS (
        SELECT FROM loopscope.flag_notice AS standing
        WHERE standing.loop_id = list.loop_id AND standing.ended_at IS NULL)
      RETURNING loop_id, code, announced
    ), told AS (
      SELECT 'flagged' AS change, loop_id, code, announced FROM came
      UNION ALL SELECT 'confirmed', loop_id, code, true FROM firm
    )
    -- A program of before may have noted two stays of one loop.
    SELECT DISTINCT told.change, told.announced, 0::bigint AS flag_notice_id, list.loop_id,
           list.loop_name, list.code, list.confidence, list.rank, list.score, list.status,
           list.summary, CASE WHEN told.announced THEN message.text END AS message
    FROM told
    JOIN list USING (loop_id, code)
    CROSS JOIN LATERAL (
      SELECT written.text
      FROM (VALUES (3000, 3000, 1000), (250, 700, 200)) AS room (name, summary, action)
      CROSS JOIN LATERAL (
        SELECT json_build_object(
          'loop', left(list.loop_name, room.name), 'loop_id', list.loop_id, 'code', list.code,
          'status', list.status, 'confidence', list.confidence, 'rank', list.rank,
          'score', list.score,
          'slot_end', to_char(list.slot_end AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'),
          'since', to_char(list.since AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'),
          'summary', left(list.summary, room.summary)
                     || CASE WHEN char_length(list.summary) > room.summary THEN '...' ELSE '' END,
          'action', left(list.action, room.action)
                    || CASE WHEN char_length(list.action) > room.action THEN '...' ELSE '' END
        )::text AS text) AS written
      WHERE octet_length(written.text) < 8000
      ORDER BY room.name DESC
      LIMIT 1) AS message
    UNION ALL
    SELECT 'ended', false, flag_notice_id, loop_id, '', code, 0, 0, 0, '', '', NULL
    FROM loopscope.flag_notice
    WHERE ended_at IS NULL AND loop_id NOT IN (SELECT loop_id FROM list)
    ORDER BY 8)"};

// Why a stay has ended is asked for those that have: what hides loops is dear to ask for, and at
// most looks none has ended.
const Statement kEndStays{"end_stays", R"(
    UPDATE loopscope.flag_notice AS notice SET ended_at = now(), ended_by = why.word
    FROM (
      SELECT standing.flag_notice_id,
             CASE WHEN NOT loop.enabled THEN 'disabled'
                  WHEN bool_or(hidden.annotation_id IS NOT NULL) THEN 'annotation'
                  WHEN bool_or(hidden.hidden_by = 'victim') THEN 'plant'
                  WHEN latest.code = 'not_controlling' THEN 'state'
                  WHEN latest.code = 'healthy' THEN 'verdict'
                  ELSE 'threshold' END AS word
      FROM loopscope.flag_notice AS standing
      JOIN loopscope.loop USING (loop_id)
      LEFT JOIN loopscope.own_verdict AS latest USING (loop_id)
      LEFT JOIN loopscope.hidden_loop AS hidden USING (loop_id)
      WHERE standing.flag_notice_id = ANY ($1::bigint[]) AND standing.ended_at IS NULL
      GROUP BY standing.flag_notice_id, loop.enabled, latest.code) AS why
    WHERE notice.flag_notice_id = why.flag_notice_id)",
                          Rows::none};

const Statement kTellListeners{"tell_listeners", R"(
    SELECT pg_notify('loopscope_' || told.change, told.message)
    FROM unnest($1::text[], $2::text[]) AS told (change, message))"};

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
  transaction.run(kLockFlags);
  FlagAnnouncement announcement;
  ArrayLiteral ended;
  for (const pqxx::row& row : transaction.run(kAnnounceFlags)) {
    const std::string change = row["change"].c_str();
    if (change == "ended") {
      ended.add_integer(row["flag_notice_id"].as<std::int64_t>());
      ++announcement.ended;
      continue;
    }
    (change == "confirmed" ? announcement.confirmed : announcement.flagged)
        .push_back(read_notice(row));
    if (!row["message"].is_null())
      announcement.messages.emplace_back(change, row["message"].c_str());
  }
  if (!ended.empty()) transaction.run(kEndStays, {ended.text()});
  return announcement;
}

void tell_listeners(Session& session, const FlagAnnouncement& announcement) {
  ArrayLiteral change, message;
  for (const auto& [channel, text] : announcement.messages) {
    change.add_text(channel);
    message.add_text(text);
  }
  session.transact([&](Transaction& transaction) {
    transaction.run(kTellListeners, {change.text(), message.text()});
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
