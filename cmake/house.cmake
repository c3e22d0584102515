# How every part of the house is built: one set of flags, one function for a module, one for its tests.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
find_package(Threads REQUIRED)
find_program(CCACHE ccache)
if(CCACHE)
  # What ccache's manual asks for where headers are precompiled. No base folder, whatever a person has set: ccache would name
  # the sources from the build folder, and __FILE__ with them, which -ffile-prefix-map then does not find.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR= ${CCACHE})
endif()

add_library(karinui_flags INTERFACE)
target_compile_options(karinui_flags INTERFACE -Wall -Wextra -Wshadow -Wno-unknown-warning-option
  # g++ 12 sees an overlap in "text" + std::string that is not there (its bug 105651) and reads of empty optionals that never
  # happen (its bug 80635).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict$<SEMICOLON>-Wno-maybe-uninitialized>
  # Several sources compiled as one are, for g++, headers of it, whose unnamed namespaces a class should not use.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-subobject-linkage>
  # The same operations must give the same bits: no contraction of a*b+c, no reordering of sums.
  -ffp-contract=off -fno-fast-math
  # Nobody asks for errno or for traps of floating point: the numbers stay the same, but more loops become vectors.
  -fno-math-errno -fno-trapping-math
  -fstack-protector-strong
  # g++ looks for garbage in its own memory from 400 MB on, not from 128: a fifteenth of its time.
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=400000>
  # No folder of this machine within a release: the same sources in two folders give the same bytes.
  $<BUILD_INTERFACE:$<$<CONFIG:Release>:-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.>>)
