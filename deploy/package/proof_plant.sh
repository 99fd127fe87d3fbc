# shellcheck shell=bash
# What a site has before and makes after it installs the package, in a booted root. Source this file
# after booted_root.sh.
#
#   proof_plant_server            a PostgreSQL server with passwords, and the databases
#   proof_plant_settings          /etc/loopscope as the manual page says
#   proof_sql DATABASE SQL        as the superuser
#   proof_as_owner COMMAND...     by hand, as root with the owner's credentials
#   proof_as_worker COMMAND...    by hand, as root with the worker's credentials

# Written where the booted system sees it, by whoever runs this.
put() {
  local path=$1 mode=$2 owner=$3
  booted_root_run install -D -m "$mode" -o root -g "$owner" /dev/null "$path"
  cat >"$_PROOF_ROOT$path"
}

proof_sql() {
  booted_root_run runuser -u postgres -- psql --no-psqlrc -v ON_ERROR_STOP=1 -Atq -d "$1" -c "$2"
}

proof_plant_server() {
  booted_root_run pg_createcluster 15 plant --start -- --auth-host=scram-sha-256 --auth-local=peer >/dev/null
  proof_sql postgres "CREATE DATABASE loopscope"
  proof_sql postgres "CREATE DATABASE plant"
}

# After the package is there: roles.sql is its own.
proof_plant_roles() {
  booted_root_run runuser -u postgres -- psql --no-psqlrc -v ON_ERROR_STOP=1 -q -d loopscope \
    -f /usr/share/doc/loopscope/examples/roles.sql
  proof_sql loopscope "
    CREATE ROLE plant_owner LOGIN PASSWORD 'owner-secret' IN ROLE loopscope_owner;
    CREATE ROLE plant_worker LOGIN PASSWORD 'worker-secret' IN ROLE loopscope_worker;
    CREATE ROLE plant_historian LOGIN PASSWORD 'historian-secret' IN ROLE loopscope_historian;
    CREATE ROLE plant_writer LOGIN PASSWORD 'writer-secret'"
  proof_sql plant "
    GRANT CREATE ON SCHEMA public TO plant_writer;
    ALTER DEFAULT PRIVILEGES FOR ROLE plant_writer IN SCHEMA public GRANT SELECT ON TABLES TO loopscope_historian"
}

_service_entry() {
  printf '[%s]\nhost=localhost\nport=5432\ndbname=%s\nuser=%s\n\n' "$1" "$2" "$1"
}

_settings() {
  cat <<EOT
{
  // of the proof, $1
  "results": {"connection": "service=plant_worker", "owner_connection": "service=plant_owner"},
  "historians": [{"name": "plant", "connection": "service=plant_historian",
                  "writer_connection": "service=plant_writer"}],
  "schedule": {"poll_s": 1, "lease_s": 10}$2
}
EOT
}

proof_plant_settings() {
  {
    _service_entry plant_worker loopscope
    _service_entry plant_owner loopscope
    _service_entry plant_historian plant
    _service_entry plant_writer plant
  } | put /etc/loopscope/pg_service.conf 0640 loopscope
  printf 'localhost:5432:*:%s\n' plant_worker:worker-secret plant_historian:historian-secret |
    put /etc/loopscope/pgpass 0600 root
  printf 'localhost:5432:*:%s\n' plant_owner:owner-secret plant_writer:writer-secret plant_historian:historian-secret |
    put /etc/loopscope/owner/pgpass 0600 root
  _settings "one worker" "$(_report)" | put /etc/loopscope/loopscope.json 0640 loopscope
  _settings "another instance" "$(proof_other_http)" | put /etc/loopscope/north.json 0640 loopscope
}

# Every report with its PDF, into the one folder that a worker can write to.
_report() {
  printf ',\n  "report": {"folder": "/var/lib/loopscope", "pdf": true}'
}

# Two instances cannot listen on one port.
proof_other_http() {
  printf ',\n  "daemon": {"http_address": "127.0.0.1:9471"}'
}

proof_as_owner() {
  booted_root_run env PGSERVICEFILE=/etc/loopscope/pg_service.conf \
    PGPASSFILE=/etc/loopscope/owner/pgpass "$@" --config /etc/loopscope/loopscope.json
}

proof_as_worker() {
  booted_root_run env PGSERVICEFILE=/etc/loopscope/pg_service.conf \
    PGPASSFILE=/etc/loopscope/pgpass "$@" --config /etc/loopscope/loopscope.json
}
