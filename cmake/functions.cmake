# mrroc_library(NAME sources...)  a library target of one folder, with the project's warnings
# mrroc_program(NAME sources...)  a program in bin/
# mrroc_arm_task(NAME sources...)  a task of arms that work on their own (sim/arm_task.hpp): library mrroc_NAME with
# NAME.toml as mrroc::NAME::config(), programs NAME and ecp_NAME from main.cpp and main_ecp.cpp
#
# The installed CMake package has them too, for tasks and robots outside of this tree.

# Whether a target of this folder is part of the installed framework.
function(mrroc_is_installed answer)
  set(inside FALSE)
  if(PROJECT_NAME STREQUAL "mrroc" AND NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/(test|bench)")
    set(inside TRUE)
  endif()
  set(${answer} ${inside} PARENT_SCOPE)
endfunction()

function(mrroc_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC mrroc_options Eigen3::Eigen)
  if(PROJECT_NAME STREQUAL "mrroc")
    target_precompile_headers(${name} REUSE_FROM mrroc_headers)
  endif()
  mrroc_is_installed(installed)
  if(installed)
    install(TARGETS ${name} EXPORT mrroc ARCHIVE DESTINATION ${MRROC_LIBRARIES})
  endif()
endfunction()

function(mrroc_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE mrroc_options)
  if(PROJECT_NAME STREQUAL "mrroc")
    add_dependencies(programs ${name})
    target_precompile_headers(${name} REUSE_FROM mrroc_headers)
  endif()
  mrroc_is_installed(installed)
  if(installed)
    install(TARGETS ${name} RUNTIME DESTINATION ${MRROC_PROGRAMS})
  endif()
endfunction()

function(mrroc_arm_task name)
  file(READ ${name}.toml MRROC_TOML)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}.toml)
  set(MRROC_TASK ${name})
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/task_config.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/task_config.cpp @ONLY)
  mrroc_library(mrroc_${name} ${ARGN} ${CMAKE_CURRENT_BINARY_DIR}/task_config.cpp)
  target_link_libraries(mrroc_${name} PUBLIC mrroc_ecp mrroc_mp)
  mrroc_program(ecp_${name} main_ecp.cpp)
  target_link_libraries(ecp_${name} PRIVATE mrroc_${name})
  mrroc_program(${name} main.cpp)
  target_link_libraries(${name} PRIVATE mrroc_${name} mrroc_arm_task)
  if(PROJECT_NAME STREQUAL "mrroc")
    add_dependencies(${name} ecp_${name} edp_irb6 world)
  else()
    add_dependencies(${name} ecp_${name})
  endif()
endfunction()