if(KARINUI_WERROR)
  target_compile_options(karinui_flags INTERFACE -Werror)
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  target_compile_definitions(karinui_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_compile_options(karinui_flags INTERFACE -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3)
  # Where compiler and processor have them: jumps only to where one may jump, no stack that grows past its guard page
  # (tests/install/hardened_test). -ftrivial-auto-var-init is left out: with it g++ 12.2 builds wrong trees of boxes.
  include(CheckCXXCompilerFlag)
  set(CMAKE_REQUIRED_FLAGS -Werror)  # clang takes a flag of another processor with a warning
  foreach(flag -fcf-protection=full -mbranch-protection=standard -fstack-clash-protection)
    string(MAKE_C_IDENTIFIER "KARINUI_HAS${flag}" known)
    check_cxx_compiler_flag(${flag} ${known})
    target_compile_options(karinui_flags INTERFACE $<$<BOOL:${${known}}>:${flag}>)
  endforeach()
  unset(CMAKE_REQUIRED_FLAGS)
  # All symbols are bound at the start, and what they were bound to can then not be written; no stack holds code, whatever
  # an object of a library asks for. So bound, -fno-plt would protect nothing more.
  target_link_options(karinui_flags INTERFACE -Wl,-z,relro,-z,now,-z,noexecstack)
endif()
if(KARINUI_SANITIZE)
  # What a sanitizer finds ends the program: a test that goes on would pass.
  set(sanitized "$<NOT:$<BOOL:$<TARGET_PROPERTY:KARINUI_UNSANITIZED>>>")
  target_compile_options(karinui_flags INTERFACE -fno-omit-frame-pointer -O1 -g1
    $<${sanitized}:-fsanitize=${KARINUI_SANITIZE}> $<${sanitized}:-fno-sanitize-recover=all>)
  target_link_options(karinui_flags INTERFACE $<${sanitized}:-fsanitize=${KARINUI_SANITIZE}>)
endif()

# -DKARINUI_MUTANT=seam_off_by_one: a build that is broken on purpose, by tests/mutants/seam_off_by_one.patch. The sources stay
# as they are: the one that the patch is for is compiled from a patched copy in the build folder (scripts/mutants).
set(KARINUI_MUTANT "" CACHE STRING "A patch of tests/mutants to break this build with; empty: none")
if(KARINUI_MUTANT)
  set(KARINUI_MUTANT_PATCH ${PROJECT_SOURCE_DIR}/tests/mutants/${KARINUI_MUTANT}.patch)
  if(NOT EXISTS ${KARINUI_MUTANT_PATCH})
    message(FATAL_ERROR "There is no ${KARINUI_MUTANT_PATCH}")
  endif()
  file(STRINGS ${KARINUI_MUTANT_PATCH} KARINUI_MUTANT_SOURCE REGEX "^\\+\\+\\+ b/")
  string(REPLACE "+++ b/" "${PROJECT_SOURCE_DIR}/" KARINUI_MUTANT_SOURCE "${KARINUI_MUTANT_SOURCE}")
  if(NOT EXISTS "${KARINUI_MUTANT_SOURCE}")
    message(FATAL_ERROR "The patch ${KARINUI_MUTANT} is not for one source that is there: ${KARINUI_MUTANT_SOURCE}")
  endif()
endif()
# In the list named, the source that the mutant is for becomes its patched copy, which is compiled alone. In its place stands
# an empty one, so that no other source of a unity build moves to another unit.
function(karinui_mutate list)
  if(KARINUI_MUTANT AND KARINUI_MUTANT_SOURCE IN_LIST ${list})
    get_filename_component(name ${KARINUI_MUTANT_SOURCE} NAME)
    get_filename_component(folder ${KARINUI_MUTANT_SOURCE} DIRECTORY)
    set(copy ${CMAKE_CURRENT_BINARY_DIR}/${KARINUI_MUTANT}/${name})
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${KARINUI_MUTANT})
    execute_process(COMMAND patch --fuzz=0 --silent --reject-file=- --output=${copy} ${KARINUI_MUTANT_SOURCE} ${KARINUI_MUTANT_PATCH}
      RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "The patch ${KARINUI_MUTANT} does not apply any more; make it anew (git diff -U1)")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${KARINUI_MUTANT_PATCH} ${KARINUI_MUTANT_SOURCE})
    set_source_files_properties(${copy} PROPERTIES INCLUDE_DIRECTORIES ${folder})  # the headers beside it
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${KARINUI_MUTANT}/in_its_place.cpp "")
    list(TRANSFORM ${list} REPLACE "^${KARINUI_MUTANT_SOURCE}$" ${CMAKE_CURRENT_BINARY_DIR}/${KARINUI_MUTANT}/in_its_place.cpp)
    list(APPEND ${list} ${copy})
    set(${list} ${${list}} PARENT_SCOPE)
    message(STATUS "Broken on purpose: ${KARINUI_MUTANT}")
  endif()
endfunction()

# What waits for a hand or a file needs no more than this. g++ takes two thirds to three quarters of the time of -O3 for -O1, and
# a sixth less again for -Og, with which ./test builds.
set(KARINUI_LIGHT -O1 CACHE STRING "How code whose loops are short is optimised")

# karinui_module(cloth USES geometry pattern body LINKS Eigen3::Eigen): the library karinui_cloth from src/cloth/**.cpp,
# its public headers include/karinui/cloth. USES are public, LINKS private. UNCHECKED: its release code does not look
# whether each index is within its array, which costs the inner loops a tenth; what comes from outside was read by others.
# LIGHT: compiled with KARINUI_LIGHT, for modules whose loops are short.
# PRECOMPILED: headers that most of its sources include, beside those of the standard library. What one module has precompiled
# serves all that ask for the same with the same -O: g++ compiles what is inline there with the -O of the header.
function(karinui_module name)
  cmake_parse_arguments(A "UNCHECKED;LIGHT" "" "USES;LINKS;PRECOMPILED" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  karinui_mutate(sources)
  add_library(karinui_${name} STATIC ${sources})
  target_include_directories(karinui_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include> PRIVATE ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM A_USES PREPEND karinui_)
  target_link_libraries(karinui_${name} PUBLIC ${A_USES} PRIVATE karinui_flags ${A_LINKS})
  if(A_UNCHECKED)
    target_compile_options(karinui_${name} PRIVATE -U_GLIBCXX_ASSERTIONS)
  endif()
  if(A_LIGHT)
    target_compile_options(karinui_${name} PRIVATE ${KARINUI_LIGHT})
  endif()
  string(MAKE_C_IDENTIFIER "KARINUI_HEADERS_${A_UNCHECKED}_${A_LIGHT}_${A_PRECOMPILED}" headers)
  get_property(shared GLOBAL PROPERTY ${headers})
  if(shared)
    karinui_quiet_precompiled(karinui_${name})
    target_precompile_headers(karinui_${name} REUSE_FROM ${shared})
  else()
    karinui_precompiled(karinui_${name} ${A_PRECOMPILED})
    set_property(GLOBAL PROPERTY ${headers} karinui_${name})
  endif()
endfunction()

# With precompiled headers g++ 12 forgets that std::string is a system's header and warns of copies that cannot be.
function(karinui_quiet_precompiled target)
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds$<SEMICOLON>-Wno-stringop-overflow$<SEMICOLON>-Wno-stringop-overread>)
endfunction()

