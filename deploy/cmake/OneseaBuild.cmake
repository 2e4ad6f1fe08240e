# Settings and helpers that every room of the build uses.
include(GNUInstallDirs)
include(CheckCXXCompilerFlag)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

find_program(ONESEA_CCACHE ccache)
if(ONESEA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ONESEA_CCACHE})
endif()

# Contraction turns a*b+c into one rounding or two at the compiler's pleasure; off for every target,
# because inline header code obeys the flag of the file that includes it.
add_compile_options($<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>)
if(ONESEA_SANITIZE)
  # Without the second the undefined-behaviour sanitizer prints what it finds and the test passes.
  add_compile_options(-fsanitize=${ONESEA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ONESEA_SANITIZE})
  # GCC 12 sees uninitialised members in <functional> and <regex> once a sanitizer has rewritten them.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

add_library(onesea_compile_options INTERFACE)
target_compile_options(onesea_compile_options INTERFACE
  -Wall -Wextra -Wconversion -Wno-sign-conversion $<$<BOOL:${ONESEA_WERROR}>:-Werror>)

find_package(PkgConfig REQUIRED)
find_package(absl CONFIG REQUIRED)
find_package(hwy CONFIG QUIET)
if(NOT TARGET hwy::hwy)
  pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
  add_library(hwy::hwy ALIAS PkgConfig::HWY)
endif()

# onesea_library(NAME SOURCES ... [PUBLIC deps...] [PRIVATE deps...]): a room; target onesea_NAME, alias onesea::NAME.
function(onesea_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(onesea_${name} STATIC ${ARG_SOURCES})
  add_library(onesea::${name} ALIAS onesea_${name})
  target_include_directories(onesea_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/onesea>)
  target_link_libraries(onesea_${name} PUBLIC ${ARG_PUBLIC}
    PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:onesea_compile_options>)
  target_compile_features(onesea_${name} PUBLIC cxx_std_20)  # the headers need it, outside the tree too
  set_target_properties(onesea_${name} PROPERTIES EXPORT_NAME ${name})
endfunction()

# onesea_program(NAME SOURCES ... LINK deps...): an executable called NAME in bin/.
function(onesea_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} onesea_compile_options)
endfunction()

# onesea_test(NAME SOURCES ... LINK deps... [TIMEOUT seconds]): a GoogleTest program, one ctest entry, with a timeout.
# Its working directory is the source root, so that test data is named as tests/data/...
function(onesea_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 60)
  endif()
  if(TARGET onesea_absl_mutex_tsan)
    list(APPEND ARG_LINK onesea_absl_mutex_tsan)
  endif()
  onesea_program(${name} SOURCES ${ARG_SOURCES} LINK ${ARG_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT})
endfunction()
