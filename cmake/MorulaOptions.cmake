# Compiler options that hold for every target of the project.
#
# -ffp-contract=off        the same bits from every loop shape: no fused multiply-add behind our back
# -fno-math-errno          sqrt becomes one instruction (results unchanged)
# -fno-trapping-math       comparisons may be vectorised (results unchanged)
# -ffast-math is never used: it changes results.
add_compile_options(-Wall -Wextra -Wshadow -Werror -ffp-contract=off -fno-math-errno -fno-trapping-math)
# GCC 12 sees overlapping copies in std::string operations that have none (gcc.gnu.org/PR105329, PR105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# The deprecated C++ bindings of MPI are not wanted (their headers do not compile without warnings).
add_compile_definitions(OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)

if(MORULA_NATIVE)
  add_compile_options(-march=native)
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_FLAGS -march=native)
  check_cxx_source_runs("
    #ifndef __AVX512F__
    #error no AVX-512
    #endif
    int main() { return 0; }" MORULA_HAS_AVX512)
  unset(CMAKE_REQUIRED_FLAGS)
  if(MORULA_HAS_AVX512)
    add_compile_options(-mprefer-vector-width=512)
  endif()
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT MORULA_HAS_AVX512)
  # Lanes may be wider than the registers; how such vectors are passed matters only between differently compiled programs. And without wide
  # registers GCC 12 sees copies of 32 bytes into what is left of an array.
  add_compile_options(-Wno-psabi -Wno-stringop-overflow)
endif()

if(MORULA_SANITIZE)
  add_compile_options(-fsanitize=${MORULA_SANITIZE} -fno-omit-frame-pointer -UNDEBUG)
  # With its checks in between, GCC 12 loses sight of how long the arrays of a lane are, and of what a loop has set.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized)
  endif()
  add_link_options(-fsanitize=${MORULA_SANITIZE})
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
