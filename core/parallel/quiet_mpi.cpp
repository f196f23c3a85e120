#include "core/parallel/quiet_mpi.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>

namespace morula {
namespace {

/// Omni-Path, InfiniBand and what speaks its verbs, Slingshot.
bool has_fast_network() {
  return std::ranges::any_of(std::array{"/dev/hfi1_0", "/dev/infiniband", "/dev/cxi0"},
                             [](const char* device) { return std::filesystem::exists(device); });
}

}  // namespace

void quiet_mpi() {
  setenv("OMPI_MCA_btl_base_warn_component_unused", "0", 0);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  setenv("OMPI_MCA_shmem_mmap_enable_nfs_warning", "0", 0);
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  if (!has_fast_network()) setenv("OMPI_MCA_pml", "ob1", 0);
  for (const char* launched : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(launched) != nullptr) return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
}

}  // namespace morula
