#include "bench/mpi_traffic.h"

#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

MpiTraffic counted;  // MPI calls its stand-ins without any argument of ours

std::uint64_t bytes_of(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return static_cast<std::uint64_t>(count) * static_cast<std::uint64_t>(size);
}

std::uint64_t ranks_of(MPI_Comm comm) {
  int ranks = 1;
  PMPI_Comm_size(comm, &ranks);
  return static_cast<std::uint64_t>(ranks);
}

void add(MpiTraffic::Count& count, std::uint64_t bytes, MPI_Comm comm) {
  if (ranks_of(comm) == 1) return;
  ++count.calls;
  count.bytes += bytes;
  count.largest = std::max(count.largest, bytes);
}

void message(int count, MPI_Datatype type, MPI_Comm comm) { add(counted.messages, bytes_of(count, type), comm); }
void collective(std::uint64_t bytes, MPI_Comm comm) { add(counted.collectives, bytes, comm); }

/// One line of JSON: means over the ranks, and of each count the most of any rank.
void write(const char* path) {
  int rank = 0, ranks = 1;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  PMPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const MpiTraffic::Count &m = counted.messages, &c = counted.collectives;
  const std::uint64_t mine[6] = {m.calls, m.bytes, m.largest, c.calls, c.bytes, c.largest};
  std::uint64_t sum[6], most[6];
  PMPI_Reduce(mine, sum, 6, MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
  PMPI_Reduce(mine, most, 6, MPI_UINT64_T, MPI_MAX, 0, MPI_COMM_WORLD);
  if (rank != 0) return;
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return;
  const char* const names[6] = {"messages", "message_bytes", "largest_message", "collectives", "collective_bytes", "largest_collective"};
  std::fprintf(file, "{\"ranks\": %d", ranks);
  for (int i = 0; i < 6; ++i)
    std::fprintf(file, ", \"%s\": {\"mean\": %.6g, \"most\": %llu}", names[i], static_cast<double>(sum[i]) / ranks,
                 static_cast<unsigned long long>(most[i]));
  std::fprintf(file, "}\n");
  std::fclose(file);
}

}  // namespace

const MpiTraffic& mpi_traffic() { return counted; }

extern "C" {

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  message(count, type, comm);
  return PMPI_Send(data, count, type, to, tag, comm);
}
int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  message(count, type, comm);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}
int MPI_Rsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  message(count, type, comm);
  return PMPI_Rsend(data, count, type, to, tag, comm);
}
int MPI_Allreduce(const void* from, void* into, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  collective(bytes_of(count, type), comm);
  return PMPI_Allreduce(from, into, count, type, operation, comm);
}
int MPI_Reduce(const void* from, void* into, int count, MPI_Datatype type, MPI_Op operation, int root, MPI_Comm comm) {
  collective(bytes_of(count, type), comm);
  return PMPI_Reduce(from, into, count, type, operation, root, comm);
}
int MPI_Reduce_scatter_block(const void* from, void* into, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  collective(bytes_of(count, type) * ranks_of(comm), comm);
  return PMPI_Reduce_scatter_block(from, into, count, type, operation, comm);
}
int MPI_Scan(const void* from, void* into, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  collective(bytes_of(count, type), comm);
  return PMPI_Scan(from, into, count, type, operation, comm);
}
int MPI_Exscan(const void* from, void* into, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  collective(bytes_of(count, type), comm);
  return PMPI_Exscan(from, into, count, type, operation, comm);
}
int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  collective(bytes_of(count, type), comm);
  return PMPI_Bcast(data, count, type, root, comm);
}
int MPI_Barrier(MPI_Comm comm) {
  collective(0, comm);
  return PMPI_Barrier(comm);
}
int MPI_Allgather(const void* from, int count, MPI_Datatype type, void* into, int each, MPI_Datatype into_type, MPI_Comm comm) {
  collective(bytes_of(each, into_type) * ranks_of(comm), comm);
  return PMPI_Allgather(from, count, type, into, each, into_type, comm);
}
int MPI_Allgatherv(const void* from, int count, MPI_Datatype type, void* into, const int counts[], const int places[],
                   MPI_Datatype into_type, MPI_Comm comm) {
  std::uint64_t bytes = 0;
  for (std::uint64_t r = 0; r < ranks_of(comm); ++r) bytes += bytes_of(counts[r], into_type);
  collective(bytes, comm);
  return PMPI_Allgatherv(from, count, type, into, counts, places, into_type, comm);
}
int MPI_Alltoall(const void* from, int count, MPI_Datatype type, void* into, int each, MPI_Datatype into_type, MPI_Comm comm) {
  collective(bytes_of(each, into_type) * ranks_of(comm), comm);
  return PMPI_Alltoall(from, count, type, into, each, into_type, comm);
}
int MPI_Finalize() {
  if (const char* path = std::getenv("MORULA_TRAFFIC")) write(path);
  return PMPI_Finalize();
}

}  // extern "C"
