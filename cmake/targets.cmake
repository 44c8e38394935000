# mrroc_library(NAME [SERVO_STEP] sources...)  a library target of one folder, with the project's warnings;
#                                 SERVO_STEP: it works in every step of a driver and is optimised for that
# mrroc_program(NAME sources...)  a program in bin/
# mrroc_test(NAME [THREADS] sources...)  a gtest suite that mirrors one folder; THREADS: it has more than one
include(GoogleTest)

# What ./run builds for a task, and what it builds for the tests.
add_custom_target(programs)
add_custom_target(tests)

add_library(mrroc_options INTERFACE)
target_include_directories(mrroc_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(mrroc_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                                               -Wnon-virtual-dtor -Wno-sign-conversion)
# g++ 12 sees overlaps and overruns in inlined std::string operations that are not there (GCC bugs 105329, 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(mrroc_options INTERFACE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow)
endif()
if(MRROC_WERROR)
  target_compile_options(mrroc_options INTERFACE -Werror)
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
  target_compile_definitions(mrroc_options INTERFACE MRROC_SANITIZED)
  # The instrumentation hides from g++ that variables are initialised.
  target_compile_options(mrroc_options INTERFACE -Wno-maybe-uninitialized)
endif()

# Headers that most files need, compiled once for the libraries and programs, and once for the tests, which are
# optimised less: they are compiled more often than run.
# LCM asks for -pthread; a precompiled header serves only files with the same options.
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

function(mrroc_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SERVO_STEP" "" "")
  add_library(${name} STATIC ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PUBLIC mrroc_options Eigen3::Eigen)
  if(arg_SERVO_STEP)
    target_compile_options(${name} PRIVATE ${MRROC_SERVO_STEP})
    target_precompile_headers(${name} REUSE_FROM mrroc_servo_step_headers)
  else()
    target_precompile_headers(${name} REUSE_FROM mrroc_headers)
  endif()
endfunction()

function(mrroc_program name)
  add_executable(${name} ${ARGN})
  add_dependencies(programs ${name})
  target_link_libraries(${name} PRIVATE mrroc_options)
  target_precompile_headers(${name} REUSE_FROM mrroc_headers)
endfunction()

function(mrroc_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "THREADS" "" "")
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE mrroc_test_options GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM mrroc_test_headers)
  # The thread sanitizer has nothing to say of tests with one thread.
  if(MRROC_SANITIZE STREQUAL "thread" AND NOT arg_THREADS)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL TRUE)
    return()
  endif()
  add_dependencies(tests ${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 900)
endfunction()

# mrroc_arm_task(NAME sources...)  a task of arms that work on their own (sim/arm_task.hpp): library mrroc_NAME with
# NAME.toml as mrroc::NAME::config(), programs NAME and ecp_NAME from main.cpp and main_ecp.cpp
function(mrroc_arm_task name)
  file(READ ${name}.toml MRROC_TOML)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}.toml)
  set(MRROC_TASK ${name})
  configure_file(${CMAKE_SOURCE_DIR}/cmake/task_config.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/task_config.cpp @ONLY)
  mrroc_library(mrroc_${name} ${ARGN} ${CMAKE_CURRENT_BINARY_DIR}/task_config.cpp)
  target_link_libraries(mrroc_${name} PUBLIC mrroc_ecp mrroc_mp)
  mrroc_program(ecp_${name} main_ecp.cpp)
  target_link_libraries(ecp_${name} PRIVATE mrroc_${name})
  mrroc_program(${name} main.cpp)
  target_link_libraries(${name} PRIVATE mrroc_${name} mrroc_arm_task)
  add_dependencies(${name} ecp_${name} edp_irb6 world)
endfunction()
