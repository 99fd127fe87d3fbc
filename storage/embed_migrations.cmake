# Writes OUTPUT, a source file that holds the migrations FILES in the order of their numbers, which
# begin at 101: the numbers below are those of the superseded ones (storage/results/schema/superseded_migrations).
list(SORT FILES)
set(entries "")
set(expected 101)
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME_WE)
  if(NOT name MATCHES "^([0-9][0-9][0-9][0-9])_")
    message(FATAL_ERROR "a migration is named NNNN_what.sql, not ${file}")
  endif()
  math(EXPR number "1${CMAKE_MATCH_1} - 10000")
  if(NOT number EQUAL expected)
    message(FATAL_ERROR "migration ${expected} is missing or there twice, at ${file}")
  endif()
  math(EXPR expected "${expected} + 1")
  file(SHA256 ${file} sha256)
  file(READ ${file} sql)
  string(APPEND entries "    {${number}, \"${name}\", \"${sha256}\",\n     R\"migration(${sql})migration\"},\n")
endforeach()

file(WRITE ${OUTPUT} "#include \"storage/results/schema/embedded_migrations.hpp\"

namespace loopscope::storage {
namespace {

const Migration kMigrations[] = {
${entries}};

}  // namespace

std::span<const Migration> embedded_migrations() { return kMigrations; }

}  // namespace loopscope::storage
")
