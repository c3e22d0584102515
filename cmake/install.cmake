# What is installed where, by component: command, studio, room, library, dev, python, data, doc.
# `cmake --install build/release --component command` installs one.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Debian's policy wants manual pages compressed.
function(install_manual name component)
  set(page ${CMAKE_BINARY_DIR}/${name}.1.gz)
  execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/packaging/man/${name}.1 OUTPUT_FILE ${page} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endfunction()

install(TARGETS karinui COMPONENT command)
install(TARGETS karinui-import DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/karinui COMPONENT command)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/karinui COMPONENT data)
install(DIRECTORY docs/user docs/format DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(FILES README.md README.ja.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
# What it is made of: a bill of materials.
install(CODE "execute_process(COMMAND ${PROJECT_SOURCE_DIR}/scripts/sbom ${CMAKE_BINARY_DIR}
  -o \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/doc/karinui/karinui.spdx.json COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT command)
install_manual(karinui command)
install(FILES packaging/linux/karinui.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME karinui COMPONENT command)
install(FILES packaging/linux/karinui.mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME karinui.xml COMPONENT data)
if(TARGET karinui-studio)
  install(TARGETS karinui-studio COMPONENT studio)
  install_manual(karinui-studio studio)
  install(FILES packaging/linux/karinui-studio.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT studio)
  install(FILES packaging/linux/karinui-studio.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT studio)
  install(FILES packaging/linux/karinui-studio.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT studio)
endif()
if(TARGET karinui-room)
  install(TARGETS karinui-room COMPONENT room)
  install_manual(karinui-room room)
endif()
# Blender's add-on lies where its preferences find it: Edit > Preferences > Add-ons > Install needs no internet either.
install(DIRECTORY python/blender_karinui DESTINATION ${CMAKE_INSTALL_DATADIR}/blender/scripts/addons COMPONENT data
  FILES_MATCHING PATTERN "*.py")
if(TARGET karinui_python)
  install(TARGETS karinui_python DESTINATION lib/python3/dist-packages COMPONENT python)
  install(FILES python/karinui.pyi DESTINATION lib/python3/dist-packages COMPONENT python)
endif()

# The library: find_package(karinui), then karinui::session and all below it, or any one module, karinui::cloth: static. All of
# them in one shared library are karinui::karinui.
set(modules base geometry body pattern cloth check design exchange scene touch session)
foreach(module ${modules})
  set_target_properties(karinui_${module} PROPERTIES EXPORT_NAME ${module})
endforeach()
set_target_properties(karinui_flags PROPERTIES EXPORT_NAME flags)
list(TRANSFORM modules PREPEND karinui_ OUTPUT_VARIABLE libraries)
list(TRANSFORM libraries REPLACE ".+" "$<TARGET_OBJECTS:\\0>" OUTPUT_VARIABLE objects)
add_library(karinui_shared SHARED ${objects})
set_target_properties(karinui_shared PROPERTIES OUTPUT_NAME karinui EXPORT_NAME karinui LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # before 1.0 a minor version may change it
target_link_libraries(karinui_shared PRIVATE ${libraries})  # for what they are linked with themselves
target_include_directories(karinui_shared INTERFACE $<INSTALL_INTERFACE:include>)
install(TARGETS ${libraries} karinui_flags EXPORT karinui ARCHIVE COMPONENT dev)
install(TARGETS karinui_shared EXPORT karinui LIBRARY COMPONENT library NAMELINK_COMPONENT dev)
install(DIRECTORY include/karinui DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/karinui)
install(EXPORT karinui NAMESPACE karinui:: FILE karinui-targets.cmake DESTINATION ${config} COMPONENT dev)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/karinui-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/karinui-config.cmake ${CMAKE_BINARY_DIR}/karinui-config-version.cmake DESTINATION ${config} COMPONENT dev)
