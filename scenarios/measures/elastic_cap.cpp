#include "scenarios/measures/elastic_cap.h"

#include <cmath>

namespace morula::scenarios {
namespace {

constexpr std::uint32_t kMeasuredNodes = 642;  // of dcm.md §8
constexpr ElasticCap kElastic[] = {{0.5, 2.0, 0.839, 1.687}, {1.0, 2.0, 1.104, 1.464}};

}  // namespace

const ElasticCap* elastic_cap(double ratio, double modulus, std::uint32_t nodes) {
  for (const ElasticCap& cap : kElastic)
    if (nodes >= kMeasuredNodes && std::abs(cap.ratio - ratio) < 1e-9 && std::abs(cap.modulus - modulus) < 1e-9) return &cap;
  return nullptr;
}

double tension_at(const CellType& type, double time) { return type.regional_tension.of_face(type.shell.tension, {}, 0.0, time); }

double range_of(const Model& model, std::size_t a, std::size_t b) {
  const double own = model.pair(a, b).range;
  return own > 0.0 ? own : model.contact.range;
}

}  // namespace morula::scenarios
