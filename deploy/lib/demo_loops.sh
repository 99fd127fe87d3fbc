# shellcheck shell=bash
# Brings loops into the demo's historian and catalogue. Source this file after demo_databases.sh.
#
#   demo_import_simulated FOLDER   the loops of deploy/demo_loops.csv
#   demo_import_recordings FOLDER DIR   every CSV of DIR; kinds from manifest.csv in DIR or beside it
#
# A loop that the catalogue has is left alone, so a second run only looks. Both count into
# DEMO_LOOPS_NEW, DEMO_LOOPS_KNOWN and DEMO_LOOPS_REFUSED.

_DEMO_LOOPS_CSV=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/demo_loops.csv
# Exit code of the program for a file that cannot be used.
_UNUSABLE_DATA=5

DEMO_LOOPS_NEW=0
DEMO_LOOPS_KNOWN=0
DEMO_LOOPS_REFUSED=0

_read_catalogue() {
  mapfile -t _DEMO_CATALOGUE < <(demo_sql "$1" postgres loopscope "SELECT name FROM loopscope.loop")
}

_is_in_catalogue() {
  local name
  for name in "${_DEMO_CATALOGUE[@]}"; do
    [ "$name" != "$1" ] || return 0
  done
  return 1
}

# A run that was cut short between the rows and the catalogue leaves rows without a loop, and the
# import refuses tags that have rows.
_forget_stray_rows() {
  [ -n "$(demo_sql "$1" postgres plant "SELECT to_regclass('public.history')")" ] || return 0
  local tags
  tags=$(demo_sql "$1" postgres loopscope "SELECT string_agg(quote_literal(tag), ',') FROM loopscope.loop,
    unnest(ARRAY[sp_tag, pv_tag, op_tag, mv_tag, mode_tag]) AS tag WHERE tag IS NOT NULL")
  demo_sql "$1" postgres plant "DELETE FROM public.history${tags:+ WHERE tag NOT IN ($tags)}"
}

# FOLDER LOOP TYPE FILE
_import() {
  local code=0 kind=()
  [ -z "$3" ] || kind=(--type "$3")
  "$LOOPSCOPE" import --config "$1/loopscope.json" --create-table --loop "$2" "${kind[@]}" "$4" \
    >/dev/null || code=$?
  case $code in
    0) DEMO_LOOPS_NEW=$((DEMO_LOOPS_NEW + 1)) ;;
    "$_UNUSABLE_DATA") DEMO_LOOPS_REFUSED=$((DEMO_LOOPS_REFUSED + 1)) ;;
    *) die "the import of $4 failed" "its words stand above" "$code" ;;
  esac
}

demo_import_simulated() {
  local loop scenario seed type file
  mkdir -p "$1/recordings"
  _read_catalogue "$1"
  _forget_stray_rows "$1"
  while IFS=, read -r loop scenario seed type; do
    if _is_in_catalogue "$loop"; then
      DEMO_LOOPS_KNOWN=$((DEMO_LOOPS_KNOWN + 1))
      continue
    fi
    file=$1/recordings/$loop.csv
    "$LOOPSCOPE" simulate "$scenario" --seed "$seed" --no-mv --out "$file"
    _import "$1" "$loop" "$type" "$file"
  done < <(tail -n +2 "$_DEMO_LOOPS_CSV")
}

_manifest_of() {
  local candidate
  for candidate in "$1/manifest.csv" "$1/../manifest.csv"; do
    if [ -f "$candidate" ]; then
      printf '%s\n' "$candidate"
      return
    fi
  done
}

# The kind of loop that a manifest (file,loop,type,...) gives a recording; nothing when it has none.
_kind_of() {
  [ -n "$1" ] || return 0
  awk -F, -v file="$(basename "$2")" \
    '{ name = $1; sub(/.*\//, "", name) } name == file { print $3; exit }' "$1"
}

demo_import_recordings() {
  local file loop manifest
  manifest=$(_manifest_of "$2")
  [ -n "$manifest" ] || step "no manifest.csv in $2 or beside it: of what kind the loops are is left open"
  _read_catalogue "$1"
  _forget_stray_rows "$1"
  for file in "$2"/*.csv; do
    loop=$(basename "$file" .csv)
    if [ "$loop" = manifest ]; then
      continue
    elif _is_in_catalogue "$loop"; then
      DEMO_LOOPS_KNOWN=$((DEMO_LOOPS_KNOWN + 1))
    else
      _import "$1" "$loop" "$(_kind_of "$manifest" "$file")" "$file"
    fi
  done
}
