#include "app/cores.h"

#include <sched.h>

#include <algorithm>

#include "app/words.h"

namespace morula::app {
namespace {

/// Threads that run and cores for them.
struct Share {
  std::int64_t threads = 0, cores = 1;
  [[nodiscard]] bool crowded() const { return threads > cores; }
  [[nodiscard]] bool worse_than(const Share& other) const { return threads * other.cores > other.threads * cores; }
};

Share worst_of_all(const Share& mine, const Comm& comm) {
  const auto threads = comm.gather_to_all(mine.threads), cores = comm.gather_to_all(mine.cores);
  Share worst{threads[0], cores[0]};
  for (std::size_t r = 1; r < threads.size(); ++r)
    if (const Share share{threads[r], cores[r]}; share.worse_than(worst)) worst = share;
  return worst;
}

/// Of the ranks on this rank's machine together. Collective.
Share share_of_machine(const cpu_set_t& mine, int threads, const Comm& comm) {
  if (comm.size() == 1) return {threads, CPU_COUNT(&mine)};
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(comm.raw(), MPI_COMM_TYPE_SHARED, comm.rank(), MPI_INFO_NULL, &machine);
  int ranks = 1;
  MPI_Comm_size(machine, &ranks);
  cpu_set_t all = mine;
  MPI_Allreduce(MPI_IN_PLACE, &all, sizeof all, MPI_BYTE, MPI_BOR, machine);
  MPI_Comm_free(&machine);
  return {std::int64_t{ranks} * threads, CPU_COUNT(&all)};
}

}  // namespace

std::string crowded_cores(int threads, const Comm& comm) {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  const bool known = sched_getaffinity(0, sizeof mine, &mine) == 0 && CPU_COUNT(&mine) > 0;
  if (!comm.all(known)) return "";
  const Share machine = worst_of_all(share_of_machine(mine, threads, comm), comm);
  const Share rank = worst_of_all({threads, CPU_COUNT(&mine)}, comm);
  const auto told = [](const Share& share) {
    const bool one = share.cores == 1;
    return count_words(static_cast<std::uint64_t>(share.threads), "thread", "threads") + " share " +
           count_words(static_cast<std::uint64_t>(share.cores), "core", "cores") + (one ? "" : " of a machine");
  };
  if (machine.crowded()) return told(machine) + ": the run is slower than with fewer ranks or `--threads`";
  if (rank.crowded())
    return "the " + told(rank) +
           " that mpirun has bound their rank to: start it with `--bind-to none`, or `--map-by slot:PE=" + std::to_string(threads) + "`";
  return "";
}

}  // namespace morula::app
