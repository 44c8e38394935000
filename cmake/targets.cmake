# What all targets have in common, and mrroc_test(NAME [THREADS] [TIMEOUT s] sources...)  a gtest suite that mirrors one
# folder; THREADS: it has more than one; TIMEOUT: of each test, usual: 900
include(GoogleTest)
include(functions)

# All programs, and what ./run builds for the tests.
add_custom_target(programs)
add_custom_target(tests)

add_library(mrroc_options INTERFACE)
target_compile_features(mrroc_options INTERFACE cxx_std_20)
target_include_directories(mrroc_options INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:include/mrroc>)
# Who uses the installed libraries has warnings of his own.
function(mrroc_compile_options)
  target_compile_options(mrroc_options INTERFACE "$<BUILD_INTERFACE:${ARGN}>")
endfunction()
mrroc_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Wno-sign-conversion)
# g++ 12 sees overlaps and overruns in inlined std::string operations that are not there (GCC bugs 105329, 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  mrroc_compile_options(-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow)
endif()
if(MRROC_WERROR)
  mrroc_compile_options(-Werror)
endif()
if(MRROC_SANITIZE STREQUAL "address")
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
elseif(MRROC_SANITIZE STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
elseif(MRROC_SANITIZE)
  message(FATAL_ERROR "MRROC_SANITIZE is '${MRROC_SANITIZE}'; give address or thread, or leave it empty")
endif()
if(MRROC_SANITIZE)
  target_compile_definitions(mrroc_options INTERFACE $<BUILD_INTERFACE:MRROC_SANITIZED>)
  # The instrumentation hides from g++ that variables are initialised.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    mrroc_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()

if(MRROC_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# A run records the build IDs of its programs (base/build_id.hpp).
add_link_options(LINKER:--build-id)

# Headers that most files need, compiled once for the libraries and programs, and once for the tests, which are
# optimised less: they are compiled more often than run.
# LCM asks for -pthread; a precompiled header serves only files with the same options. One that came damaged from a cache
# costs time, as its headers are then read as they are, and fails nothing.
set(CMAKE_PCH_WARN_INVALID OFF)
target_compile_options(mrroc_options INTERFACE -pthread)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/empty.cpp CONTENT "")
add_library(mrroc_headers STATIC ${CMAKE_BINARY_DIR}/empty.cpp)
target_link_libraries(mrroc_headers PRIVATE mrroc_options Eigen3::Eigen)
set(MRROC_HEADERS <Eigen/Dense> <algorithm> <array> <chrono> <filesystem> <fstream> <functional> <map> <memory>
                  <optional> <random> <set> <sstream> <string> <variant> <vector>)
target_precompile_headers(mrroc_headers PRIVATE ${MRROC_HEADERS})
# A precompiled header brings its own optimisation with it.
set(MRROC_SERVO_STEP $<$<CONFIG:Release>:-O3>)
add_library(mrroc_servo_step_headers STATIC ${CMAKE_BINARY_DIR}/empty.cpp)
target_compile_options(mrroc_servo_step_headers PRIVATE ${MRROC_SERVO_STEP})
target_link_libraries(mrroc_servo_step_headers PRIVATE mrroc_options Eigen3::Eigen)
target_precompile_headers(mrroc_servo_step_headers PRIVATE ${MRROC_HEADERS})
if(MRROC_TESTS)
  find_package(GTest REQUIRED)
  add_library(mrroc_test_options INTERFACE)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(mrroc_test_options INTERFACE -O1)
  endif()
  target_link_libraries(mrroc_test_options INTERFACE mrroc_options)
  add_library(mrroc_test_headers STATIC ${CMAKE_BINARY_DIR}/empty.cpp)
  target_link_libraries(mrroc_test_headers PRIVATE mrroc_test_options GTest::gtest Eigen3::Eigen)
  target_precompile_headers(mrroc_test_headers PRIVATE <gtest/gtest.h> <Eigen/Dense> <algorithm> <array> <filesystem>
                            <fstream> <functional> <map> <optional> <random> <sstream> <string> <vector>)
endif()

function(mrroc_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "THREADS;WALL_CLOCK" "TIMEOUT" "")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 900)
  endif()
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE mrroc_test_options GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM mrroc_test_headers)
  # The thread sanitizer has nothing to say of tests with one thread.
  if(MRROC_SANITIZE STREQUAL "thread" AND NOT arg_THREADS)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL TRUE)
    return()
  endif()
  add_dependencies(tests ${name})
  if(arg_WALL_CLOCK)  # beside another test, they would wait for cores
    set(properties LABELS slow RUN_SERIAL TRUE)
  else()
    set(properties LABELS ${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT ${arg_TIMEOUT} ${properties})
endfunction()
