#include "fields/builtin.h"

#include "fields/reactions/decay.h"
#include "fields/reactions/secretion.h"
#include "fields/reactions/uptake.h"

namespace morula::fields {

std::vector<LawInfo> field_laws() {
  return {{.name = "diffusion",
           .title = "Diffusion, and what reactions take",
           .equation = "∂c/∂t = D ∇²c − Σ r(c) − Σ_i w_i u_i(c), r of reactions in the volume, u_i of those of cell i",
           .source = "Fick 1855; integrated by ARKODE (Reynolds et al. 2023, doi:10.1145/3594632)",
           .parameters = {given_by_study("diffusion", "diffusion", "µm²/s", "D."),
                          given_by_study("initial", "concentration", "mM", "At time 0."),
                          given_by_study("voxel", "length", "µm", "Wanted voxel size.")}}};
}

std::vector<std::shared_ptr<const Reaction>> builtin_reactions() { return {decay(), uptake(), secretion()}; }

}  // namespace morula::fields
