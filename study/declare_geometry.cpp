#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void point(Section& s, const char* name, const char* doc, Given<Vec3d>& value, const char* fallback = nullptr) {
  s.vector({.name = name,
            .doc = doc,
            .quantity = Q::kLength,
            .fallback = fallback,
            .required = !fallback,
            .example = "[0 um, 0 um, 0 um]",
            .source = fallback ? "chosen" : ""},
           value);
}

void radius(Section& s, Given<double>& value) {
  s.quantity(
      {.name = "radius", .doc = "Radius.", .quantity = Q::kLength, .required = true, .low = 0.0, .low_open = true, .example = "50 um"},
      value);
}

void declare_pipette(Section& p, draft::Obstacle& o) {
  point(p, "from", "Centre of the mouth.", o.pipette.low_end);
  point(p, "to", "Centre of the far end.", o.pipette.high_end);
  radius(p, o.pipette.radius);
  const auto length = [&p](const char* name, const char* doc, const char* fallback, Given<double>& value) {
    p.quantity({.name = name,
                .doc = doc,
                .quantity = Q::kLength,
                .fallback = fallback,
                .low = 0.0,
                .low_open = true,
                .example = fallback,
                .source = "chosen"},
               value);
  };
  length("wall", "Thickness of the wall.", "1 um", o.pipette_wall);
  length("lip", "Radius with which the edges of the mouth are rounded, at most half the wall.", "0.5 um", o.pipette_lip);
  length("edge", "Edge length of the triangles near the mouth.", "0.4 um", o.pipette_edge);
}

}  // namespace

void declare_obstacle(Section& s, draft::Obstacle& o) {
  s.text({.name = "stl",
          .doc = "Surface from an STL file, relative to the study's folder: closed, oriented, not crossing itself.",
          .example = "mesh/capsule.stl"},
         o.stl);
  s.text({.name = "obj", .doc = "Surface from an OBJ file, as for `stl`.", .example = "mesh/capsule.obj"}, o.obj);
  s.quantity({.name = "scale",
              .doc = "Length of one unit of the STL or OBJ file.",
              .quantity = Q::kLength,
              .fallback = "1 um",
              .low = 0.0,
              .low_open = true,
              .example = "1 um",
              .source = "chosen"},
             o.scale);
  s.group({.name = "plane", .doc = "A rectangular slab whose upper face, seen along the normal, is the plane.", .optional_section = true},
          o.plane.present, [&o](Section& p) {
            point(p, "center", "Centre of the upper face.", o.plane.center, "[0 um, 0 um, 0 um]");
            p.vector({.name = "normal",
                      .doc = "Direction away from the solid; need not have length 1.",
                      .fallback = "[0, 0, 1]",
                      .example = "[0, 0, 1]",
                      .source = "chosen"},
                     o.plane.normal);
            p.quantity({.name = "size",
                        .doc = "Edge of the square face; the slab is a tenth as thick.",
                        .quantity = Q::kLength,
                        .required = true,
                        .low = 0.0,
                        .low_open = true,
                        .example = "200 um"},
                       o.plane.radius);
          });
  s.group({.name = "sphere", .doc = "A sphere.", .optional_section = true}, o.sphere.present, [&o](Section& p) {
    point(p, "center", "Centre.", o.sphere.center, "[0 um, 0 um, 0 um]");
    radius(p, o.sphere.radius);
  });
  s.group({.name = "cylinder", .doc = "A solid cylinder between two points.", .optional_section = true}, o.cylinder.present,
          [&o](Section& p) {
            point(p, "from", "Centre of one end.", o.cylinder.low_end);
            point(p, "to", "Centre of the other end.", o.cylinder.high_end);
            radius(p, o.cylinder.radius);
          });
  s.group({.name = "capsule", .doc = "A cylinder with round ends.", .optional_section = true}, o.capsule.present, [&o](Section& p) {
    point(p, "from", "Centre of one round end.", o.capsule.low_end);
    point(p, "to", "Centre of the other round end.", o.capsule.high_end);
    radius(p, o.capsule.radius);
  });
  s.group({.name = "box", .doc = "A box along the axes.", .optional_section = true}, o.box.present, [&o](Section& p) {
    point(p, "center", "Centre.", o.box.center, "[0 um, 0 um, 0 um]");
    p.vector({.name = "size",
              .doc = "Edges.",
              .quantity = Q::kLength,
              .required = true,
              .low = 0.0,
              .low_open = true,
              .example = "[50 um, 50 um, 10 um]"},
             o.box.size);
  });
  s.group({.name = "pipette",
           .doc = "A tube with a rounded mouth, open along its axis.",
           .optional_section = true,
           .example = "{from: [0 um, 0 um, 0 um], to: [0 um, 0 um, 15 um], radius: 2.5 um}"},
          o.pipette.present, [&o](Section& p) { declare_pipette(p, o); });
  s.word(
      {.name = "side",
       .doc = "Where the cells are: outside the surface, or inside it (a capsule, a mould). A smooth part of a surface bears a sphere "
              "in one place only, its nearest point, with the curvature that it has there, a hollow one where the smooth surface is that "
              "its faces stand for; what another obstacle covers is no place to touch, so that obstacles which meet flush are one surface. "
              "What is to be confined by a mould, a mouth or a tube as narrow as a cell is a shell.",
       .fallback = "outside",
       .words = {"outside", "inside"},
       .example = "inside",
       .source = "chosen"},
      o.side);
  bool present = false;
  s.group({.name = "motion", .doc = "The word `fixed`, or a prescribed motion.", .shorthand = "velocity", .example = "fixed"}, present,
          [&o](Section& m) {
            m.vector({.name = "velocity",
                      .doc = "Velocity of a translation, or `fixed`.",
                      .quantity = Q::kSpeed,
                      .fallback = "fixed",
                      .specials = {{"fixed", 0.0}},
                      .example = "[0 um/h, 0 um/h, 10 um/h]",
                      .source = "chosen"},
                     o.velocity);
            declare_motion_course(m, o);
          });
}

