#pragma once
#include <span>
#include <vector>

#include "dcm/lane_parameters.h"
#include "dcm/sheet_law.h"
#include "dcm/stencils/membrane.h"

namespace morula::dcm {

/// A sheet that shells of a block have: its coefficients by lane. A shell without it has the strength 0, and the other coefficients of one that
/// has it, so that the law takes the same way for all lanes.
template <class T, int W>
struct SheetInLanes {
  const SheetLaw* law = nullptr;
  std::array<Lane<T, W>, std::tuple_size_v<SheetCoefficients>> coefficient;
};

/// The sheets of the shells of one block, each once; a shell may have several of one law.
template <class T, int W>
std::vector<SheetInLanes<T, W>> sheets_of_block(const LaneBlock& block, const Shells& shells, const ShellMaterials& materials) {
  std::vector<SheetInLanes<T, W>> out;
  for (int lane = 0; lane < W; ++lane) {
    const auto& sheets = materials.of(shells, block.member[lane]).sheets;
    for (std::size_t k = 0; k < sheets.size(); ++k) {
      if (!(sheets[k].coefficient[0] > 0.0)) continue;
      std::size_t earlier = 0;  // sheets of the same law that this shell has before
      for (std::size_t j = 0; j < k; ++j) earlier += sheets[j].law == sheets[k].law && sheets[j].coefficient[0] > 0.0;
      std::size_t place = 0;
      for (std::size_t same = 0; place < out.size(); ++place)
        if (out[place].law == sheets[k].law.get() && same++ == earlier) break;
      const auto& c = sheets[k].coefficient;
      if (place == out.size()) {
        out.push_back({sheets[k].law.get(), {}});
        for (std::size_t i = 0; i < c.size(); ++i) out.back().coefficient[i] = Lane<T, W>(i == 0 ? T(0) : static_cast<T>(c[i]));
      }
      for (std::size_t i = 0; i < c.size(); ++i) out[place].coefficient[i].set(lane, static_cast<T>(c[i]));
    }
  }
  return out;
}

/// Several sheets of one block as the loops over its faces see them.
template <int W>
struct SheetSum {
  using Real = Lane<double, W>;
  std::span<const SheetInLanes<double, W>> sheets;

  MembraneStress<Real> stress(const Real& trace, const Real& det) const noexcept {
    MembraneStress<Real> out;
    for (const auto& sheet : sheets) sheet.law->template in_lanes<W>().add_stress(sheet.coefficient.data(), trace, det, out);
    return out;
  }
  void raise_excess(const Real& trace, const Real& det, Real& most) const noexcept {
    for (const auto& sheet : sheets)
      if (sheet.law->excess != nullptr) sheet.law->template in_lanes<W>().add_excess(sheet.coefficient.data(), trace, det, most);
  }
};

/// The same for the matrix of the implicit step.
template <int W>
struct SheetSumFloat {
  using Real = Lane<float, W>;
  std::span<const SheetInLanes<float, W>> sheets;

  MembraneStress<Real> stress(const Real& trace, const Real& det) const noexcept {
    MembraneStress<Real> out;
    for (const auto& sheet : sheets) sheet.law->template in_lanes<W>().add_stress_float(sheet.coefficient.data(), trace, det, out);
    return out;
  }
  MembraneModuli<Real> moduli(const Real& trace, const Real& det) const noexcept {
    MembraneModuli<Real> out;
    for (const auto& sheet : sheets) sheet.law->template in_lanes<W>().add_moduli(sheet.coefficient.data(), trace, det, out);
    return out;
  }
};

/// No sheet, where only the area of every face resists.
template <class Real>
struct NoSheet {
  MembraneStress<Real> stress(Real, Real) const noexcept { return {Real(0.0), Real(0.0), Real(0.0)}; }
  MembraneModuli<Real> moduli(Real, Real) const noexcept { return {Real(0.0), Real(0.0), Real(0.0), Real(0.0)}; }
};

}  // namespace morula::dcm
