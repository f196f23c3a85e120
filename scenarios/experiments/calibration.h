#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cbm/sphere_range.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "scenarios/calibrate/confidence.h"
#include "scenarios/calibrate/crowded_area.h"
#include "scenarios/calibrate/held_out.h"
#include "scenarios/calibrate/pressed_cluster.h"
#include "scenarios/calibrate/table_fit.h"
#include "scenarios/experiments/data_of_runs.h"
#include "scenarios/experiments/mixed_contact.h"
#include "scenarios/experiments/run_experiments.h"
#include "scenarios/experiments/spheres_in_clusters.h"
#include "study/study.h"

namespace morula::scenarios {

/// With what friction the spheres of a law are as fast as shells; none: not known.
struct FrictionOfSpheres {
  std::optional<calibrate::FittedFriction> approach;  ///< two that come together
  std::optional<calibrate::FittedAlong> along;        ///< along the contact: balls of cells that are pressed flat
};

/// Spheres of a pair law, with what they have beside it, found from the same shells, and how well they do.
struct SpheresOfLaw {
  TrialLaw law;                           ///< with its friction, but for that along the contact as it was found last
  std::vector<cbm::PackingKnot> packing;  ///< what their pairs leave to packings; empty: nothing
  calibrate::FittedCrowding crowding;     ///< contact areas among many
  FrictionOfSpheres friction;
  calibrate::HeldOutErrors held_out;
  std::vector<RestingCluster> clusters;  ///< those of shells, fitted and held out
};

/// A law by a table, fitted to the same points as JKR.
struct FittedTable {
  cbm::PairTable table;
  calibrate::ForceExponent exponent;
  SpheresOfLaw spheres;
};

/// A contact law of spheres, found from deformable cells.
struct Calibration {
  CellMaterial material;
  std::vector<Experiment> experiments;
  std::vector<std::string> left_out;  ///< names of experiments that the budget has no time for
  std::vector<ExperimentOutcome> outcomes;
  ExperimentData data;
  calibrate::SureFit sure;                  ///< of JKR
  double misfit = 0.0;                      ///< part of the loss of pairs that JKR cannot take
  SpheresOfLaw jkr;                         ///< of the fitted JKR
  std::optional<MixedContact> with_shells;  ///< none: not known, as a remark says
  std::optional<FittedTable> table;         ///< none: its points make no table, as a remark says

  /// Contact radius over R of two spheres of the fitted JKR at rest.
  [[nodiscard]] double rest_of_jkr() const;
  /// JKR says nothing true of contacts that are so large, their area least of all.
  [[nodiscard]] bool jkr_is_beyond_range() const { return rest_of_jkr() > cbm::kJkrRange; }
  /// The law to take of two spheres that nobody else touches, and what they have beside it.
  [[nodiscard]] calibrate::PairModel law_to_take() const { return spheres_to_take().law.of_two(); }
  [[nodiscard]] const SpheresOfLaw& spheres_to_take() const { return table_is_better() ? table->spheres : jkr; }
  /// Whether the table is the law to take: where JKR is beyond its range at rest, and where the table is better on what was held out.
  [[nodiscard]] bool table_is_better() const {
    return table && (jkr_is_beyond_range() || table->spheres.held_out.score() < jkr.held_out.score());
  }
};

/// Runs the experiments for a cell type of a study in the folder of the request, and fits JKR and a packing curve to what they find. Everything that was
/// run before in that folder is taken over. The result is the same on any number of ranks and threads, and after any break. Collective; the fit is
/// made on the root, and the others get what is known before it. Errors: those of material_of(), within_budget(), run_experiments(), data_of_runs() and the fit.
Result<Calibration> calibrate_jkr(const Study& study, const std::string& type, const ExperimentRequest& request, const Comm& comm);

/// 32 hexadecimal digits over the text of a material.
std::string hash_of(const CellMaterial& material);

/// TYPE.jkr.yaml, which study/fitted_law.h reads: the laws with their units, intervals, covariance, ranges, residuals and errors, and of what cells they are. The same bytes for the same
/// experiments.
std::string calibration_text(const Calibration& found);

/// report.html of a calibration: points and fits, residuals, profiles, numbers with their intervals, remarks. `command`: as typed.
Status write_calibration_report(const Calibration& found, const std::string& command, const std::filesystem::path& path);

}  // namespace morula::scenarios
