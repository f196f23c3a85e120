#pragma once

namespace morula {

/// To be called before MPI_Init(): settings that a user has given stay.
///
/// Open MPI talks about networks that a machine does not have, and about containers; none of that is a user's concern. Without a launcher
/// (mpirun, srun) it would start a daemon of its own for one rank, which takes longer than most verbs and hears the signals meant for us. And all
/// such processes of a user would make, and remove, the same folder under /tmp: one that starts while another ends would fail.
///
/// A rank that waits for another gives its core away (`mpi_yield_when_idle`). Open MPI would do so only where mpirun itself knows of more ranks
/// than cores; where it does not (a host given more slots, ranks held on one core by a batch system) the waiting rank keeps the core that the
/// awaited one needs, for a scheduler's time slice at every message: two ranks on one core took 71 s in place of 1.5 s. On cores of their own it
/// costs a system call in each turn of the waiting loop.
///
/// Where a machine has no fast network, messages go through shared memory and TCP (`ob1`) without a look for others: the library of Omni-Path
/// measures the speed of the processor as soon as it is loaded, for which it sleeps 0.2 s (0.12 s in place of 0.33 s for `morula --version`).
///
/// These settings are in the environment: a process that starts mpirun must take them out for it.
void quiet_mpi();

}  // namespace morula
