# Debian packages, one a component: `cpack --config build/release/CPackConfig.cmake -B out/packages`, or scripts/package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Karinui)
# Who makes the packages, as Debian's tools are told.
set(packager Karinui)
set(address karinui@localhost)
if(DEFINED ENV{DEBEMAIL})
  set(address $ENV{DEBEMAIL})
endif()
if(DEFINED ENV{DEBFULLNAME})
  set(packager $ENV{DEBFULLNAME})
endif()
set(CPACK_PACKAGE_CONTACT "${packager} <${address}>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command studio room dev)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME karinui)
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "made-to-measure clothes, draped, as true-size patterns
The command: plays operations on a garment, drapes it on a body, examines it
and writes pictures, 3D files and paper patterns at true size.")
set(CPACK_DEBIAN_STUDIO_PACKAGE_NAME karinui-studio)
set(CPACK_DEBIAN_STUDIO_DESCRIPTION "design made-to-measure clothes on a body in 3D
The window: draw lines on a body, sew, cut and pull the cloth, see where it is
tight, and print the pattern.")
set(CPACK_DEBIAN_ROOM_PACKAGE_NAME karinui-room)
set(CPACK_DEBIAN_ROOM_DESCRIPTION "made-to-measure clothes, designed in a headset
The fitting by OpenXR: the body before you, the pattern on a table, the tools
of the studio in your hands.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libkarinui-dev)
set(CPACK_DEBIAN_DEV_DESCRIPTION "library of garments, patterns and drapes (development)
Headers and static libraries, found by find_package(karinui) of CMake.")
foreach(name STUDIO ROOM)
  set(CPACK_DEBIAN_${name}_PACKAGE_DEPENDS "karinui (= ${PROJECT_VERSION})")
endforeach()
# The module for Python is for one version of it.
get_directory_property(python DIRECTORY python DEFINITION Python_VERSION_MINOR)
if(TARGET karinui_python)
  math(EXPR next "${python} + 1")
  set(python "python3 (>= 3.${python}), python3 (<< 3.${next}), ")
else()
  set(python)
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "${python}karinui (= ${PROJECT_VERSION}), libcairo2-dev, libeigen3-dev, libfontconfig-dev, libgeos-dev, libsqlite3-dev, nlohmann-json3-dev")

# Policy asks each package for its copyright and its changelog.
configure_file(packaging/debian-changelog.in debian-changelog @ONLY)
execute_process(COMMAND gzip -9nc ${CMAKE_BINARY_DIR}/debian-changelog
  OUTPUT_FILE ${CMAKE_BINARY_DIR}/changelog.gz)
foreach(component command studio room dev)
  string(TOUPPER ${component} name)
  install(FILES packaging/copyright ${CMAKE_BINARY_DIR}/changelog.gz COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  # What Debian's examiner of packages, lintian, is told to pass over, with the reason.
  install(FILES packaging/lintian-overrides COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
endforeach()
include(CPack)
