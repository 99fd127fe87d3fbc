# Asks a test program for its suites and writes a file for ctest that runs each in a process of its own:
# thousands of processes cost more than most tests. Run after the program is linked.
#
#   cmake -DPROGRAM=... -DPREFIX=core. -DOUTPUT=... -DSUITES=tests/suites -DLABELS=... -P this
#
# SUITES: lines "NAME label cost_s" for the suites that have a label or take long; `-` for no label.
# A line that names none of this program's suites, though its prefix, is an error: it is out of date.

cmake_minimum_required(VERSION 3.24)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} does not list its tests: ${code}")
endif()
# Lines that begin at the margin are suites, "Instance/Suite." or "Suite/0.  # TypeParam = ...".
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\.[^\n]*" lines "${listed}")
set(suites)
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^\n?([A-Za-z0-9_/]+)\\..*" "\\1" suite "${line}")
  if(suite MATCHES "^(.+)/[0-9]+$")  # of one type among several
    set(suite ${CMAKE_MATCH_1})
    set(of_types_${suite} TRUE)
  endif()
  list(APPEND suites ${suite})
endforeach()
list(REMOVE_DUPLICATES suites)

set(script "")
file(STRINGS ${SUITES} rows REGEX "^[^# ]")
foreach(row IN LISTS rows)
  string(REGEX REPLACE "[ \t]+" ";" row "${row}")
  list(GET row 0 name)
  list(GET row 1 label_${name})
  list(GET row 2 cost_${name})
  string(FIND "${name}" "${PREFIX}" place)
  if(place EQUAL 0)
    string(LENGTH "${PREFIX}" length)
    string(SUBSTRING "${name}" ${length} -1 suite)
    if(NOT suite IN_LIST suites)
      message(FATAL_ERROR "${SUITES} names ${name}, which ${PROGRAM} does not have")
    endif()
  endif()
endforeach()

foreach(suite IN LISTS suites)
  set(name ${PREFIX}${suite})
  set(labels ${LABELS})
  if(label_${name} AND NOT label_${name} STREQUAL "-")
    list(APPEND labels ${label_${name}})
  endif()
  set(tests ${suite}.*)
  if(of_types_${suite})
    set(tests ${suite}/*)
  endif()
  string(APPEND script
    "add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${tests}]=])\n"
    "set_tests_properties([=[${name}]=] PROPERTIES TIMEOUT 1800 LABELS [=[${labels}]=]")
  if(cost_${name})
    string(APPEND script " COST ${cost_${name}}")
  endif()
  if("server" IN_LIST labels)  # one of PostgreSQL that is started once (tests/support/postgres)
    string(APPEND script " FIXTURES_REQUIRED postgres")
  endif()
  string(APPEND script ")\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