void declare_initial(Section& s, draft::Initial& i) {
  s.text({.name = "type", .doc = "Cell type of these cells (a CSV file names them itself).", .example = "hepatocyte"}, i.type);
  s.whole({.name = "count", .doc = "How many cells fill the shape.", .low = 1, .high = 2.0e8, .example = "400"}, i.count);
  s.word(
      {.name = "fill",
       .doc = "Fill a shape with `count` cells, beside what is there already. `sphere`, `box`: close together, from a regular packing with "
              "a seeded jitter. `random`: in disorder, in a sphere (`radius`) or box (`size`), of which they may fill about 0.6. `layer`: "
              "side by side, hexagonal, "
              "on the plane or wall that `on` names.",
       .words = {"sphere", "box", "random", "layer"},
       .example = "sphere"},
      i.fill);
  s.quantities(
      {.name = "types",
       .doc = "Instead of `type`: a mixture. The parts of the cells that fill the shape, by cell type; they add up to 100 %. Counts "
              "are exact (largest remainders), the order is drawn by `seed`.",
       .quantity = Q::kFraction,
       .low = 0.0,
       .high = 1.0,
       .example = "{red: 50 %, green: 50 %}"},
      i.types);
  s.text({.name = "on",
          .doc = "What a layer lies on: an obstacle that is a plane, or a face of the domain with a wall, such as `z_low`.",
          .example = "z_low"},
         i.on);
  s.vector({.name = "center",
            .doc = "Centre of the shape; a layer begins below it.",
            .quantity = Q::kLength,
            .fallback = "[0 um, 0 um, 0 um]",
            .example = "[0 um, 0 um, 0 um]",
            .source = "chosen"},
           i.center);
  s.quantity({.name = "radius",
              .doc = "Radius of a sphere to fill; of the disc that a layer keeps to.",
              .quantity = Q::kLength,
              .low = 0.0,
              .low_open = true,
              .example = "60 um"},
             i.radius);
  s.vector({.name = "size",
            .doc = "Edges of a box to fill; of the rectangle that a layer keeps to, whose edge along the normal does not count.",
            .quantity = Q::kLength,
            .low = 0.0,
            .low_open = true,
            .example = "[100 um, 100 um, 50 um]"},
           i.size);
  s.vectors({.name = "at",
             .doc = "Cells at these points instead of a filled shape.",
             .quantity = Q::kLength,
             .example = "[[-5 um, 0 um, 0 um], [5 um, 0 um, 0 um]]"},
            i.at);
  s.word({.name = "age",
          .doc = "Each cell at a random point of its cycle, or all newborn.",
          .fallback = "random",
          .words = {"random", "birth"},
          .example = "random",
          .source = "chosen"},
         i.age);
  s.text(
      {.name = "csv",
       .doc = "Cells from a CSV file with the columns x,y,z,type[,radius,phase,model]; units in the header, `x [um]`, or as `units`. "
              "`radius`: of the cell as it is at time 0, wherever it is in its cycle. "
              "`phase`: how far a cell is in its cycle, by the clock of a timer (whatever controls its size), from 0 (birth) to below 1; "
              "of types without a cycle it says nothing. `model`: `sphere` or `shell`.",
       .example = "cells.csv"},
      i.csv);
  s.text({.name = "units", .doc = "Unit of the lengths of a CSV file whose header has none.", .example = "um"}, i.units);
  s.quantity({.name = "coincident_shift",
              .doc = "Cells of a CSV file at the same place are named and moved apart by this distance.",
              .quantity = Q::kLength,
              .fallback = "6 um",
              .low = 0.0,
              .low_open = true,
              .example = "6 um",
              .source = "chosen: one cell radius"},
             i.coincident_shift);
  s.quantity({.name = "coincident_below",
              .doc = "Closer than this counts as the same place.",
              .quantity = Q::kLength,
              .fallback = "1 nm",
              .low = 0.0,
              .example = "1 nm",
              .source = "chosen"},
             i.coincident_below);
  s.group({.name = "volume_from_hull",
           .doc = "The cells of a CSV file share the room they were measured in: the convex hull of their places, inflated by a margin, "
                  "less a cavity.",
           .optional_section = true,
           .example = "{margin: 6 um}"},
          i.has_hull, [&i](Section& h) {
            h.quantity({.name = "margin",
                        .doc = "How far the tissue reaches beyond the places of its cells.",
                        .quantity = Q::kLength,
                        .fallback = "6 um",
                        .low = 0.0,
                        .example = "6 um",
                        .source = "chosen: one cell radius"},
                       i.hull_margin);
            h.word(
                {.name = "share",
                 .doc = "even: all cells have the same volume. nearest: each has the room that is nearer to its place than to any other.",
                 .fallback = "even",
                 .words = {"even", "nearest"},
                 .example = "nearest",
                 .source = "chosen"},
                i.hull_share);
            h.group({.name = "cavity", .doc = "A ball without cells: its volume is not shared.", .optional_section = true}, i.has_cavity,
                    [&i](Section& c) {
                      point(c, "center", "Centre.", i.cavity_center);
                      radius(c, i.cavity_radius);
                    });
          });
  s.word({.name = "as",
          .doc = "Body of these cells before any region or trigger; without it, as their type says.",
          .words = {"sphere", "shell"},
          .synonyms = {{"cbm", "sphere"}, {"dcm", "shell"}},
          .example = "shell"},
         i.body);
  s.quantity({.name = "start_volume",
              .doc = "Volume at time 0 as a part of the cell's volume.",
              .quantity = Q::kFraction,
              .fallback = "100 %",
              .low = 0.05,
              .high = 1.0,
              .example = "50 %",
              .source = "chosen"},
             i.start_volume);
  s.quantity({.name = "inflate",
              .doc = "Time in which a cell of smaller `start_volume` reaches its volume.",
              .quantity = Q::kTime,
              .fallback = "0 s",
              .low = 0.0,
              .example = "30 min",
              .source = "chosen"},
             i.inflate);
  s.word({.name = "shape",
          .doc = "Stress-free shape of shells: a sphere, or the biconcave disc of a red blood cell, its axis along z with `orientation: "
                 "aligned`.",
          .fallback = "sphere",
          .words = {"sphere", "biconcave"},
          .example = "biconcave",
          .source = "disc: Evans & Fung 1972, doi:10.1016/0026-2862(72)90069-6"},
         i.shape);
  s.word({.name = "orientation",
          .doc = "Each mesh turned by the id of its cell, or all along the axes of the domain. A cell that becomes a shell later is turned "
                 "by its id.",
          .fallback = "random",
          .words = {"random", "aligned"},
          .example = "aligned",
          .source = "chosen"},
         i.orientation);
  s.group({.name = "meshes",
           .doc = "Cells with surfaces of their own, from files: closed surfaces in VTK, STL or OBJ, one for each cell.",
           .optional_section = true,
           .example = "{file: embryo.vtk, scale: 1 um}"},
          i.has_meshes, [&i](Section& m) { declare_meshes(m, i.meshes); });
}

}  // namespace morula::scenarios
