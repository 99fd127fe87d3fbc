# shellcheck shell=bash
# How one fuzz target is run and what is told of it. Source this file from the top of the checkout.
#
#   fuzz_target TARGET SECONDS RUNS   runs it; figures into $FUZZ_OUT/TARGET.result
#   fuzz_table TARGET...              the table; fuzz_json the same as one JSON object
#   fuzz_findings TARGET...           says what was found, how to repeat it, and which target ran nothing; 1
#                                     when there is any

FUZZ_DIR=tests/fuzz
FUZZ_OUT=build/fuzz/runs
# One input, by the clock: under the sanitizers a loop model takes seconds, minutes where the cores are busy.
FUZZ_HANG_S=300
FUZZ_MEMORY_MB=2048
FUZZ_TARGETS=(window analyze historian_rows recording settings catalogue discovery array_literal binary_array)

is_fuzz_target() {
  local target
  for target in "${FUZZ_TARGETS[@]}"; do
    [ "$target" != "$1" ] || return 0
  done
  return 1
}

# What a target is about: its coverage is told of these files.
fuzz_sources() {
  case $1 in
    settings) printf '%s\n' config daemon/service/historians/storage_settings.cpp ;;
    recording) printf '%s\n' daemon/recording daemon/output/recording_csv.cpp core/signal/{assemble,base_interval,grid,window_digest}.cpp ;;
    catalogue) printf '%s\n' daemon/catalogue/{catalogue_csv,entry_fields}.cpp daemon/text/csv_table.cpp ;;
    discovery) printf '%s\n' daemon/catalogue/{discover_loops,naming_rules,tag_pattern}.cpp ;;
    binary_array) printf '%s\n' storage/historian/binary_array.cpp ;;
    array_literal) printf '%s\n' storage/{array_literal,timestamp,utf8}.cpp daemon/text/cell_failure.cpp ;;
    historian_rows) printf '%s\n' storage/historian/{scan_rows,binary_array,merge_series,mode_codes,native_time}.cpp ;;
    analyze) printf '%s\n' core/{signal,hos,loop,model,diagnosis} daemon/recording daemon/output/{analysis,model}_{json,text}.cpp ;;
    window) printf '%s\n' core/{signal,hos,loop,model,diagnosis} daemon/output/{analysis,model}_{json,text}.cpp ;;
  esac
}

# Percentage of lines reached of the files that the target is about, or "-".
fuzz_line_coverage() {
  local target=$1 raw=$FUZZ_OUT/$1.profraw data=$FUZZ_OUT/$1.profdata
  [ -s "$raw" ] || { printf -- '-' && return; }
  llvm-profdata merge -sparse "$raw" -o "$data"
  # Columns of the report: name, then regions, functions, lines and branches, each as how many there
  # are, how many were missed, per cent.
  llvm-cov report "build/fuzz/tests/fuzz/fuzz_$target" -instr-profile="$data" |
    awk -v sources="$(fuzz_sources "$target" | paste -sd ' ')" '
      BEGIN { count = split(sources, prefix, " ") }
      { for (k = 1; k <= count; k++) if (index($1, prefix[k]) == 1) { lines += $8; missed += $9; break } }
      END { if (lines > 0) printf "%.1f", 100 * (lines - missed) / lines; else printf "-" }'
}

fuzz_target() {
  local target=$1 seconds=$2 runs=$3 code=0 dictionary=()
  local log=$FUZZ_OUT/$target.log program=build/fuzz/tests/fuzz/fuzz_$target
  local found=build/fuzz/corpus/$target findings=build/fuzz/findings/$target
  mkdir -p "$found" "$findings"
  [ ! -e "$FUZZ_DIR/dictionaries/$target.dict" ] || dictionary=("-dict=$FUZZ_DIR/dictionaries/$target.dict")
  LLVM_PROFILE_FILE=$FUZZ_OUT/$target.profraw ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 \
    "$program" -max_total_time="$seconds" -runs="$runs" -timeout="$FUZZ_HANG_S" \
    -rss_limit_mb="$FUZZ_MEMORY_MB" -max_len=16384 -print_final_stats=1 "${dictionary[@]}" \
    -artifact_prefix="$findings/" "$found" "$FUZZ_DIR/corpus/$target" >"$log" 2>&1 || code=$?
  printf '%s\n' "$code" >"$FUZZ_OUT/$target.result"
}

# A figure of libFuzzer's at its end; 0 where it has none.
_fuzz_stat() {
  sed -n "s/^stat::$2: *//p" "$FUZZ_OUT/$1.log" | tail -n 1 | grep . || printf '0\n'
}

# "target runs seconds runs/s edges line% findings", one target a line.
_fuzz_figures() {
  local target runs seconds edges code
  for target in "$@"; do
    code=$(<"$FUZZ_OUT/$target.result")
    runs=$(_fuzz_stat "$target" number_of_executed_units)
    seconds=$(sed -n 's/^Done [0-9]* runs in \([0-9]*\) second.*/\1/p' "$FUZZ_OUT/$target.log" | tail -n 1)
    edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$FUZZ_OUT/$target.log" | tail -n 1)
    printf '%s %s %s %s %s %s %s\n' "$target" "$runs" "${seconds:-0}" \
      "$((runs / (${seconds:-0} > 0 ? ${seconds:-0} : 1)))" "${edges:-0}" \
      "$(fuzz_line_coverage "$target")" "$((code != 0))"
  done
}

fuzz_table() {
  {
    printf '%s %s %s %s %s %s %s\n' target runs seconds runs/s edges lines_% findings
    _fuzz_figures "$@"
  } | column -t
}

fuzz_json() {
  _fuzz_figures "$@" | awk '
    BEGIN { printf "{" }
    { printf "%s\"%s\": {\"runs\": %d, \"seconds\": %d, \"runs_per_s\": %d, \"edges\": %d, \"lines_percent\": %s, \"findings\": %d}",
        (NR > 1 ? ", " : ""), $1, $2, $3, $4, $5, ($6 == "-" ? "null" : $6), $7 }
    END { print "}" }'
}

fuzz_findings() {
  local target input found=0
  for target in "$@"; do
    if [ "$(<"$FUZZ_OUT/$target.result")" -ne 0 ]; then
      found=1
      input=$(sed -n 's/.*Test unit written to //p' "$FUZZ_OUT/$target.log" | tail -n 1)
      printf 'error: finding, target %s\nHINT: see %s; repeat with  build/fuzz/tests/fuzz/fuzz_%s %s\n' \
        "$target" "$FUZZ_OUT/$target.log" "$target" "$input" >&2
    elif [ "$(_fuzz_stat "$target" number_of_executed_units)" -eq 0 ]; then
      found=1
      printf 'error: nothing was run, target %s\nHINT: see %s\n' "$target" "$FUZZ_OUT/$target.log" >&2
    fi
  done
  return "$found"
}
