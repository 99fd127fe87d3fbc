# Writes OUTPUT, a source file that holds FILE, the script of the group roles.
file(READ ${FILE} sql)
file(WRITE ${OUTPUT} "#include \"storage/results/schema/results_sql.hpp\"

namespace loopscope::storage {

std::string_view roles_script() { return R\"roles(${sql})roles\"; }

}  // namespace loopscope::storage
")
