#include "fields/builtin.h"

namespace morula::fields {
std::vector<LawInfo> field_laws() {
  return {{.name = "diffusion",
           .title = "Diffusion, decay and uptake by cells",
           .equation = "∂c/∂t = D ∇²c − λ c − Σ_i w_i V_max c/(K_m + c)",
           .source = "Michaelis & Menten 1913; integrated by ARKODE (Reynolds et al. 2023, doi:10.1145/3594632)",
           .parameters = {given_by_study("diffusion", "diffusion", "µm²/s", "D."), given_by_study("decay", "rate", "1/s", "λ."),
                          given_by_study("initial", "concentration", "mM", "At time 0."),
                          given_by_study("voxel", "length", "µm", "Wanted voxel size.")}},
          {.name = "uptake",
           .title = "Uptake by one cell",
           .equation = "V_max c/(K_m + c)",
           .source = "Michaelis & Menten 1913",
           .parameters = {given_by_study("rate", "amount rate", "amol/s", "V_max."),
                          given_by_study("half_saturation", "concentration", "mM", "K_m.")}}};
}

}  // namespace morula::fields
