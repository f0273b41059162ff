# Debian packages, one per component: `cmake --workflow --preset packages` writes them into build/packages.
#
#   libsvnet0       library      the shared library
#   libsvnet-dev    development  headers, static library, pkg-config, CMake package, examples
#   svnet           commands     the commands, configurations, documentation
#   python3-svnet   python       the Python module, if it was built for Debian's Python
#
# Depends of programs and libraries come from dpkg-shlibdeps. A wheel has its own metadata: pyproject.toml.
if(SKBUILD)
  return()
endif()
include(GNUInstallDirs)

set(SVNET_MAINTAINER "svnet maintainers <maintainers@svnet.invalid>" CACHE STRING "Maintainer of the Debian packages")
set(SVNET_PACKAGE_RELEASE 1 CACHE STRING "Debian revision: the part of a package's version after the dash")
set(package_version ${PROJECT_VERSION}-${SVNET_PACKAGE_RELEASE})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME svnet)
set(CPACK_PACKAGE_CONTACT ${SVNET_MAINTAINER})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${SVNET_PACKAGE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL library development)

# CPack indents lines and does not wrap them.
set(about "svnet predicts from an object's top image how informative the view from each
camera pose on the upper half-sphere would be.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libsvnet0)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/packaging/shlibs CONTENT "libsvnet 0 libsvnet0 (>= @PROJECT_VERSION@)\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/packaging/libsvnet0/triggers ${PROJECT_BINARY_DIR}/packaging/shlibs)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "semantic view selection: shared library\n${about}
This package has the shared library, which programs in C and C++ use.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsvnet-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libsvnet0 (= ${package_version}), libhwy-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "semantic view selection: headers and static library\n${about}
This package has the headers for C and C++, the static library, the files for
pkg-config and CMake, and examples.")

if(SVNET_COMMANDS)
  list(APPEND CPACK_COMPONENTS_ALL commands)
  set(CPACK_DEBIAN_COMMANDS_PACKAGE_NAME svnet)
  set(CPACK_DEBIAN_COMMANDS_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_COMMANDS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_COMMANDS_PACKAGE_SUGGESTS "openmpi-bin, libsvnet-dev, python3-svnet")
  set(CPACK_DEBIAN_COMMANDS_DESCRIPTION "semantic view selection: commands\n${about}
This package has the commands that train, evaluate and use models, example
configurations and the documentation.")
endif()

if(TARGET svnet_python)
  get_target_property(soabi svnet_python SVNET_SOABI)
  execute_process(COMMAND /usr/bin/python3 -c "import sysconfig; print(sysconfig.get_config_var('SOABI'))"
    OUTPUT_VARIABLE debian_soabi OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(soabi MATCHES "^cpython-3([0-9]+)-" AND soabi STREQUAL debian_soabi)
    math(EXPR next_minor "${CMAKE_MATCH_1} + 1")
    list(APPEND CPACK_COMPONENTS_ALL python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-svnet)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${CMAKE_MATCH_1}), python3 (<< 3.${next_minor}), python3-numpy (>= 1:1.23)")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      ${PROJECT_SOURCE_DIR}/packaging/python3-svnet/postinst ${PROJECT_SOURCE_DIR}/packaging/python3-svnet/prerm)
    set(CPACK_DEBIAN_PYTHON_DESCRIPTION "semantic view selection: Python module\n${about}
This package has the module svnet for Python 3: features of images, clustering,
semantic scores and predictions.")
  else()
    message(STATUS "python3-svnet: left out of the packages, the module is for ${soabi}, Debian's Python is ${debian_soabi}")
  endif()
endif()

# What Debian wants in the documentation folder of each package.
string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, if it is set
configure_file(${PROJECT_SOURCE_DIR}/packaging/changelog.in ${PROJECT_BINARY_DIR}/packaging/changelog.Debian @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_BINARY_DIR}/packaging/changelog COPYONLY)
execute_process(COMMAND gzip -9nkf changelog changelog.Debian WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/packaging
  COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} key)
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/copyright ${PROJECT_BINARY_DIR}/packaging/changelog.Debian.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${key}_PACKAGE_NAME} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libsvnet-dev COMPONENT development
  EXCLUDE_FROM_ALL)
if(SVNET_COMMANDS)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/svnet COMPONENT commands)
  install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_BINARY_DIR}/packaging/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/svnet COMPONENT commands EXCLUDE_FROM_ALL)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/svnet COMPONENT commands
    EXCLUDE_FROM_ALL PATTERN "*.py" EXCLUDE)
endif()
include(CPack)
