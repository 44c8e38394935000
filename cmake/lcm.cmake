# mrroc_messages(files...)  generates C++ from LCM message definitions into the build tree, and message_sources.cpp,
# which holds the definitions themselves
find_program(LCM_GEN lcm-gen REQUIRED)
set(MRROC_GENERATED ${CMAKE_BINARY_DIR}/gen)

function(mrroc_messages)
  foreach(file ${ARGN})
    get_filename_component(name ${file} NAME_WE)
    set(header ${MRROC_GENERATED}/mrroc/${name}.hpp)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${LCM_GEN} --cpp --cpp-std=c++11 --cpp-hpath ${MRROC_GENERATED} ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      VERBATIM)
    list(APPEND headers ${header})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    file(READ ${file} definition)
    string(APPEND includes "#include \"mrroc/${name}.hpp\"\n")
    string(APPEND sources "    {${name}::getHash(), R\"lcm(${definition})lcm\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/message_sources.cpp @ONLY CONTENT
"#include \"base/msg/message_sources.hpp\"

${includes}
namespace mrroc {
std::vector<MessageSource> message_sources() {
  return {
${sources}  };
}
}  // namespace mrroc
")
  add_custom_target(mrroc_generated DEPENDS ${headers})
  add_library(mrroc_msg INTERFACE)
  add_dependencies(mrroc_msg mrroc_generated)
  # Generated code is not held to the project's warnings.
  target_include_directories(mrroc_msg SYSTEM INTERFACE $<BUILD_INTERFACE:${MRROC_GENERATED}>
                                                        $<INSTALL_INTERFACE:include/mrroc>)
endfunction()
