# shellcheck shell=bash
# What both benchmark commands begin with. Source this file from the top of the checkout.

# prepare_bench TARGET...: installs what is missing and builds the targets, optimised; says so on
# standard error, since standard output belongs to the figures.
prepare_bench() {
  # shellcheck source-path=SCRIPTDIR source=../../deploy/lib/say.sh
  . deploy/lib/say.sh
  # shellcheck source-path=SCRIPTDIR source=../../deploy/lib/packages.sh
  . deploy/lib/packages.sh
  # shellcheck source-path=SCRIPTDIR source=../../deploy/lib/build.sh
  . deploy/lib/build.sh
  {
    need_packages build run test bench
    build release "$@"
  } >&2
}
