# SPDX-License-Identifier: BSL-1.0
# cmake -D PORT_FOLDER=... -D WORK=... [-D FEATURES=mpi] -P vcpkg_functions.cmake: runs a portfile with stand-ins for the
# functions of vcpkg that it calls, as vcpkg's documentation describes them; the package comes to lie in WORK/package.
cmake_minimum_required(VERSION 3.25)
set(PORT scarp)
set(CURRENT_PACKAGES_DIR ${WORK}/package)

function(must)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${code}:\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

function(vcpkg_check_features)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_FEATURE_OPTIONS" "FEATURES;INVERTED_FEATURES")
  while(arg_INVERTED_FEATURES)
    list(POP_FRONT arg_INVERTED_FEATURES feature variable)
    set(value ON)
    if(feature IN_LIST FEATURES)
      set(value OFF)
    endif()
    list(APPEND options -D${variable}=${value})
  endwhile()
  set(${arg_OUT_FEATURE_OPTIONS} ${options} PARENT_SCOPE)
endfunction()

function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  must(${CMAKE_COMMAND} -S ${arg_SOURCE_PATH} -B ${WORK}/build -D CMAKE_BUILD_TYPE=Release
       -D CMAKE_INSTALL_PREFIX=${CURRENT_PACKAGES_DIR} -D FETCHCONTENT_FULLY_DISCONNECTED=ON ${arg_OPTIONS})
  if(said MATCHES "Manually-specified variables were not used")
    message(FATAL_ERROR "the port names options that scarp does not have:\n${said}")
  endif()
endfunction()

function(vcpkg_cmake_install)
  must(${CMAKE_COMMAND} --install ${WORK}/build)
endfunction()

function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "CONFIG_PATH" "")
  file(RENAME ${CURRENT_PACKAGES_DIR}/${arg_CONFIG_PATH} ${WORK}/config)
  cmake_path(GET arg_CONFIG_PATH PARENT_PATH parent)
  file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/${parent})
  file(RENAME ${WORK}/config ${CURRENT_PACKAGES_DIR}/share/${PORT})
  set(targets ${CURRENT_PACKAGES_DIR}/share/${PORT}/scarpTargets.cmake)
  file(READ ${targets} text)
  # One folder fewer between the file and the prefix.
  string(REPLACE "get_filename_component(_IMPORT_PREFIX \"\${_IMPORT_PREFIX}\" PATH)\nif(" "if(" text "${text}")
  file(WRITE ${targets} "${text}")
endfunction()

function(vcpkg_fixup_pkgconfig)
  if(NOT EXISTS ${CURRENT_PACKAGES_DIR}/share/pkgconfig/scarp.pc)
    message(FATAL_ERROR "no share/pkgconfig/scarp.pc to mend")
  endif()
endfunction()

function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILE_LIST")
  file(COPY_FILE ${arg_FILE_LIST} ${CURRENT_PACKAGES_DIR}/share/${PORT}/copyright)
endfunction()

include(${PORT_FOLDER}/portfile.cmake)
