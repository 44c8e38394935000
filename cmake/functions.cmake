# mrroc_library(NAME [SERVO_STEP] sources...)  a library target of one folder, with the project's warnings;
#                                 SERVO_STEP: it works in every step of a driver and is optimised for that
# mrroc_program(NAME sources...)  a program in bin/
# mrroc_arm_task(NAME sources... [PARTS programs...])  a task of arms that work on their own (launch/arm_task.hpp): library
#                                 mrroc_NAME with NAME.toml as mrroc::NAME::config(), programs NAME and ecp_NAME from
#                                 main.cpp and main_ecp.cpp; PARTS: programs that it starts besides simulator and drivers
# mrroc_coordinated_task(NAME sources... [PARTS programs...])  a task whose coordinator orders what its arms copy
#                                 (mp/coordinated_run.hpp, ecp/transparent.hpp): the same with ecp_transparent for ecp_NAME
# mrroc_starts(NAME programs...)  building NAME also builds what it starts: these programs, the simulator, and the drivers of
#                                 all robots and platforms
# mrroc_robot(NAME sources... [TYPES types...])  a robot (robots/catalogue.hpp): library mrroc_robot_NAME with NAME.urdf as
#                                 mrroc::NAME::urdf(), program edp_NAME from main_edp.cpp; mrroc::NAME::type() is entered
#                                 in the catalogue. TYPES: several that one program drives, each TYPE with NAME_TYPE.urdf
#                                 as mrroc::NAME::TYPE_urdf() and entered as mrroc::NAME::TYPE()
# mrroc_platform(NAME sources...) a mobile platform (robots/platforms.hpp): library mrroc_platform_NAME with NAME.urdf as
#                                 mrroc::NAME::urdf(), program edp_NAME from main_edp.cpp; mrroc::NAME::type() is entered
#                                 in the catalogue
# mrroc_catalogue()               library mrroc_catalogue: every robot and platform that has been registered so far
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
  cmake_parse_arguments(PARSE_ARGV 1 arg "SERVO_STEP" "" "")
  add_library(${name} STATIC ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PUBLIC mrroc_options Eigen3::Eigen)
  set(headers mrroc_headers)
  if(arg_SERVO_STEP)
    target_compile_options(${name} PRIVATE ${MRROC_SERVO_STEP})
    set(headers mrroc_servo_step_headers)
  endif()
  if(PROJECT_NAME STREQUAL "mrroc")
    target_precompile_headers(${name} REUSE_FROM ${headers})
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

# Makes the text of a file part of a library: the source ${name}_text.cpp with std::string_view mrroc::SPACE::FUNCTION().
function(mrroc_embed space function file)
  file(READ ${file} MRROC_TEXT)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  set(MRROC_SPACE ${space})
  set(MRROC_FUNCTION ${function})
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embedded_text.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/${function}_text.cpp @ONLY)
endfunction()

# Library and program of a task. ECP: the program of its control subsystems
function(mrroc_task name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "ECP" "PARTS")
  mrroc_embed(${name} config ${name}.toml)
  mrroc_library(mrroc_${name} ${arg_UNPARSED_ARGUMENTS} ${CMAKE_CURRENT_BINARY_DIR}/config_text.cpp)
  target_link_libraries(mrroc_${name} PUBLIC mrroc_ecp mrroc_mp)
  mrroc_program(${name} main.cpp)
  target_link_libraries(${name} PRIVATE mrroc_${name} mrroc_launch)
  mrroc_starts(${name} ${arg_ECP} ${arg_PARTS})
endfunction()

function(mrroc_arm_task name)
  mrroc_program(ecp_${name} main_ecp.cpp)
  target_link_libraries(ecp_${name} PRIVATE mrroc_${name})
  mrroc_task(${name} ${ARGN} ECP ecp_${name})
endfunction()

function(mrroc_coordinated_task name)
  mrroc_task(${name} ${ARGN} ECP ecp_transparent)
endfunction()

function(mrroc_starts name)
  get_property(robots GLOBAL PROPERTY MRROC_ROBOTS)
  get_property(platforms GLOBAL PROPERTY MRROC_PLATFORMS)
  list(APPEND robots ${platforms})
  list(TRANSFORM robots PREPEND edp_)
  foreach(program ${ARGN} ${robots} simulator)
    if(TARGET ${program} OR PROJECT_NAME STREQUAL "mrroc")  # elsewhere the others are installed
      add_dependencies(${name} ${program})
    endif()
  endforeach()
endfunction()

