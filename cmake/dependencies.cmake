# Every library that the project uses, all from Debian 12.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(Curses REQUIRED)
pkg_check_modules(lcm REQUIRED IMPORTED_TARGET lcm)
# Bullet in double precision; the CMake package of Debian is the single-precision build.
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet-float64)
pkg_check_modules(sodium REQUIRED IMPORTED_TARGET libsodium)
pkg_check_modules(urdfdom REQUIRED IMPORTED_TARGET urdfdom)
pkg_check_modules(kdl REQUIRED IMPORTED_TARGET orocos-kdl)
pkg_check_modules(pugixml REQUIRED IMPORTED_TARGET pugixml)
pkg_check_modules(json REQUIRED IMPORTED_TARGET nlohmann_json)
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
# Only the virtual receptors link OpenCV and AprilTag. OpenCV's own CMake package asks for everything that it has, and
# comes with Qt and MPI.
foreach(module core imgproc imgcodecs video videoio calib3d)
  find_library(MRROC_OPENCV_${module} opencv_${module} REQUIRED)
  if(NOT TARGET opencv_${module})
    find_path(MRROC_OPENCV_HEADERS opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
    add_library(opencv_${module} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(opencv_${module} PROPERTIES IMPORTED_LOCATION ${MRROC_OPENCV_${module}}
                          INTERFACE_INCLUDE_DIRECTORIES ${MRROC_OPENCV_HEADERS})
  endif()
endforeach()
pkg_check_modules(apriltag REQUIRED IMPORTED_TARGET apriltag)
