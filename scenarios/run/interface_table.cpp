#include "scenarios/run/interface_table.h"

#include <cmath>

#include "core/numbers/number_text.h"
#include "core/numbers/sample.h"
#include "scenarios/measures/interface_layers.h"
#include "scenarios/run/progress.h"

namespace morula::scenarios {
namespace {

std::string text_of(const LayerMean& value, double scale) {
  if (std::isnan(value.mean)) return "–";
  const double error = scale * told_spread(value.error, value.mean);
  return number_text("%.4g", scale * value.mean) + (std::isnan(error) ? "" : " ± " + number_text(error < 10.0 ? "%.1g" : "%.0f", error));
}

std::string name_of(const InterfaceLayer& layer) {
  const std::string body = layer.body == BodyKind::kShell ? "shells" : "spheres";
  if (layer.number == 1) return body + " that touch " + (layer.body == BodyKind::kShell ? "spheres" : "shells");
  return body + ", layer " + std::to_string(layer.number) + (layer.and_beyond ? " and beyond" : "");
}

std::vector<std::string> row(std::string name, std::string cells, const LayerMean& pressure, const LayerMean& contact,
                             const LayerMean& volume, const LayerMean& way, const LayerMean& speed) {
  return {std::move(name),      std::move(cells),  text_of(pressure, 1e3), text_of(contact, 100.0),
          text_of(volume, 1.0), text_of(way, 1.0), text_of(speed, 3600.0)};
}

}  // namespace

std::optional<ReportTable> interface_table(const Study& study, const std::vector<Snapshot>& snapshots) {
  if (snapshots.size() < 2) return std::nullopt;
  const Snapshot &before = snapshots[snapshots.size() - 2], &now = snapshots.back();
  const auto layers = interface_layers(snapshots.front(), before, now, study.model.space);
  if (layers.empty()) return std::nullopt;
  ReportTable out{"Where spheres and shells meet",
                  "At the end, mean ± standard error over the cells of a layer: 1 touches the other body, 2 touches those, and so on. Ways "
                  "since the start; "
                  "speeds are net ways since " +
                      time_text(before.time) + ". A tissue that does not notice its bodies goes on evenly across the interface.",
                  {"layer", "cells", "pressure [Pa]", "contact over surface [%]", "volume [µm³]", "way [µm]", "speed [µm/h]"},
                  {}};
  for (const InterfaceLayer& one : layers)
    out.rows.push_back(row(name_of(one), std::to_string(one.cells), one.pressure, one.contact_part, one.volume, one.way, one.speed));
  out.rows.push_back(row("jump: shells less spheres that touch", "", jump(layers, &InterfaceLayer::pressure),
                         jump(layers, &InterfaceLayer::contact_part), jump(layers, &InterfaceLayer::volume),
                         jump(layers, &InterfaceLayer::way), jump(layers, &InterfaceLayer::speed)));
  return out;
}

}  // namespace morula::scenarios
