#include "study/declare.h"

namespace morula::scenarios {

using Q = Quantity;

void declare_meshes(Section& s, draft::Meshes& m) {
  s.text({.name = "file", .doc = "A legacy VTK (.vtk), STL or OBJ file with the closed surfaces of the cells.", .example = "embryo.vtk"},
         m.file);
  s.words({.name = "files", .doc = "Several such files instead of one.", .fallback = "[]", .example = "[a.stl, b.stl]", .source = "chosen"},
          m.files);
  s.quantity({.name = "scale",
              .doc = "The length that 1 in the file stands for.",
              .quantity = Q::kLength,
              .required = true,
              .low = 0.0,
              .low_open = true,
              .example = "1 um"},
             m.scale);
  s.word({.name = "cell_is",
          .doc = "What is one cell of a file: `part` (a polyhedron of VTK, a solid of STL, an object or group of OBJ), `component` (faces "
                 "that hang "
                 "together), or `file` (all of it). `auto`: parts where there are several closed ones, else components.",
          .fallback = "auto",
          .words = {"auto", "part", "component", "file"},
          .example = "component",
          .source = "chosen"},
         m.cell_is);
  s.text({.name = "id_array",
          .doc = "Instead: faces with the same number in this array of the VTK file (of its cells or points) are one cell.",
          .example = "cell_id"},
         m.id_array);
  s.words(
      {.name = "types",
       .doc = "Instead of `type`: the cell type of each cell in the order of the files; with `type_array`, of the values 0, 1, 2, ... of "
              "that array.",
       .fallback = "[]",
       .example = "[outer, outer, inner]",
       .source = "chosen"},
      m.types);
  s.text({.name = "type_array", .doc = "Array of the VTK file with the number of each cell's type in `types`.", .example = "cell_type_id"},
         m.type_array);
  s.text({.name = "pressure_array",
          .doc = "Array of the VTK file with the pressure inside each cell at time 0; without it, that of a free cell of this volume.",
          .example = "cell_pressure"},
         m.pressure_array);
  s.quantity({.name = "pressure_unit",
              .doc = "The pressure that 1 in that array stands for; needed with `pressure_array`.",
              .quantity = Q::kPressure,
              .low = 0.0,
              .low_open = true,
              .example = "1 Pa"},
             m.pressure_unit);
  s.whole({.name = "nodes",
           .doc = "Remesh every cell evenly to about so many nodes; its volume is kept. `as_is`: keep the nodes of the file.",
           .fallback = "as_is",
           .low = 20,
           .high = 15000,
           .specials = {{"as_is", 0.0}},
           .example = "642",
           .source = "chosen"},
          m.nodes);
  s.quantity({.name = "edge",
              .doc = "Instead of `nodes`: remesh every cell evenly to edges of about this length.",
              .quantity = Q::kLength,
              .low = 0.0,
              .low_open = true,
              .example = "2 um"},
             m.edge);
  s.flag({.name = "repair",
          .doc = "Mend flipped patches, double points and faces without area; the log names each of them. `false`: they are errors.",
          .fallback = "true",
          .example = "true",
          .source = "chosen"},
         m.repair);
  s.quantity({.name = "overlap",
              .doc = "Surfaces in the file may reach this deep into each other; the contact law pushes them apart.",
              .quantity = Q::kLength,
              .fallback = "0.3 um",
              .low = 0.0,
              .example = "0.3 um",
              .source = "chosen: the default of `limits.overlap`"},
             m.overlap);
  s.vector({.name = "center",
            .doc = "Move all cells together so that the centroid of their volume is here; without it they stay where the file has them.",
            .quantity = Q::kLength,
            .example = "[0 um, 0 um, 0 um]"},
           m.center);
}

}  // namespace morula::scenarios
