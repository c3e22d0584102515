# What is installed where, by component: command, studio, room, dev. `cmake --install build/release --component command`.
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
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/karinui COMPONENT command)
install(DIRECTORY docs/user docs/format DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
install(FILES README.md README.ja.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
# What it is made of: a bill of materials.
install(CODE "execute_process(COMMAND ${PROJECT_SOURCE_DIR}/scripts/sbom ${CMAKE_BINARY_DIR}
  -o \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/doc/karinui/karinui.spdx.json COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT command)
install_manual(karinui command)
install(FILES packaging/linux/karinui.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME karinui COMPONENT command)
install(FILES packaging/linux/karinui.mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME karinui.xml COMPONENT command)
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
install(DIRECTORY python/blender_karinui DESTINATION ${CMAKE_INSTALL_DATADIR}/blender/scripts/addons COMPONENT command
  FILES_MATCHING PATTERN "*.py")
if(TARGET karinui_python)
  install(TARGETS karinui_python DESTINATION lib/python3/dist-packages COMPONENT dev)
  install(FILES python/karinui.pyi DESTINATION lib/python3/dist-packages COMPONENT dev)
endif()

# The library: find_package(karinui), then karinui::session and all below it, or any one module, karinui::cloth.
set(modules base geometry body pattern cloth check design exchange scene touch session)
foreach(module ${modules})
  set_target_properties(karinui_${module} PROPERTIES EXPORT_NAME ${module})
endforeach()
set_target_properties(karinui_flags PROPERTIES EXPORT_NAME flags)
list(TRANSFORM modules PREPEND karinui_ OUTPUT_VARIABLE libraries)
install(TARGETS ${libraries} karinui_flags EXPORT karinui ARCHIVE COMPONENT dev)
install(DIRECTORY include/karinui DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/karinui)
install(EXPORT karinui NAMESPACE karinui:: FILE karinui-targets.cmake DESTINATION ${config} COMPONENT dev)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/karinui-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/karinui-config.cmake ${CMAKE_BINARY_DIR}/karinui-config-version.cmake DESTINATION ${config} COMPONENT dev)
