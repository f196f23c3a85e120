#pragma once
#include <functional>

namespace morula::calibrate {

/// What a law of pairs says of two spheres in contact.
struct PairAnswer {
  double force = 0.0;  ///< > 0 pushes apart [nN]
  double area = 0.0;   ///< [µm²]
};

/// A law of attached pairs by overlap and effective radius [µm].
using PairModel = std::function<PairAnswer(double overlap, double reduced_radius)>;

/// E* of two equal spheres [kPa].
[[nodiscard]] double pair_modulus(double young, double poisson);

/// Johnson–Kendall–Roberts of two attached spheres (cbm/laws/jkr.h), E* [kPa], W [nN/µm].
///
/// Spheres further apart than the law has a contact, δ < −0.75 X, answer with −(5/6) πWR* + k (−0.75 X − δ), k = `beyond` [nN/µm], and the area of
/// the break: continuous, and the more wrong about a pair that does pull the further its break is from there, so that a fit that begins with too
/// little adhesion, or too stiff a body, finds the way. No sphere of a simulation sees this.
[[nodiscard]] PairAnswer jkr_pair(double modulus, double adhesion, double reduced_radius, double overlap, double beyond);

/// The same as a model, without tension beyond the break.
[[nodiscard]] PairModel jkr_model(double young, double poisson, double adhesion);

/// Overlap at which two attached spheres of a radius [µm] come to rest by a law that attracts at δ = 0; a negative number: none up to 1.9 R [µm].
[[nodiscard]] double resting_overlap(const PairModel& law, double radius);

}  // namespace morula::calibrate
