#include "storage/results/session/schema_statements.hpp"

namespace loopscope::storage::statements {

const Statement kHasSchema{
    "has_schema", "SELECT to_regclass('loopscope.schema_migration') IS NOT NULL", Rows::one};

const Statement kSchemaVersion{"schema_version",
                               "SELECT coalesce(max(version), 0) FROM loopscope.schema_migration",
                               Rows::one};

const Statement kOldestProgram{"oldest_program", "SELECT loopscope.oldest_program()", Rows::one};

// Where there is no schema yet, there is nobody to mistrust. A role that does not exist has no
// members. The login ($1) is looked at by itself: an option of the connection can have set another
// session_user, which RESET SESSION AUTHORIZATION would take back.
const Statement kFindSchemaOwner{"find_schema_owner", R"(
    SELECT coalesce(powerful.login, session_user) AS login,
           coalesce(powerful.superuser, '') AS superuser, coalesce(owner.rolname, '') AS owner,
           coalesce(owner.rolsuper OR owner.oid IN (role.oid, database.datdba)
                      OR pg_has_role(owner.oid, owners.oid, 'MEMBER'), owner.oid IS NULL)
             AS owner_trusted
    FROM pg_roles AS role
    LEFT JOIN LATERAL (
      SELECT login.rolname AS login, super.rolname AS superuser
      FROM pg_roles AS login JOIN pg_roles AS super ON super.rolsuper
      WHERE login.rolname IN ($1::name, session_user, current_user)
        AND pg_has_role(login.oid, super.oid, 'MEMBER')
      ORDER BY login.oid = super.oid DESC, super.rolname LIMIT 1
    ) AS powerful ON true
    JOIN pg_database AS database ON database.datname = current_database()
    LEFT JOIN pg_roles AS owners ON owners.rolname = 'loopscope_owner'
    LEFT JOIN pg_namespace AS schema ON schema.nspname = 'loopscope'
    LEFT JOIN pg_roles AS owner ON owner.oid = schema.nspowner
    WHERE role.rolname = current_user)",
                                 Rows::one};

// Several logins may be members of loopscope_owner: what one makes, all can change. Where that role
// may not create the schema (roles.sql was run in another database) the login itself becomes owner.
const Statement kBecomeOwner{"become_owner", R"(
    SELECT set_config('role', 'loopscope_owner', true)
    FROM pg_roles AS owner
    LEFT JOIN pg_namespace AS schema ON schema.nspname = 'loopscope'
    WHERE owner.rolname = 'loopscope_owner' AND pg_has_role(owner.oid, 'MEMBER')
      AND CASE WHEN schema.oid IS NULL
               THEN has_database_privilege(owner.oid, current_database(), 'CREATE')
               ELSE schema.nspowner = owner.oid END)"};

// Like the statement above, asked of rights alone.
const Statement kOwnerRights{"owner_rights", R"(
    SELECT current_database() AS database, session_user AS login,
           coalesce(schema.nspowner::regrole::text, '') AS owner,
           coalesce(pg_has_role(schema.nspowner, 'MEMBER'), false) AS owns,
           has_database_privilege(current_database(), 'CREATE')
             OR EXISTS (SELECT FROM pg_roles AS role
                        WHERE role.rolname = 'loopscope_owner' AND pg_has_role(role.oid, 'MEMBER')
                          AND has_database_privilege(role.oid, current_database(), 'CREATE'))
             AS may_make
    FROM (SELECT 1) AS one
    LEFT JOIN pg_namespace AS schema ON schema.nspname = 'loopscope')",
                             Rows::one};

// Two that make it at the same time meet at its name: the second waits for the first and fails.
const Statement kMakeSchema{"make_schema", "CREATE SCHEMA IF NOT EXISTS loopscope", Rows::none};

// A comment locks what it is about until the transaction ends, against other comments and nothing
// else, and only the schema's owner can write one: anybody may take advisory locks. The words are
// those of the first migration.
const Statement kLockSchema{"lock_schema", R"(
    COMMENT ON SCHEMA loopscope IS
      'Control-loop diagnoses: loops, schedule, analyses, verdicts and views for people')",
                            Rows::none};

const Statement kAppliedMigrations{
    "applied_migrations",
    "SELECT version, name, sha256 FROM loopscope.schema_migration ORDER BY version"};

const Statement kRecordMigration{"record_migration", R"(
    INSERT INTO loopscope.schema_migration (version, name, sha256) VALUES ($1::integer, $2, $3))",
                                 Rows::none};

const Statement kMakePartitions{"make_partitions",
                                "SELECT loopscope.make_partitions(now(), $1::integer) AS name"};

const Statement kMakePastPartitions{"make_past_partitions", R"(
    SELECT loopscope.make_partitions($1::timestamptz,
      (12 * extract(year FROM months.between) + extract(month FROM months.between))::integer) AS name
    FROM (SELECT age(date_trunc('month', now() AT TIME ZONE 'UTC'),
                     date_trunc('month', $1::timestamptz AT TIME ZONE 'UTC')) AS between) AS months)"};

const Statement kPartitionMonths{"partition_months", R"(
    SELECT coalesce(min(month.name), '') AS first, coalesce(max(month.name), '') AS last
    FROM (SELECT replace(right(child.relname, 7), '_', '-') AS name
          FROM pg_inherits AS inherits
          JOIN pg_class AS child ON child.oid = inherits.inhrelid
          WHERE inherits.inhparent = 'loopscope.analysis'::regclass
            AND child.relname ~ '_[0-9]{4}_[0-9]{2}$') AS month)",
                                 Rows::one};