# karinui_precompiled(test_cloth <gtest/gtest.h> …): headers that most sources of a target include, beside those of the standard
# library. The preset clang compiles without them, so that a source that forgets an include is found there.
function(karinui_precompiled target)
  karinui_quiet_precompiled(${target})
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory>
    <numbers> <numeric> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector> ${ARGN})
endfunction()

# karinui_test_code(test_cloth): what the sources of every test program share. They are compiled with -Og, in two thirds
# of the time of -O3: what is tested lies in the libraries. The first program's headers are precompiled for all that ask for no others.
function(karinui_test_code target)
  cmake_parse_arguments(A "" "" "PRECOMPILED" ${ARGN})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE
    KARINUI_SOURCE_DIR="${PROJECT_SOURCE_DIR}" KARINUI_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  target_compile_options(${target} PRIVATE -Og)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 20)  # where there is a unity build: a tenth sooner
  get_property(shared GLOBAL PROPERTY KARINUI_TEST_HEADERS)
  if(shared AND NOT A_PRECOMPILED)
    karinui_quiet_precompiled(${target})
    target_precompile_headers(${target} REUSE_FROM ${shared})
  else()
    karinui_precompiled(${target} <gmock/gmock.h> <gtest/gtest.h> ${A_PRECOMPILED})
    if(NOT A_PRECOMPILED)
      set_property(GLOBAL PROPERTY KARINUI_TEST_HEADERS ${target})
    endif()
  endif()
  target_link_libraries(${target} PRIVATE GTest::gtest GTest::gmock GTest::gtest_main)
endfunction()

option(KARINUI_LONG "Suites may take hours, as those of ./test --long" OFF)
# karinui_tests(cloth): the program test_cloth from tests/cloth/**_test.cpp. ctest knows each suite as one test, so that what
# a suite prepares once (a body, say) is prepared once.
function(karinui_tests name)
  cmake_parse_arguments(A "" "" "LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  if(TARGET karinui_${name})
    target_link_libraries(test_${name} PRIVATE karinui_${name})
  endif()
  target_link_libraries(test_${name} PRIVATE ${A_LINKS} karinui_flags)
  karinui_test_code(test_${name})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})
  set(suites)
  foreach(source ${sources})
    file(STRINGS ${source} lines REGEX "^TEST(_F|_P)?\\(")
    list(TRANSFORM lines REPLACE "^TEST[_FP]*\\( *([A-Za-z0-9_]+).*" "\\1")
    list(APPEND suites ${lines})
  endforeach()
  list(REMOVE_DUPLICATES suites)
  set(most 900)  # seconds
  if(KARINUI_LONG)
    set(most 36000)
  elseif(KARINUI_SANITIZE)
    set(most 9000)
  endif()
  foreach(suite ${suites})
    add_test(NAME ${name}.${suite} COMMAND test_${name} --gtest_brief=1 --gtest_filter=${suite}.*:*/${suite}.*)
    set_tests_properties(${name}.${suite} PROPERTIES TIMEOUT ${most})
  endforeach()
endfunction()