function(mrroc_robot name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "TYPES")
  set(texts)
  if(arg_TYPES)
    foreach(type ${arg_TYPES})
      mrroc_embed(${name} ${type}_urdf ${name}_${type}.urdf)
      list(APPEND texts ${CMAKE_CURRENT_BINARY_DIR}/${type}_urdf_text.cpp)
    endforeach()
  else()
    mrroc_embed(${name} urdf ${name}.urdf)
    list(APPEND texts ${CMAKE_CURRENT_BINARY_DIR}/urdf_text.cpp)
    set(arg_TYPES type)
  endif()
  mrroc_library(mrroc_robot_${name} SERVO_STEP ${arg_UNPARSED_ARGUMENTS} ${texts})
  target_link_libraries(mrroc_robot_${name} PUBLIC mrroc_robots)
  mrroc_program(edp_${name} main_edp.cpp)
  target_link_libraries(edp_${name} PRIVATE mrroc_robot_${name})
  set_property(GLOBAL APPEND PROPERTY MRROC_ROBOTS ${name})
  list(TRANSFORM arg_TYPES PREPEND "${name}::")
  set_property(GLOBAL APPEND PROPERTY MRROC_ROBOT_TYPES ${arg_TYPES})
endfunction()

function(mrroc_platform name)
  mrroc_embed(${name} urdf ${name}.urdf)
  mrroc_library(mrroc_platform_${name} SERVO_STEP ${ARGN} ${CMAKE_CURRENT_BINARY_DIR}/urdf_text.cpp)
  target_link_libraries(mrroc_platform_${name} PUBLIC mrroc_platforms)
  mrroc_program(edp_${name} main_edp.cpp)
  target_link_libraries(edp_${name} PRIVATE mrroc_platform_${name})
  set_property(GLOBAL APPEND PROPERTY MRROC_PLATFORMS ${name})
  set_property(GLOBAL APPEND PROPERTY MRROC_PLATFORM_TYPES ${name}::type)
endfunction()

# Declares what has been registered so far as KIND, and lists it; in other projects, the framework's own and that.
# PROPERTY: MRROC_ROBOT_TYPES or MRROC_PLATFORM_TYPES
macro(mrroc_list_types property kind declarations entries)
  get_property(types GLOBAL PROPERTY ${property})
  if(NOT PROJECT_NAME STREQUAL "mrroc")
    get_target_property(own mrroc_catalogue ${property})
    if(own)
      list(PREPEND types ${own})
    endif()
  endif()
  set(${declarations} "")
  set(${entries} "")
  foreach(type ${types})
    string(REGEX MATCH "^(.*)::(.*)$" matched ${type})
    string(APPEND ${declarations}
           "namespace mrroc::${CMAKE_MATCH_1} {\nconst robots::${kind}& ${CMAKE_MATCH_2}();\n}\n")
    string(APPEND ${entries} "&${type}(), ")
  endforeach()
endmacro()

# Writes the source of the catalogue of all robots and platforms.
function(mrroc_known_robots file)
  mrroc_list_types(MRROC_ROBOT_TYPES RobotType MRROC_DECLARATIONS MRROC_ENTRIES)
  mrroc_list_types(MRROC_PLATFORM_TYPES PlatformType MRROC_PLATFORM_DECLARATIONS MRROC_PLATFORM_ENTRIES)
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT [[
#include "robots/catalogue.hpp"
#include "robots/platforms.hpp"

@MRROC_DECLARATIONS@@MRROC_PLATFORM_DECLARATIONS@
namespace mrroc::robots {

std::span<const RobotType* const> catalogue() {
  static const std::vector<const RobotType*> types{@MRROC_ENTRIES@};
  return types;
}

std::span<const PlatformType* const> platforms() {
  static const std::vector<const PlatformType*> types{@MRROC_PLATFORM_ENTRIES@};
  return types;
}

}  // namespace mrroc::robots
]])
endfunction()

function(mrroc_catalogue)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/known_robots.cpp)
  mrroc_known_robots(${source})
  mrroc_library(mrroc_catalogue ${source})
  get_property(robots GLOBAL PROPERTY MRROC_ROBOTS)
  list(TRANSFORM robots PREPEND mrroc_robot_)
  get_property(platforms GLOBAL PROPERTY MRROC_PLATFORMS)
  set_target_properties(mrroc_catalogue PROPERTIES MRROC_PLATFORMS "${platforms}")
  list(TRANSFORM platforms PREPEND mrroc_platform_)
  target_link_libraries(mrroc_catalogue PUBLIC mrroc_robots mrroc_platforms ${robots} ${platforms})
  foreach(property MRROC_ROBOT_TYPES MRROC_PLATFORM_TYPES)
    get_property(types GLOBAL PROPERTY ${property})
    set_target_properties(mrroc_catalogue PROPERTIES ${property} "${types}")
  endforeach()
  set_target_properties(mrroc_catalogue PROPERTIES EXPORT_PROPERTIES "MRROC_ROBOT_TYPES;MRROC_PLATFORM_TYPES")
endfunction()