const Statement kGrantRights{"grant_rights", "SELECT loopscope.grant_rights()", Rows::one};

const Statement kExpiredPartitions{"expired_partitions", R"(
    SELECT loopscope.expired_partitions(least(now(), loopscope.newest_result())
                                        - make_interval(months => $1::integer)) AS name)"};

const Statement kDropPartition{"drop_partition", "SELECT loopscope.drop_partition($1)", Rows::one};

const Statement kDeleteOldRows{"delete_old_rows", R"(
    SELECT loopscope.delete_old_rows(least(now(), loopscope.newest_result())
                                     - make_interval(months => $1::integer)))",
                               Rows::one};

// Before all time: nothing of the results, but the workers that have not been seen for a month.
const Statement kDeleteLostWorkers{"delete_lost_workers",
                                   "SELECT loopscope.delete_old_rows('-infinity')", Rows::one};

const Statement kDeleteOldCosts{
    "delete_old_costs", "DELETE FROM loopscope.stage_cost WHERE hour < now() - interval '2 years'",
    Rows::none};

// One row per right: whether the connected user has it, and whether it should.
const Statement kCheckRights{"check_rights", R"(
    SELECT privilege || ' on ' || object AS what, needed,
           CASE WHEN object = 'schema loopscope'
                THEN has_schema_privilege('loopscope', privilege)
                WHEN object = 'sequence loopscope.analysis_id'
                THEN has_sequence_privilege('loopscope.analysis_id', privilege)
                WHEN object LIKE 'function %'
                THEN has_function_privilege(substr(object, length('function ') + 1), privilege)
                WHEN object = 'loopscope.schedule' AND privilege = 'UPDATE'
                THEN (SELECT bool_and(has_column_privilege(object, name, privilege))
                      FROM unnest(ARRAY['visible_at', 'owner', 'fence', 'attempts', 'lost_leases',
                                        'last_error', 'last_slot_end', 'result_slot_end',
                                        'pv_flat_s', 'pv_step']) AS name)
                WHEN privilege = 'UPDATE'
                THEN has_any_column_privilege(object, privilege)
                ELSE has_table_privilege(object, privilege) END AS granted
    FROM (VALUES
      ('USAGE', 'schema loopscope', true), ('CREATE', 'schema loopscope', false),
      ('SELECT', 'loopscope.loop', true), ('DELETE', 'loopscope.loop', false),
      ('SELECT', 'loopscope.schedule', true), ('UPDATE', 'loopscope.schedule', true),
      ('SELECT', 'loopscope.analysis', true), ('INSERT', 'loopscope.analysis', true),
      ('UPDATE', 'loopscope.analysis', true), ('DELETE', 'loopscope.analysis', false),
      ('INSERT', 'loopscope.bicoherence_peak', true), ('INSERT', 'loopscope.explanation_step', true),
      ('INSERT', 'loopscope.verdict', true), ('DELETE', 'loopscope.verdict', false),
      ('INSERT', 'loopscope.standing_problem', true), ('UPDATE', 'loopscope.standing_problem', true),
      ('INSERT', 'loopscope.stage_cost', true), ('UPDATE', 'loopscope.stage_cost', true),
      ('INSERT', 'loopscope.worker', true), ('UPDATE', 'loopscope.worker', true),
      ('INSERT', 'loopscope.plant_oscillation', true), ('UPDATE', 'loopscope.plant_oscillation', true),
      ('INSERT', 'loopscope.plant_round', true), ('UPDATE', 'loopscope.plant_round', true),
      ('INSERT', 'loopscope.flag_notice', true), ('UPDATE', 'loopscope.flag_notice', true),
      ('INSERT', 'loopscope.flag_total', true), ('UPDATE', 'loopscope.flag_total', true),
      ('UPDATE', 'loopscope.task_lease', true),
      ('SELECT', 'loopscope.parameter', true), ('UPDATE', 'loopscope.parameter', true),
      ('SELECT', 'loopscope.schema_migration', true),
      ('EXECUTE', 'function loopscope.oldest_program()', true),
      ('EXECUTE', 'function loopscope.flagged_at(float8, float8, float8)', true),
      ('EXECUTE', 'function loopscope.list_questions(float8, float8, float8)', true),
      ('EXECUTE', 'function loopscope.verdict_run(bigint, timestamptz, text)', true),
      ('USAGE', 'sequence loopscope.analysis_id', true)
    ) AS checked (privilege, object, needed))"};

const Statement kCheckEngineerRights{"check_engineer_rights", R"(
    SELECT privilege || ' (' || name || ') on loopscope.' || relation AS what,
           has_column_privilege('loopscope.' || relation, name, privilege) AS granted
    FROM (VALUES
      ('SELECT', 'loop', 'name'), ('SELECT', 'annotation_in_force', 'reason'),
      ('INSERT', 'annotation', 'on_behalf_of'), ('UPDATE', 'annotation', 'withdrawn_at'),
      ('INSERT', 'maintenance_event', 'on_behalf_of')
    ) AS checked (privilege, relation, name))"};

}  // namespace loopscope::storage::statements
