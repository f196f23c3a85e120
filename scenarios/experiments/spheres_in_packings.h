#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/result.h"
#include "scenarios/calibrate/loss.h"
#include "scenarios/experiments/found_curves.h"
#include "scenarios/experiments/trial_law.h"
#include "study/study.h"

namespace morula::scenarios {

/// Where spheres lie in a random packing, and what their pairs bear there, is decided by their law, which is fitted to that pressure: the fit and the
/// places are found in turns (decision 0056).
class SpheresInPackings {
 public:
  /// `packings`: those of Data::packings, in their order; those without centres are no random ones. `threads` let packings come to rest side by side.
  /// Errors (kInternal): a study of such spheres is refused.
  static Result<SpheresInPackings> read(const CellMaterial& material, std::span<const FoundPacking> packings, int threads);

  /// Puts spheres of a law where the shells of the random packings are, those that are held out or those that are not, and lets them come to rest with the friction
  /// of the law, or as far as they do in four times the time in which a pair does (decision 0073). Points get the places, with which the law tells the pressure
  /// of these spheres. Errors: kPhysics, spheres that find no rest; steps that fail.
  Status place(const TrialLaw& law, bool held_out, calibrate::Data& data) const;

 private:
  /// Spheres where the shells of a packing are.
  struct Start {
    Study study;
    double edge = 0.0;  ///< of the box [µm]
  };
  /// Of a packing that there is a start for.
  Status place_one(const TrialLaw& law, const Start& start, calibrate::PackingPoint& point) const;

  int threads_ = 1;
  double adhesion_ = 0.0;                     // of the shells [nN/µm]
  std::vector<std::optional<Start>> starts_;  // of the random packings
};

/// Makes a law that fits the points, lets spheres of the law find their places, makes it anew with these, and so on, until two turns in a row bring the
/// pressures of these spheres hardly nearer to those of the shells, in eight turns at most. `data` then has the places with which `make` gives the law whose spheres
/// came nearest. Without random packings to fit to nothing is done.
Status fit_in_turns(calibrate::Data& data, const calibrate::LossWeights& weights,
                    const std::function<Result<TrialLaw>(const calibrate::Data&)>& make, const SpheresInPackings& places);

}  // namespace morula::scenarios
