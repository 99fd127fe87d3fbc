# shellcheck shell=bash
# A migrated database of its own on the throw-away server of the tests. Source this after say.sh.
#
#   ask CONNINFO SQL                psql's bare answer
#   make_database PROGRAM ENVFILE   makes $database and sets $connection; skips the test where ENVFILE
#                                   names no server
#   drop_database                   for the trap

database=loopscope_deploy_$$
_ROLES_SQL=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/deploy/roles.sql

ask() {
  psql --no-psqlrc -v ON_ERROR_STOP=1 -qAt "$1" -c "$2"
}

make_database() {
  local settings
  server=$(sed -n 's/^LOOPSCOPE_TEST_DATABASE=//p' "$2")
  [ -n "$server" ] || skip "no test server: run through ctest, which starts one"
  ask "$server" "CREATE DATABASE $database"
  connection=${server/dbname=postgres/dbname=$database}
  psql --no-psqlrc -v ON_ERROR_STOP=1 -q "$connection" -f "$_ROLES_SQL" 2>/dev/null
  # The program takes no superuser.
  ask "$connection" "DO \$\$ BEGIN CREATE ROLE loopscope_test_owner LOGIN IN ROLE loopscope_owner;
    EXCEPTION WHEN duplicate_object OR unique_violation THEN NULL; END \$\$"
  settings=$(mktemp)
  printf '{"results": {"connection": "%s"}, "historians": [{"connection": "%s"}]}\n' \
    "${connection/user=postgres/user=loopscope_test_owner}" "$connection" >"$settings"
  "$1" migrate --config "$settings" >/dev/null
  rm -f "$settings"
}

drop_database() {
  [ -z "${server:-}" ] || ask "$server" "DROP DATABASE IF EXISTS $database WITH (FORCE)"
}
