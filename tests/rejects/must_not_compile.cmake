# SPDX-License-Identifier: BSL-1.0
# cmake -D COMPILER=... -D SOURCE=... -D INCLUDES=... -P must_not_compile.cmake
file(STRINGS ${SOURCE} expectations REGEX "^// expect: ")
if(NOT expectations)
  message(FATAL_ERROR "${SOURCE} has no line `// expect: <regular expression>` (it must say why it is refused): add one")
endif()

set(command ${COMPILER} -std=c++20 -fsyntax-only)
foreach(folder ${INCLUDES})
  list(APPEND command -I ${folder})  # not -isystem, which would move /usr/include
endforeach()

execute_process(COMMAND ${command} -DSCARP_REPAIRED ${SOURCE} RESULT_VARIABLE result ERROR_VARIABLE messages)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${SOURCE} does not compile even when repaired:\n${messages}")
endif()
execute_process(COMMAND ${command} ${SOURCE} RESULT_VARIABLE result ERROR_VARIABLE messages)
if(result EQUAL 0)
  message(FATAL_ERROR "${SOURCE} compiles, although it must be refused")
endif()
foreach(expect ${expectations})
  string(REPLACE "// expect: " "" expect "${expect}")
  if(NOT messages MATCHES "${expect}")
    message(FATAL_ERROR "${SOURCE} is refused, but no message matches '${expect}':\n${messages}")
  endif()
endforeach()
