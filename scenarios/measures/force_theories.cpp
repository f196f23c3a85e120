// Pressures and forces.
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "coupling/changing_box.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/theories.h"

namespace morula::scenarios {
namespace {

Status wrong(const std::string& needs) { return Error{ErrorKind::kInput, needs, ""}; }

Result<double> laplace_value(FinishedRun& run, const Subject& s, const std::string&, const Sample& sample) {
  MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot_at(sample.time));
  if (snapshot == nullptr) return std::nan("");
  double sum = 0.0;
  int count = 0;
  for (const Snapshot::Cell& cell : snapshot->cells) {
    if (!is_meant(cell, s) || (!sample.cell.empty() && cell.id.text() != sample.cell)) continue;
    sum += 2.0 * tension_at(run.study().model.types[cell.type], sample.time) / cell.radius;
    ++count;
  }
  return count > 0 ? sum / count : std::nan("");
}

/// What the cells of a type stick to most: a material, cell types before obstacles; −1 where they stick to nothing.
int partner_of(const Model& model, std::size_t type) {
  int best = -1;
  double most = 0.0;
  for (std::size_t other = 0; other < model.material_count(); ++other)
    if (model.pair(type, other).adhesion > most) {
      most = model.pair(type, other).adhesion;
      best = static_cast<int>(other);
    }
  return best;
}

}  // namespace

Theory laplace_law() {
  return {"laplace",
          "Laplace's law",
          "Pressure in a free ball with a cortical tension T; R is that of a ball of the cell's volume.",
          "p = 2 T/R",
          "Laplace 1806",
          {"pressure_inside"},
          [](const Study& study, const Subject& s, const std::string&) {
            return s.type < 0 || study.model.types[static_cast<std::size_t>(s.type)].shell.tension > 0.0
                       ? Status{}
                       : wrong("needs cells with a cortical tension");
          },
          &laplace_value};
}

Theory filled_box() {
  return {"filled_box",
          "cells that fill their box",
          "Pressure of cells that fill a periodic box and whose cortex presses as that of a free ball: V0 is the volume of the free cells "
          "together, by the radius of their types, V that of the box, K the bulk modulus of the type (`dcm.bulk_modulus`), which its "
          "spheres have, too, unless `cbm.packing` gives them another one.",
          "p = K ln(V0/V)",
          "physics/fields_and_coupling.md D (a)",
          {"pressure", "mean_pressure"},
          [](const Study& study, const Subject&, const std::string&) {
            return periodic_along_all_axes(study.model.space) ? Status{} : wrong("needs a box that is periodic along x, y and z");
          },
          [](FinishedRun& run, const Subject& s, const std::string&, const Sample& sample) -> Result<double> {
            MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot_at(sample.time));
            if (snapshot == nullptr || snapshot->box.empty() || snapshot->cells.empty()) return std::nan("");
            const std::vector<CellType>& types = run.study().model.types;
            double free = 0.0;
            for (const Snapshot::Cell& cell : snapshot->cells) free += ball_volume(types[cell.type].radius.mean);
            const Vec3d edges = snapshot->box.size();
            const CellType& type = types[s.type >= 0 ? static_cast<std::size_t>(s.type) : snapshot->cells.front().type];
            return type.shell.bulk_modulus * std::log(free / (edges.x * edges.y * edges.z));
          }};
}

Theory jkr_pull_off() {
  return {"jkr_pull_off",
          "JKR pull-off",
          "Largest force that two elastic balls bear, or a ball and a plane; the cells of the load, and what they stick to most. R: of the "
          "cell "
          "types, as the study gives them.",
          "F = (3/2) pi W R, 1/R = 1/R1 + 1/R2",
          "Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141",
          {"force", "pull_off.force"},
          [](const Study& study, const Subject& s, const std::string&) {
            return partner_of(study.model, study.model.loads[static_cast<std::size_t>(s.load)].type) >= 0
                       ? Status{}
                       : wrong("needs cells that stick to something");
          },
          [](FinishedRun& run, const Subject& s, const std::string&, const Sample&) -> Result<double> {
            const Model& model = run.study().model;
            const std::size_t type = model.loads[static_cast<std::size_t>(s.load)].type;
            const int partner = partner_of(model, type);
            if (partner < 0) return std::nan("");
            const auto other = static_cast<std::size_t>(partner);
            const double own = model.types[type].radius.mean;
            const double radius = other < model.types.size() ? 1.0 / (1.0 / own + 1.0 / model.types[other].radius.mean) : own;
            return 1.5 * std::numbers::pi * model.pair(type, other).adhesion * radius;
          }};
}

}  // namespace morula::scenarios
