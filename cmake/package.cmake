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
set(components command studio room library dev data doc)
if(TARGET karinui_python)
  list(APPEND components python)
endif()
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(same "(= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME karinui)
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "karinui-data ${same}")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "karinui-doc, karinui-studio")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "made-to-measure clothes, draped, as true-size patterns
The command: plays operations on a garment, drapes it on a body, examines it
and writes pictures, 3D files and paper patterns at true size.")

set(CPACK_DEBIAN_STUDIO_PACKAGE_NAME karinui-studio)
set(CPACK_DEBIAN_STUDIO_PACKAGE_DEPENDS "karinui ${same}")
set(CPACK_DEBIAN_STUDIO_PACKAGE_RECOMMENDS karinui-doc)
set(CPACK_DEBIAN_STUDIO_DESCRIPTION "design made-to-measure clothes on a body in 3D
The window: draw lines on a body, sew, cut and pull the cloth, see where it is
tight, and print the pattern.")

set(CPACK_DEBIAN_ROOM_PACKAGE_NAME karinui-room)
set(CPACK_DEBIAN_ROOM_PACKAGE_DEPENDS "karinui ${same}")
set(CPACK_DEBIAN_ROOM_DESCRIPTION "made-to-measure clothes, designed in a headset
The fitting by OpenXR: the body before you, the pattern on a table, the tools
of the studio in your hands.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libkarinui${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
file(WRITE ${CMAKE_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_BINARY_DIR}/triggers)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "karinui ${same}")  # whose process reads strangers' bodies
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "library of garments, patterns and drapes
Documents, operations, drape, examination and files of made-to-measure
clothes, as one shared library.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libkarinui-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME} ${same}, libcairo2-dev, libeigen3-dev, \
libfontconfig-dev, libgeos-dev, libsqlite3-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "library of garments, patterns and drapes (development)
Headers, the shared library's link and static libraries, found by
find_package(karinui) of CMake.")

set(CPACK_DEBIAN_DATA_PACKAGE_NAME karinui-data)
set(CPACK_DEBIAN_DATA_DESCRIPTION "made-to-measure clothes: examples and what other programs need
Example garments as scripts, the type of documents for file managers, and the
add-on for Blender.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME karinui-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_DESCRIPTION "made-to-measure clothes: the guide, in English and Japanese
How to draw, sew, drape, fit and print, with pictures; and the formats of files
and operations.")
foreach(name DATA DOC)
  set(CPACK_DEBIAN_${name}_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_${name}_PACKAGE_SHLIBDEPS OFF)
endforeach()

# The module is for one version of Python.
if(TARGET karinui_python)
  get_directory_property(minor DIRECTORY python DEFINITION Python_VERSION_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-karinui)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-numpy, karinui ${same}")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "garments, patterns and drapes from Python
Open, change, drape, measure and export made-to-measure clothes; cloth and
bodies as arrays of numpy.")
endif()

# Policy asks each package for its copyright and its changelog.
configure_file(packaging/debian-changelog.in debian-changelog @ONLY)
execute_process(COMMAND gzip -9nc ${CMAKE_BINARY_DIR}/debian-changelog
  OUTPUT_FILE ${CMAKE_BINARY_DIR}/changelog.gz)
foreach(component ${components})
  string(TOUPPER ${component} name)
  install(FILES packaging/copyright ${CMAKE_BINARY_DIR}/changelog.gz COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  # What Debian's examiner of packages, lintian, is told to pass over, with the reason.
  install(FILES packaging/lintian-overrides COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
endforeach()
include(CPack)
