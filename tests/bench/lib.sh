# shellcheck shell=bash
# What both benchmark commands begin with. Source this file from the top of the checkout.

# prepare_bench TARGET...: installs what is missing and builds the targets, optimised; silent but
# for errors, since standard output belongs to the figures.
prepare_bench() {
  # shellcheck source-path=SCRIPTDIR source=../../deploy/lib/say.sh
  . deploy/lib/say.sh
  # shellcheck source-path=SCRIPTDIR source=../../deploy/lib/packages.sh
  . deploy/lib/packages.sh
  need_packages build run test bench >&2
  local log=build/bench-build.log
  mkdir -p build
  if ! { cmake --preset release && ninja -C build/release "$@"; } >"$log" 2>&1; then
    tail -n 30 "$log" >&2
    die "the build failed" "see $log"
  fi
}
