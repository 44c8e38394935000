# The physics engine MuJoCo from PyPI (cmake/mujoco.txt; ./run installs it into build/mujoco), for sim.engine = "mujoco".
#
# MRROC_MUJOCO                                   the Python package mujoco; OFF: the simulator has Bullet only
# MRROC_MUJOCO_HEADERS, MRROC_MUJOCO_LIBRARIES   its headers; what a library of this tree links for it
set(MRROC_MUJOCO ${CMAKE_SOURCE_DIR}/build/mujoco/mujoco CACHE STRING "The Python package mujoco, or OFF")
if(NOT MRROC_MUJOCO)
  return()
endif()
file(GLOB library ${MRROC_MUJOCO}/libmujoco.so.*)
if(NOT library OR NOT EXISTS ${MRROC_MUJOCO}/include/mujoco/mujoco.h)
  message(FATAL_ERROR "MuJoCo is not in ${MRROC_MUJOCO}. Type, in ${CMAKE_SOURCE_DIR},\n"
    "  /usr/bin/python3 -m pip install --no-deps --require-hashes --only-binary :all: --python-version 3.11 --implementation cp --abi cp311 --target build/mujoco -r cmake/mujoco.txt\n"
    "or configure with -DMRROC_MUJOCO=FOLDER, where it is, or with -DMRROC_MUJOCO=OFF, to do without this engine.")
endif()

# Installed programs find the library beside themselves.
cmake_path(GET library FILENAME name)
set(MRROC_MUJOCO_HEADERS ${MRROC_MUJOCO}/include)
set(MRROC_MUJOCO_LIBRARIES $<BUILD_INTERFACE:${library}> $<INSTALL_INTERFACE:$<INSTALL_PREFIX>/${MRROC_PROGRAMS}/${name}>)
install(FILES ${library} DESTINATION ${MRROC_PROGRAMS})
set(CMAKE_INSTALL_RPATH "$ORIGIN")
file(GLOB licenses ${MRROC_MUJOCO}/../mujoco-*.dist-info/licenses/LICENSE*)
foreach(license ${licenses})
  cmake_path(GET license STEM text)
  string(TOLOWER ${text} text)
  string(REGEX REPLACE "licenses?" mujoco text ${text})
  install(FILES ${license} DESTINATION share/doc/mrroc/licenses RENAME ${text}.txt)
endforeach()
