# The Debian package: what is installed where, and how CPack puts it together. deploy/package/build
# makes it; `cmake --install` alone puts only the program, page and completion under a prefix.
include(GNUInstallDirs)

set(DEPLOY_DIR ${PROJECT_SOURCE_DIR}/deploy)
set(PACKAGE_DIR ${CMAKE_CURRENT_BINARY_DIR}/package_files)
set(DEBIAN_VERSION ${PROJECT_VERSION}-1)
# SOURCE_DATE_EPOCH, where it is set, makes two builds of one commit alike.
string(TIMESTAMP PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
string(TIMESTAMP PACKAGE_DAY "%Y-%m-%d" UTC)
set(PACKAGE_MAINTAINER "Loopscope maintainers <loopscope@packages.invalid>")

# FROM, with @VARIABLES@ filled in, compressed as Debian wants it into PACKAGE_DIR/TO.gz.
function(loopscope_compressed from to)
  configure_file(${from} ${PACKAGE_DIR}/${to} @ONLY)
  add_custom_command(OUTPUT ${PACKAGE_DIR}/${to}.gz
    COMMAND gzip -9nkf ${PACKAGE_DIR}/${to}
    DEPENDS ${PACKAGE_DIR}/${to} VERBATIM)
endfunction()

loopscope_compressed(${DEPLOY_DIR}/man/loopscope.1 loopscope.1)
loopscope_compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog)
loopscope_compressed(${DEPLOY_DIR}/package/changelog.Debian changelog.Debian)
add_custom_target(loopscope_package_files ALL DEPENDS
  ${PACKAGE_DIR}/loopscope.1.gz ${PACKAGE_DIR}/changelog.gz ${PACKAGE_DIR}/changelog.Debian.gz)
add_dependencies(loopscope_package_files loopscope)

install(FILES ${PACKAGE_DIR}/loopscope.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${DEPLOY_DIR}/completion/loopscope DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

# What only a Debian system has a place for.
set(DOC_DIR ${CMAKE_INSTALL_DATADIR}/doc/loopscope)
function(loopscope_debian_files destination)
  install(FILES ${ARGN} DESTINATION ${destination} COMPONENT debian EXCLUDE_FROM_ALL)
endfunction()
# Links included: the units share their drop-ins.
install(DIRECTORY ${DEPLOY_DIR}/systemd/ DESTINATION /lib/systemd/system COMPONENT debian EXCLUDE_FROM_ALL)
loopscope_debian_files(${DOC_DIR}
  ${PACKAGE_DIR}/changelog.gz ${PACKAGE_DIR}/changelog.Debian.gz
  ${DEPLOY_DIR}/package/copyright ${DEPLOY_DIR}/RUNBOOK.md)
loopscope_debian_files(${DOC_DIR}/examples
  ${DEPLOY_DIR}/package/examples/loopscope.json ${DEPLOY_DIR}/package/examples/pg_service.conf
  ${DEPLOY_DIR}/package/examples/reports.conf
  ${DEPLOY_DIR}/roles.sql)
loopscope_debian_files(${DOC_DIR}/examples/prometheus
  ${DEPLOY_DIR}/prometheus/loopscope.rules.yml)

configure_file(${DEPLOY_DIR}/queries/QUERIES.md ${PACKAGE_DIR}/queries.md COPYONLY)
loopscope_debian_files(${DOC_DIR} ${PACKAGE_DIR}/queries.md)
loopscope_debian_files(${DOC_DIR}/examples/grafana
  ${DEPLOY_DIR}/grafana/loopscope.json ${DEPLOY_DIR}/grafana/datasources.yml ${DEPLOY_DIR}/grafana/dashboards.yml
  ${DEPLOY_DIR}/grafana/README.md)
loopscope_debian_files(${DOC_DIR}/examples/hooks ${DEPLOY_DIR}/hooks/loopscope-hook.service)
install(PROGRAMS ${DEPLOY_DIR}/hooks/loopscope-hook DESTINATION ${DOC_DIR}/examples/hooks
  COMPONENT debian EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME loopscope)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${PACKAGE_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "finds out why control loops perform poorly")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Loopscope watches the historian tables of a plant in PostgreSQL, takes a
window of samples of every control loop on a schedule, and writes indices, a
verdict with its reasons and the next action back into SQL. It finds sticking
valves, poor tuning, sensor faults and disturbances from routine operating
data alone.
.
This package holds the program, its systemd units, its manual page, ready
queries and examples of settings, roles, alert rules, a dashboard and a hook.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS
  "${PROJECT_BINARY_DIR};loopscope;Unspecified;/" "${PROJECT_BINARY_DIR};loopscope;debian;/")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
# Only the program is needed, and deploy/package/build has built it: no tests, no benchmarks.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# procps: kill, for `systemctl reload`. tzdata: the time zones of plants.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "adduser, procps, tzdata")
# gnuplot-nox: the pictures of reports and pages.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, postgresql-client, systemd")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "bash-completion, postgresql, prometheus, weasyprint")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${DEPLOY_DIR}/package/postinst ${DEPLOY_DIR}/package/prerm ${DEPLOY_DIR}/package/postrm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
