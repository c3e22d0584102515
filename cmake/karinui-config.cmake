# Found by find_package(karinui). What the static libraries are linked with is found too.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3)
find_dependency(SQLite3)
find_dependency(nlohmann_json)
find_dependency(PkgConfig)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo cairo-pdf cairo-ft fontconfig)
include(${CMAKE_CURRENT_LIST_DIR}/karinui-targets.cmake)
