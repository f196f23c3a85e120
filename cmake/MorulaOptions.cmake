# Compiler options of Morula's own targets: morula_options(<target>) gives them to one. Nothing here holds for other projects, neither for one that
# Morula is a part of nor for one that uses an installed Morula.
#
# -ffp-contract=off        the same bits from every loop shape: no fused multiply-add behind our back
# -fno-math-errno          sqrt becomes one instruction (results unchanged)
# -fno-trapping-math       comparisons may be vectorised (results unchanged)
# -ffast-math is never used: it changes results.
set(MORULA_COMPILE_OPTIONS -Wall -Wextra -Wshadow -Werror -ffp-contract=off -fno-math-errno -fno-trapping-math)
# GCC's collection of its own garbage is a tenth of the time of a build: it begins at 400 MB, which most files do not reach.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND MORULA_COMPILE_OPTIONS "SHELL:--param ggc-min-heapsize=400000")
endif()
# GCC 12 sees overlapping copies in std::string operations that have none (gcc.gnu.org/PR105329, PR105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  list(APPEND MORULA_COMPILE_OPTIONS -Wno-restrict)
endif()
# What GCC warns of after it has inlined depends on the processor that -march=native stands for: such a warning must not keep a user from building.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND MORULA_COMPILE_OPTIONS -Wno-error=array-bounds -Wno-error=maybe-uninitialized -Wno-error=stringop-overflow -Wno-error=stringop-overread)
endif()
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Kind of build" FORCE)
endif()

# Options for the processor: what includes headers with lanes and is linked with Morula must be compiled with the same ones, for how lanes are passed
# depends on them. The package tells them (target morula::processor).
set(MORULA_PROCESSOR_OPTIONS "")
if(MORULA_NATIVE)
  list(APPEND MORULA_PROCESSOR_OPTIONS -march=native)
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_FLAGS -march=native)
  check_cxx_source_runs("
    #ifndef __AVX512F__
    #error no AVX-512
    #endif
    int main() { return 0; }" MORULA_HAS_AVX512)
  unset(CMAKE_REQUIRED_FLAGS)
  if(MORULA_HAS_AVX512)
    list(APPEND MORULA_PROCESSOR_OPTIONS -mprefer-vector-width=512)
  endif()
endif()
list(APPEND MORULA_COMPILE_OPTIONS ${MORULA_PROCESSOR_OPTIONS})
add_library(morula_processor INTERFACE)
add_library(morula::processor ALIAS morula_processor)
set_target_properties(morula_processor PROPERTIES EXPORT_NAME processor)
target_compile_options(morula_processor INTERFACE ${MORULA_PROCESSOR_OPTIONS} -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT MORULA_HAS_AVX512)
  # Lanes may be wider than the registers; how such vectors are passed matters only between differently compiled programs. And without wide
  # registers GCC 12 sees copies of 32 bytes into what is left of an array.
  list(APPEND MORULA_COMPILE_OPTIONS -Wno-psabi -Wno-stringop-overflow)
  target_compile_options(morula_processor INTERFACE -Wno-psabi)
endif()

set(MORULA_LINK_OPTIONS "")
if(MORULA_SANITIZE)
  # Assertions are on, those of the standard library too (an index beyond a vector or a span), and what a sanitizer finds ends the program: a test that
  # printed a finding and went on would pass.
  list(APPEND MORULA_COMPILE_OPTIONS -fsanitize=${MORULA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -UNDEBUG -D_GLIBCXX_ASSERTIONS)
  # With its checks in between, GCC 12 loses sight of how long the arrays of a lane are, and of what a loop has set.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND MORULA_COMPILE_OPTIONS -Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized)
  endif()
  list(APPEND MORULA_LINK_OPTIONS -fsanitize=${MORULA_SANITIZE})
endif()

find_program(CCACHE_PROGRAM ccache)

# The deprecated C++ bindings of MPI are not wanted (their headers do not compile without warnings).
function(morula_options target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  if(MORULA_POSITION_INDEPENDENT)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_compile_options(${target} PRIVATE ${MORULA_COMPILE_OPTIONS})
  target_link_options(${target} PRIVATE ${MORULA_LINK_OPTIONS})
  target_compile_definitions(${target} PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  if(CCACHE_PROGRAM)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM} C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  endif()
endfunction()

# Optimises a target less: for code that runs once, where half of compiling is optimising. Functions of headers that other libraries have not inlined may
# be those of such a target.
function(morula_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Tests: their own code hardly runs. Slow tests have all of it as users do.
function(morula_test_options target)
  morula_options(${target})
  morula_optimise_less(${target})
endfunction()
