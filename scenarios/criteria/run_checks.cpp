#include "scenarios/criteria/run_checks.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace morula::scenarios {
namespace {

constexpr const char* kTests = "none: held by the tests of the program, not looked at in a run";

constexpr std::array kChecks{
    RunCheck{"INV.1", "forces between cells and within them add up to nothing", kTests,
             "A sum over all cells of what they do to each other."},
    RunCheck{"INV.2", "surfaces stay closed, with well-shaped faces", kTests,
             "Connectivity, orientation and least angle of the meshes of shells."},
    RunCheck{
        "INV.3", "volume of any cell against its pressure law, relative", "limits.volume_error",
        "Of every cell at every output: its volume against that which its target volume and its inner pressure ask for. Rounding, unless "
        "growth, a division or an exchange of bodies has lost volume on the way: a fault of the program, worth a report."},
    RunCheck{
        "INV.4", "deepest penetration of a surface at the start and in any step", "limits.overlap",
        "How far a node of a shell lies within another shell or an obstacle, or its nucleus in its cortex. Spheres of a pair law overlap "
        "by "
        "design and do not count. Where it fails, contacts are too soft for the pressure on them (`contact.repulsion`, `contact.range`), "
        "meshes too coarse (`nodes`), or cells begin in each other (other places, `start_volume` and `inflate`, or a larger limit)."},
    RunCheck{"INV.5", "how far a node of a nucleus is outside its cortex, at any output", "limits.overlap",
             "Of nuclei that are shells; where they are rigid nothing measures it."},
    RunCheck{"INV.6", "residual of the linear systems", kTests, "What the solver leaves of the forces of a step: `numerics.tolerance`."},
    RunCheck{"INV.7", "rise of the energy between outputs, relative to its range", "0.001",
             "Only where nothing drives the tissue: there friction takes energy, and a rise is an error of the steps (`time.step`)."},
    RunCheck{"INV.8", "the same bits on any number of threads and ranks", kTests,
             "`state_hash` of two runs says whether they ended with the same bits."},
    RunCheck{"INV.9", "the same bits over a restart", kTests,
             "`state_hash` of a run that was stopped and resumed, and of one that was not."},
    RunCheck{"LIMIT.field_balance", "balance of the amounts of every field, relative", "limits.field_balance",
             "What cells and faces of the domain gave and took against what there is more or less of it."},
    RunCheck{"LIMIT.outside_fields", "cells beyond the faces of the domain, where no field is", "0",
             "They neither see a field nor take from it: a larger `domain.size`, or `wall` faces."},
};

}  // namespace

std::span<const RunCheck> run_checks() { return kChecks; }

const RunCheck& run_check(std::string_view id) {
  const auto* found = std::ranges::find(kChecks, id, [](const RunCheck& one) { return std::string_view(one.id); });
  assert(found != kChecks.end());
  return *found;
}

}  // namespace morula::scenarios
