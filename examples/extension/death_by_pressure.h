#pragma once
#include <memory>

#include <coupling/behaviours/behaviour.h>
#include <coupling/cell_view.h>

/// A behaviour: a cell that is pressed by more than a threshold dies at a rate. Crowding pushes epithelial cells out and kills them: Eisenhoffer et al.
/// 2012, doi:10.1038/nature10999.
///
/// In a study: `death_by_pressure: {above: 100 Pa, rate: 0.5 1/h}` of a cell type. The pressure is that of the cell averaged over a minute; draws are
/// those of the cell and the step, so that they are the same on any threads and ranks, and after a restart.
inline std::shared_ptr<const morula::Behaviour> death_by_pressure() {
  const morula::KeySpec above{.name = "above",
                              .doc = "Pressure above which cells may die.",
                              .quantity = morula::Quantity::kPressure,
                              .required = true,
                              .low = 0.0,
                              .example = "100 Pa"};
  const morula::KeySpec rate{.name = "rate",
                             .doc = "Probability of death per time while above.",
                             .quantity = morula::Quantity::kRate,
                             .fallback = "0.5 1/h",
                             .low = 0.0,
                             .example = "0.5 1/h",
                             .source = "chosen: extrusion takes some hours"};
  morula::Behaviour out;
  out.info = {.name = "death_by_pressure",
              .title = "Death under pressure",
              .equation = "P(death in Δt) = 1 − e^(−rate·Δt) while the averaged pressure is above the threshold",
              .source = "after Eisenhoffer et al. 2012, doi:10.1038/nature10999",
              .parameters = {morula::given_by_study("above", "pressure", "kPa", "Pressure above which cells may die."),
                             morula::given_by_study("rate", "rate", "1/s", "Probability of death per time.")}};
  out.section = {.name = "death_by_pressure", .doc = "Death under pressure.", .example = "{above: 100 Pa}"};
  out.keys = {{morula::OwnKey::Kind::kQuantity, above}, {morula::OwnKey::Kind::kQuantity, rate}};
  out.build = [](const morula::OwnValues& values) -> morula::Behave {
    return [above = values("above"), rate = values("rate")](const morula::CellStep& step, morula::CellWish& wish) {
      if (step.cell.row().pressure > above && step.happens(rate)) wish.die = true;
    };
  };
  return std::make_shared<const morula::Behaviour>(std::move(out));
}
