# mrroc_library(NAME sources...)  a library target of one folder, with the project's warnings
# mrroc_program(NAME sources...)  a program in bin/
# mrroc_test(NAME sources...)     a gtest suite that mirrors one folder
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

function(mrroc_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC mrroc_options Eigen3::Eigen)
endfunction()

function(mrroc_program name)
  add_executable(${name} ${ARGN})
  add_dependencies(programs ${name})
  target_link_libraries(${name} PRIVATE mrroc_options)
endfunction()

function(mrroc_test name)
  add_executable(${name} ${ARGN})
  add_dependencies(tests ${name})
  target_link_libraries(${name} PRIVATE mrroc_options GTest::gtest_main)
  target_precompile_headers(${name} PRIVATE <gtest/gtest.h> <Eigen/Dense>)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 900)
endfunction()
