#pragma once

namespace morula {

/// To be called before MPI_Init(): settings that a user has given stay.
///
/// Open MPI talks about networks that a machine does not have, and about containers; none of that is a user's concern. Without a launcher
/// (mpirun, srun) it would start a daemon of its own for one rank, which takes longer than most verbs and hears the signals meant for us. And all
/// such processes of a user would make, and remove, the same folder under /tmp: one that starts while another ends would fail. These settings are
/// in the environment: a process that starts mpirun must take them out for it.
void quiet_mpi();

}  // namespace morula
