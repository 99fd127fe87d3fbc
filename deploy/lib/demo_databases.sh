# shellcheck shell=bash
# The demo's two databases, their roles and the settings file. Source this file after say.sh and
# private_cluster.sh.
#
#   demo_databases FOLDER          makes what is missing; nothing happens the second time
#   demo_settings FOLDER           writes FOLDER/loopscope.json
#   demo_conninfo FOLDER USER DB   how USER connects
#   demo_sql FOLDER USER DB SQL... one psql, bare values
#
# plant      the historian, table public.history: written by the import, read by demo_historian
# loopscope  results: owned by demo_owner's group, written by demo_worker, read by demo_reader, annotated by
#            demo_engineer

_DEMO_ROLES_SQL=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/roles.sql

demo_conninfo() {
  printf 'host=%s port=%s user=%s dbname=%s\n' "$1" "$_PRIVATE_CLUSTER_PORT" "$2" "$3"
}

demo_psql() {
  local folder=$1 user=$2 database=$3
  shift 3
  # PSQLRC and a pager are the user's, not the demo's.
  PGOPTIONS='-c client_min_messages=warning -c search_path=pg_catalog,pg_temp' psql --no-psqlrc --quiet --set ON_ERROR_STOP=1 \
    --pset pager=off "$@" "$(demo_conninfo "$folder" "$user" "$database")"
}

demo_sql() {
  local folder=$1 user=$2 database=$3
  shift 3
  printf '%s;\n' "$@" | demo_psql "$folder" "$user" "$database" --no-align --tuples-only
}

_make_database() {
  if [ -z "$(demo_sql "$1" postgres postgres "SELECT 1 FROM pg_database WHERE datname = '$2'")" ]; then
    demo_sql "$1" postgres postgres "CREATE DATABASE $2"
  fi
}

_make_logins() {
  demo_psql "$1" postgres loopscope <<'SQL'
SELECT format('CREATE ROLE %I LOGIN IN ROLE %I', login, grouping)
FROM (VALUES ('demo_owner', 'loopscope_owner'), ('demo_worker', 'loopscope_worker'),
             ('demo_reader', 'loopscope_reader'), ('demo_engineer', 'loopscope_engineer'),
             ('demo_historian', 'loopscope_historian')) AS role (login, grouping)
WHERE to_regrole(login) IS NULL
\gexec
SQL
}

demo_databases() {
  _make_database "$1" loopscope
  _make_database "$1" plant
  demo_psql "$1" postgres loopscope --file "$_DEMO_ROLES_SQL"
  _make_logins "$1"
  # The table comes with the first import: whatever the importer makes, the reader may read.
  demo_sql "$1" postgres plant \
    "ALTER DEFAULT PRIVILEGES IN SCHEMA public GRANT SELECT ON TABLES TO loopscope_historian"
}

demo_settings() {
  cat >"$1/loopscope.json" <<EOT
// Written by deploy/demo on every run.
{
  "results": {
    "connection": "$(demo_conninfo "$1" demo_worker loopscope)",
    "owner_connection": "$(demo_conninfo "$1" demo_owner loopscope)",
    "engineer_connection": "$(demo_conninfo "$1" demo_engineer loopscope)"
  },
  "historians": [
    {
      "name": "plant",
      "connection": "$(demo_conninfo "$1" demo_historian plant)",
      "writer_connection": "$(demo_conninfo "$1" postgres plant)",
      "table": "public.history"
    }
  ]
}
EOT
}
