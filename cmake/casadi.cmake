# What the platform Rex needs from PyPI (cmake/requirements.txt; ./run installs it into build/python): CasADi, which writes
# models at build time, and the solver HPIPM with BLASFEO, the only parts that programs load.
#
# MRROC_HPIPM_HEADERS, MRROC_HPIPM  the solver's headers; what a library of this tree links for it
# mrroc_casadi_model(NAME)          target NAME: the model that model/NAME.py writes, <NAME.h> for who links it
option(MRROC_REX "Build the platform Rex, which needs CasADi" ON)
if(NOT MRROC_REX)
  return()
endif()
set(MRROC_CASADI ${CMAKE_SOURCE_DIR}/build/python/casadi CACHE PATH "The Python package casadi")
find_program(MRROC_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
foreach(file casadi.py libhpipm.so libblasfeo.so.0 include/hpipm_d_ocp_qp.h)
  if(NOT EXISTS ${MRROC_CASADI}/${file})
    message(FATAL_ERROR "CasADi is not in ${MRROC_CASADI}. Type, in ${CMAKE_SOURCE_DIR},\n"
      "  /usr/bin/python3 -m pip install --no-deps --require-hashes --only-binary :all: --target build/python -r cmake/requirements.txt\n"
      "or configure with -DMRROC_CASADI=FOLDER, where it is, or with -DMRROC_REX=OFF, to do without the platform Rex.")
  endif()
endforeach()
if(NOT MRROC_PYTHON)
  message(FATAL_ERROR "There is no /usr/bin/python3, which writes the model of the platform Rex. Type\n"
    "  apt-get install python3 python3-numpy\nor configure with -DMRROC_REX=OFF, to do without that platform.")
endif()

# Installed programs find both libraries beside themselves.
set(MRROC_HPIPM_HEADERS ${MRROC_CASADI}/include)
set(MRROC_HPIPM)
foreach(library libhpipm.so libblasfeo.so.0)
  list(APPEND MRROC_HPIPM $<BUILD_INTERFACE:${MRROC_CASADI}/${library}>
                          $<INSTALL_INTERFACE:$<INSTALL_PREFIX>/${MRROC_PROGRAMS}/${library}>)
  install(FILES ${MRROC_CASADI}/${library} DESTINATION ${MRROC_PROGRAMS})
endforeach()
set(CMAKE_INSTALL_RPATH "$ORIGIN")
foreach(name hpipm blasfeo)
  install(FILES ${MRROC_CASADI}/include/licenses/${name}-external/LICENSE.txt
          DESTINATION share/doc/mrroc/licenses RENAME ${name}.txt)
endforeach()

function(mrroc_casadi_model name)
  set(script ${CMAKE_CURRENT_SOURCE_DIR}/model/${name}.py)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/model)
  set(files ${folder}/${name}.c ${folder}/${name}.h)
  cmake_path(GET MRROC_CASADI PARENT_PATH packages)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${files} DEPENDS ${script}
    COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${packages} PYTHONDONTWRITEBYTECODE=1 ${MRROC_PYTHON} ${script} ${folder}
    COMMENT "Writing the model ${name}" VERBATIM)
  # Beside the messages, which are generated before anything is compiled or looked at.
  add_custom_target(mrroc_generated_${name} DEPENDS ${files})
  add_dependencies(mrroc_generated mrroc_generated_${name})
  # Generated code is not held to the project's warnings.
  add_library(${name} OBJECT ${folder}/${name}.c)
  target_compile_options(${name} PRIVATE -w)
  target_include_directories(${name} SYSTEM INTERFACE ${folder})
endfunction()
