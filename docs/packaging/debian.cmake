# SPDX-License-Identifier: BSL-1.0
# cpack -G DEB: the headers as a package for every architecture; with SCARP_INSTALL_PRECOMPILED, for this one.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME libscarp-dev)
set(CPACK_PACKAGE_VENDOR scarp)
set(CPACK_PACKAGE_CONTACT "The developers of scarp")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION "A header-only C++20 framework for finite elements whose integration points carry packings
of discrete elements, or any other constitutive provider.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "libeigen3-dev (>= 3.4), libboost-dev (>= 1.74), libnanoflann-dev (>= 1.4), libfmt-dev (>= 9.1)")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS cmake pkg-config)
if(TARGET scarp_mpi)
  list(APPEND CPACK_DEBIAN_PACKAGE_SUGGESTS libopenmpi-dev)
endif()
list(JOIN CPACK_DEBIAN_PACKAGE_SUGGESTS ", " CPACK_DEBIAN_PACKAGE_SUGGESTS)
if(SCARP_INSTALL_PRECOMPILED)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
else()
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
endif()
include(CPack)
