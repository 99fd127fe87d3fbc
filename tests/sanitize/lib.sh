# shellcheck shell=bash
# The runs of tests/sanitize/run. Source this file from the top of the checkout, after
# deploy/lib/run_tests.sh.
#
#   sanitize_asan, sanitize_asan_short, sanitize_asan_core, sanitize_tsan   build and run; 1 when a test failed
#   sanitize_table                                      what was run, with figures

# A report ends the test, so that none is overlooked.
export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$PWD/tests/sanitize/tsan.supp

_SANITIZE_ROWS=()
_SANITIZE_ALLOWED=(.ci/allowed_skips tests/sanitize/allowed_skips)

# NAME PRESET TARGETS -- CTEST OPTION...: the targets are built, then ctest runs what is selected. A
# skip that is on neither list of _SANITIZE_ALLOWED fails as well.
_sanitize() {
  local name=$1 preset=$2 targets=() log code=0 built figures
  shift 2
  while [ "$1" != -- ]; do
    targets+=("$1")
    shift
  done
  shift
  log=build/$preset/sanitize-$name.log
  built=$SECONDS
  build "$preset" "${targets[@]}"
  built=$((SECONDS - built))
  step "running $name"
  run_tests "$preset" "$log" "$@" >/dev/null || code=$?
  [ "$code" -eq 0 ] || sed -n '/tests passed/,$p' "$log" >&2
  figures=$(sum_tests "$preset" "${_SANITIZE_ALLOWED[@]/#/--allowed=}") || code=1
  printf '%s\n' "$figures"
  _SANITIZE_ROWS+=("$name $(_sanitize_figures "$log" "$figures") $built")
  [ "$code" -eq 0 ] || printf 'error: %s found something\nHINT: see %s\n' "$name" "$log" >&2
  return "$code"
}

# "tests failed skipped seconds" out of the sum's last line and ctest's words.
_sanitize_figures() {
  awk '/^tests: / { passed = $2; failed = $4; skipped = $6 }
       /Total Test time/ { seconds = $6 }
       END { printf "%d %d %d %d", passed + failed + skipped, failed, skipped, seconds }' "$1" - <<<"$2"
}

sanitize_asan() {
  _sanitize asan asan core_tests config_tests daemon_tests storage_tests effects_tests fuzz_targets -- \
    --tests-regex '^(core|config|daemon|storage|effects|fuzz|postgres)\.'
}

# NAME PRESET ROOMS TARGET...: the tests of these rooms that are short and need no server; those that need
# one are skipped, and counted as such in the table.
_sanitize_short_tests() {
  local name=$1 preset=$2 rooms=$3 _SANITIZE_ALLOWED=("${_SANITIZE_ALLOWED[@]}" tests/sanitize/no_server)
  shift 3
  _sanitize "$name" "$preset" "$@" -- --tests-regex "^($rooms)\\." --fixture-exclude-any postgres \
    --label-exclude '^long$'
}

sanitize_asan_short() {
  _sanitize_short_tests asan-short asan 'core|config|daemon|storage|fuzz' \
    core_tests config_tests daemon_tests storage_tests fuzz_targets
}

# The seeds of the fuzz targets go through everything that parses bytes from outside: recordings and
# catalogues in daemon/, rows of historians in storage/. Four checks of UndefinedBehaviorSanitizer are left to
# the other runs: they take a third of the time of building, and what two of them see ends a test under
# AddressSanitizer as well (a null pointer, a read past an object).
sanitize_asan_core() {
  _sanitize_short_tests asan-core asan-core 'core|config|fuzz' core_tests config_tests fuzz_targets
}

sanitize_tsan() {
  _sanitize tsan tsan daemon_tests storage_tests end_to_end_tests -- \
    --tests-regex '^(daemon|storage|end_to_end|postgres)\.'
}

sanitize_table() {
  {
    printf 'run tests failed skipped test_s build_s\n'
    printf '%s\n' "${_SANITIZE_ROWS[@]}"
  } | column -t
}
