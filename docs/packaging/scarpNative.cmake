# SPDX-License-Identifier: BSL-1.0
# scarp_native(<target> [LEVEL <level>])
# Compiles a target for this machine, or for a level of an instruction set such as x86-64-v3, with the options that make
# scarp's kernels fast. In a program of several targets call it for all of them: the instruction set changes how Eigen
# aligns its objects. With scarp::precompiled it is not needed.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag("-mmove-max=512 -mstore-max=512" SCARP_HAS_WIDE_MOVES)

# scarp_note_build_type(): tells once whoever configures without a build type what that costs.
function(scarp_note_build_type)
  get_property(several GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  get_property(told GLOBAL PROPERTY SCARP_BUILD_TYPE_TOLD)
  if(NOT CMAKE_BUILD_TYPE AND NOT several AND NOT told AND NOT CMAKE_CXX_FLAGS MATCHES "-O[1-3sf]")
    set_property(GLOBAL PROPERTY SCARP_BUILD_TYPE_TOLD ON)
    message(WARNING "scarp: there is no CMAKE_BUILD_TYPE (without optimisation programs are some twenty times slower): add "
                    "-D CMAKE_BUILD_TYPE=Release")
  endif()
endfunction()

# scarp_kernel_flags(<variable>): what makes the kernels fast beside the instruction set. g++ otherwise copies arrays of vector
# registers in pieces of 16 bytes, or of AVX-512 in halves, which costs the pair loop a tenth to a third of its speed.
function(scarp_kernel_flags variable)
  set(${variable} -O3 -fno-math-errno -fno-trapping-math $<$<BOOL:${SCARP_HAS_WIDE_MOVES}>:-mmove-max=512;-mstore-max=512>
      PARENT_SCOPE)
endfunction()

function(scarp_native target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LEVEL" "")
  if(DEFINED arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "scarp_native(${target}) got '${arg_UNPARSED_ARGUMENTS}' (unknown): did you mean LEVEL?")
  endif()
  if(NOT DEFINED arg_LEVEL)
    set(arg_LEVEL native)
  endif()
  scarp_kernel_flags(flags)
  target_compile_options(${target} PRIVATE -march=${arg_LEVEL} ${flags})
endfunction()
