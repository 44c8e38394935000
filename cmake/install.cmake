# `cmake --install` and `cpack`: programs, headers, libraries, and a CMake package for robots and tasks outside of this
# tree: find_package(mrroc), then mrroc_arm_task() and the other functions of cmake/functions.cmake.
include(CMakePackageConfigHelpers)

install(TARGETS mrroc_options mrroc_msg EXPORT mrroc)
# For builds beside this one, as that of test/new.
export(EXPORT mrroc FILE ${CMAKE_BINARY_DIR}/mrroc-targets.cmake)
install(EXPORT mrroc FILE mrroc-targets.cmake DESTINATION ${MRROC_PACKAGE})
configure_package_config_file(cmake/mrroc-config.cmake.in ${CMAKE_BINARY_DIR}/mrroc-config.cmake
                              INSTALL_DESTINATION ${MRROC_PACKAGE} PATH_VARS MRROC_PROGRAMS)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/mrroc-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/mrroc-config.cmake ${CMAKE_BINARY_DIR}/mrroc-config-version.cmake
              cmake/dependencies.cmake cmake/functions.cmake cmake/embedded_text.cpp.in
        DESTINATION ${MRROC_PACKAGE})

foreach(folder base edp ecp mp vsp ui_cli robots tasks sim launch)
  install(DIRECTORY ${folder} DESTINATION include/mrroc FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(DIRECTORY ${MRROC_GENERATED}/mrroc DESTINATION include/mrroc FILES_MATCHING PATTERN "*.hpp")
install(PROGRAMS cmake/mrroc.sh DESTINATION bin RENAME mrroc)
install(FILES README.md LICENSE CHANGELOG.md DESTINATION share/doc/mrroc)
install(DIRECTORY docs DESTINATION share/doc/mrroc)
install(DIRECTORY tasks ui_cli DESTINATION share/doc/mrroc FILES_MATCHING PATTERN "README.md")
# The reader of run folders for Python, where Debian's python3 looks.
set(MRROC_READER lib/python3/dist-packages/mrroc_runs)
install(DIRECTORY ui_cli/python/mrroc_runs/ DESTINATION ${MRROC_READER} FILES_MATCHING PATTERN "*.py"
        PATTERN "__pycache__" EXCLUDE PATTERN "msg" EXCLUDE)
# Campaigns beside it, and the command that starts them.
install(DIRECTORY ui_cli/python/mrroc_campaign DESTINATION lib/python3/dist-packages FILES_MATCHING PATTERN "*.py" PATTERN "*.css"
        PATTERN "__pycache__" EXCLUDE)
install(PROGRAMS cmake/campaign.sh DESTINATION ${MRROC_PROGRAMS} RENAME campaign)
install(PROGRAMS ui_cli/python/example.py DESTINATION share/doc/mrroc/ui_cli/python)
install(DIRECTORY base/msg/ DESTINATION ${MRROC_READER}/msg FILES_MATCHING PATTERN "*.lcm")
# The words of ui_cli for shells, where bash-completion and zsh look for them by the name of the command.
set(MRROC_COMPLETION ${CMAKE_BINARY_DIR}/completion)
install(CODE "
  file(MAKE_DIRECTORY \"${MRROC_COMPLETION}\")
  foreach(shell bash zsh)
    execute_process(COMMAND \"$<TARGET_FILE:ui_cli>\" completion \${shell} OUTPUT_FILE \"${MRROC_COMPLETION}/\${shell}\"
                    COMMAND_ERROR_IS_FATAL ANY)
  endforeach()")
foreach(command ui_cli mrroc)
  install(FILES ${MRROC_COMPLETION}/bash DESTINATION share/bash-completion/completions RENAME ${command})
endforeach()
install(FILES ${MRROC_COMPLETION}/zsh DESTINATION share/zsh/vendor-completions RENAME _ui_cli)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME mrroc)
set(CPACK_PACKAGE_CONTACT "the project authors <mrroc@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
foreach(folder MRROC_CASADI MRROC_MUJOCO)
  if(EXISTS "${${folder}}")
    list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${${folder}})
  endif()
endforeach()
# What the libraries' users link, and what a run calls.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev, libfmt-dev, liblcm-dev, libglib2.0-dev, libsodium-dev, libbullet-dev, liburdfdom-dev, \
liborocos-kdl-dev, libtomlplusplus-dev, nlohmann-json3-dev, libpugixml-dev, libncurses-dev, \
libopencv-core-dev, libopencv-imgproc-dev, libopencv-imgcodecs-dev, libopencv-video-dev, libopencv-videoio-dev, libopencv-calib3d-dev, \
libapriltag-dev")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, cmake, gnuplot-nox, libegl-mesa0, libgl1-mesa-dri, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-distributed, python3-scipy, python3-tqdm, python3-optuna") # campaigns
include(CPack)
