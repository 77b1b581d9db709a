# SPDX-License-Identifier: BSL-1.0
# cmake -D MANIFEST=<install_manifest.txt> -P uninstall.cmake: removes what the last installation wrote, and folders that
# are empty then.
if(NOT EXISTS "${MANIFEST}")
  message(FATAL_ERROR "there is no '${MANIFEST}' (nothing was installed from this build): run the installation first")
endif()
file(STRINGS "${MANIFEST}" files)
foreach(file IN LISTS files)
  file(REMOVE "$ENV{DESTDIR}${file}")
  cmake_path(GET file PARENT_PATH folder)
  while(folder MATCHES "/scarp(/|$)|/glibc-hwcaps(/|$)")
    # rmdir takes no folder that still holds something, whatever its name is.
    execute_process(COMMAND rmdir "$ENV{DESTDIR}${folder}" RESULT_VARIABLE left ERROR_QUIET)
    if(left)
      break()
    endif()
    cmake_path(GET folder PARENT_PATH folder)
  endwhile()
endforeach()
file(REMOVE "${MANIFEST}")
