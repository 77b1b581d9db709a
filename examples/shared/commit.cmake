# SPDX-License-Identifier: BSL-1.0
# Writes the commit of the folder SOURCE into HEADER, which stays as it is when that has not changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 OUTPUT_VARIABLE commit ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define SCARP_COMMIT \"${commit}\"\n")
