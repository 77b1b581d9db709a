# SPDX-License-Identifier: BSL-1.0
# An overlay port of the sources that it lies in. A port of a registry begins with vcpkg_from_git or its like instead.
cmake_path(ABSOLUTE_PATH CMAKE_CURRENT_LIST_DIR NORMALIZE OUTPUT_VARIABLE port_folder)
cmake_path(APPEND port_folder "../../.." OUTPUT_VARIABLE SOURCE_PATH)
cmake_path(NORMAL_PATH SOURCE_PATH)

set(VCPKG_BUILD_TYPE release)  # headers only
vcpkg_check_features(OUT_FEATURE_OPTIONS feature_options INVERTED_FEATURES mpi CMAKE_DISABLE_FIND_PACKAGE_MPI)
# What stands on the machine outside vcpkg must not decide what the package holds.
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${feature_options}
    -DSCARP_BUILD_TESTS=OFF
    -DSCARP_BUILD_EXAMPLES=OFF
    -DSCARP_BUILD_BENCHMARKS=OFF
    -DSCARP_CHOLMOD=OFF
    -DSCARP_UMFPACK=OFF
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/scarp)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/doc")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
