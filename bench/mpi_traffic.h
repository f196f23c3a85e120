#pragma once
#include <cstdint>

/// What this process has given to MPI since it began, on communicators of several ranks.
///
/// MPI lets a library stand between a program and itself (the profiling interface, MPI 3.1 §14.2): mpi_traffic.cpp does, and counts. It is
/// linked to tests that count messages, and is a library of its own that can be loaded before any program:
///
///   MORULA_TRAFFIC=FILE LD_PRELOAD=build/bench/libmorula_traffic.so mpirun -n 4 build/morula run study.yaml
struct MpiTraffic {
  struct Count {
    std::uint64_t calls = 0, bytes = 0, largest = 0;
  };
  Count messages;     ///< sent to one other rank
  Count collectives;  ///< bytes that this rank gives or gets, whichever is more
};

/// The counts so far.
const MpiTraffic& mpi_traffic();
