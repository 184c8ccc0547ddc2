# Third-party libraries, all from Debian 12's packages (cmake/install-dependencies.sh installs them). Their headers
# are system headers, because our warnings are for our code.
find_package(PNG REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)

find_path(TOMLPLUSPLUS_INCLUDE toml++/toml.h REQUIRED)
add_library(voxmelt_toml INTERFACE)
target_include_directories(voxmelt_toml SYSTEM INTERFACE ${TOMLPLUSPLUS_INCLUDE})

# libdeflate has no CMake package: who uses it links `deflate`.
find_path(DEFLATE_INCLUDE libdeflate.h REQUIRED)
find_library(DEFLATE_LIBRARY deflate REQUIRED)

# zstd and xxHash have none either: who uses them links `zstd` and `xxhash`.
find_path(ZSTD_INCLUDE zstd.h REQUIRED)
find_library(ZSTD_LIBRARY zstd REQUIRED)
find_path(XXHASH_INCLUDE xxhash.h REQUIRED)
find_library(XXHASH_LIBRARY xxhash REQUIRED)

# What the build can do without is taken where it is found, unless it is named here.
set(optional_libraries embree openvdb python tiff view webp)
set(VOXMELT_LEAVE_OUT "" CACHE STRING "Libraries to leave out though they are there, with semicolons between: ${optional_libraries}")
foreach(name ${VOXMELT_LEAVE_OUT})
  if(NOT name IN_LIST optional_libraries)
    message(FATAL_ERROR "VOXMELT_LEAVE_OUT: ${name} is none of ${optional_libraries}")
  endif()
endforeach()

# libwebp makes films where there is no ffmpeg. Who uses it links `webp`.
find_path(WEBP_INCLUDE webp/encode.h)
find_library(WEBP_LIBRARY webp)
if(WEBP_INCLUDE AND WEBP_LIBRARY AND NOT webp IN_LIST VOXMELT_LEAVE_OUT)
  set(WEBP_FOUND ON)
elseif(PROJECT_IS_TOP_LEVEL)
  message(STATUS "no libwebp: films want ffmpeg (apt-get install libwebp-dev)")
endif()

# libtiff reads height fields. Who uses it links `tiff`. Its errors go to a handler of one file since version 4.5.
find_path(TIFF_INCLUDE tiffio.h)
find_library(TIFF_LIBRARY tiff)
if(TIFF_INCLUDE AND TIFF_LIBRARY AND NOT tiff IN_LIST VOXMELT_LEAVE_OUT)
  file(STRINGS ${TIFF_INCLUDE}/tiffio.h tiff_of_4_5 REGEX TIFFOpenOptionsAlloc)
endif()
if(tiff_of_4_5)
  set(TIFF_FOUND ON)
elseif(PROJECT_IS_TOP_LEVEL)
  message(STATUS "no libtiff 4.5: height fields are read from ESRI ASCII grids and PNG (apt-get install libtiff-dev)")
endif()

# The library needs nothing of what follows.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
find_package(CLI11 REQUIRED)
find_package(benchmark REQUIRED)

# OpenVDB, of the program voxmelt-vdb alone. Its CMake modules ask for what we do not need.
find_path(OPENVDB_INCLUDE openvdb/openvdb.h)
find_library(OPENVDB_LIBRARY openvdb)
find_library(IMATH_LIBRARY NAMES Imath-3_1 Imath)
if(OPENVDB_INCLUDE AND OPENVDB_LIBRARY AND IMATH_LIBRARY AND NOT openvdb IN_LIST VOXMELT_LEAVE_OUT)
  set(OPENVDB_FOUND ON)
else()
  message(STATUS "no OpenVDB: .vdb files are neither read nor written (apt-get install libopenvdb-dev)")
endif()

# The two libraries of `voxmelt view`. Without them the rest is as ever.
if(NOT view IN_LIST VOXMELT_LEAVE_OUT)
  find_package(Boost 1.74 QUIET)
  find_package(JPEG QUIET)
endif()
# Boost 1.74 knows the coroutines of GCC, and not those of clang 14.
if(Boost_FOUND)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${Boost_INCLUDE_DIRS})
  set(CMAKE_REQUIRED_LIBRARIES Threads::Threads)
  check_cxx_source_compiles("#include <utility>
#include <boost/asio/awaitable.hpp>
#ifndef BOOST_ASIO_HAS_CO_AWAIT
#error
#endif
int main() { return 0; }" VOXMELT_COROUTINES)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
endif()

# SystemC as Debian builds it: C++17, also for us (else sc_api_version_... does not link).
find_package(PkgConfig REQUIRED)
pkg_check_modules(SYSTEMC REQUIRED systemc)
add_library(voxmelt_systemc INTERFACE)
target_include_directories(voxmelt_systemc SYSTEM INTERFACE ${SYSTEMC_INCLUDE_DIRS})
# It is linked only where it is used. Otherwise a program without a simulation would have to define sc_main.
target_link_libraries(voxmelt_systemc INTERFACE -Wl,--push-state,--as-needed ${SYSTEMC_LINK_LIBRARIES} -Wl,--pop-state)
target_compile_definitions(voxmelt_systemc INTERFACE SC_CPLUSPLUS=201703L)

# Embree is the one library that a build may lack: it is asked for on x86-64 only.
if(NOT embree IN_LIST VOXMELT_LEAVE_OUT)
  find_package(embree 3 CONFIG QUIET)
endif()
if(NOT embree_FOUND)
  message(STATUS "no Embree: rays are cast by two levels of bricks, or by the plain walk")
endif()
