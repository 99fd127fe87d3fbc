# shellcheck shell=bash
# Runs what build.sh has built and sums what the tests recorded. Source this file after build.sh.
#
#   run_tests PRESET LOG CTEST OPTION...   ctest, its words to standard output and into LOG
#   sum_tests PRESET [OPTION...]           what was skipped and why, what failed; its last line is
#                                          "tests: P passed, F failed, S skipped" (tests/support/sum_records)
#
# Both say by their exit code whether something failed. Each test program writes what it ran into
# build/PRESET/test-records, so that a program that ends early is seen: ctest knows only exit codes.

run_tests() {
  local preset=$1 log=$2 records=$_CHECKOUT/build/$1/test-records
  shift 2
  rm -rf "$records"
  mkdir -p "$records"
  (
    cd "$_CHECKOUT" || exit
    ctest --preset "$preset" "$@" --show-only=json-v1 >"$records/ctest.json" || exit
    LOOPSCOPE_TEST_RECORDS=$records ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error \
      --output-junit "$records/ctest.xml" "$@" 2>&1 | tee "$log"
  )
}

sum_tests() {
  local preset=$1
  shift
  "$_CHECKOUT/tests/support/sum_records" "$_CHECKOUT/build/$preset/test-records" "$@"
}
