#include "study/error_codes.h"

#include <algorithm>
#include <iterator>

namespace morula::scenarios {
namespace {

constexpr ErrorCode kCodes[] = {
    {100, "not valid YAML",
     "The text breaks the rules of YAML at or just before this place: a bracket or quote that is not closed, a missing colon, "
     "an indentation that fits no section."},
    {101, "unknown key", "The section has no key of this name. Keys are never ignored: a typing error would silently leave the default."},
    {102, "double key", "The same key stands twice in one section. YAML libraries keep one of them without a word; Morula refuses both."},
    {103, "missing key", "A key that has no default is not given."},
    {104, "wrong structure", "The key needs a single value, a list or a map, and something else (or nothing) stands there."},
    {105, "tab in the indentation", "YAML is indented by spaces only."},
    {106, "anchor, alias, merge key or tag",
     "These parts of YAML hide where a value comes from, and merge keys are ignored by some readers. Write the value out."},
    {107, "empty study or more than one document", "A study file is exactly one YAML document that holds keys."},
    {108, "word not allowed", "The key takes one of a few words."},
    {109, "not a whole number", "The key counts something: digits only, no unit, no exponent."},
    {110, "override cannot be applied", "An override on the command line has the form `key.path=value`; list items are numbered from 0."},
    {111, "keys that exclude each other, or one of several is needed", "Some keys are alternatives of each other."},
    {112, "not a name",
     "Names begin with a letter and hold letters, digits, `_` and `-`, at most 64 characters; a name stands for one thing only."},
    {113, "comparison cannot be read", "A trigger is written `pressure > 1 kPa` or `oxygen < 0.05 mM`."},
    {114, "not the id of a cell",
     "Cells are named as events and results name them: `17` for a founder, `17.01` for the second daughter of its first daughter."},
    {201, "unit missing", "Every number with a dimension carries its unit: a bare 5 could be micrometres or metres."},
    {202, "unit not known",
     "The unit is not in the units database (udunits2). Prefixes and products are written `kPa`, `N s/m^3`, `amol/s`."},
    {203, "unit of another quantity", "The unit is known but measures something else than the key."},
    {204, "not a number", "A number is written with digits, a point and an exponent: 12, 0.5, 5e10. No comma, no thousands separator."},
    {205, "unit where none belongs", "The key is a plain number."},
    {301, "not finite", "NaN and infinity are refused everywhere; where there is no limit, a word such as `never` or `unlimited` says so."},
    {302, "out of range", "The value is outside what makes sense physically or numerically."},
    {303, "wrong number of components", "A place, size or direction has three numbers: [x, y, z]."},
    {304, "leading zero", "A number such as 010 is ten to people and eight to YAML; write 10."},
    {401, "no such cell type or obstacle", "The name is not declared under `cell_types` or `geometry`."},
    {402, "no such field", "The name is not declared under `fields`."},
    {403, "no such observable or library study", "The name is not known to this program."},
    {404, "too many of something", "The study declares more cell types, fields or cells than the program can hold."},
    {405, "no such phase", "A trigger names a phase of the cycle of some type, or G0 where a type has quiescence."},
    {406, "no such cell", "Founders are numbered from 1 in the order of `initial`, and there are not so many."},
    {410, "no such measure",
     "`measure`, `x` and `y` name a measure that the program has, or a column of series.csv that this study's runs have. `morula explain "
     "measures` lists the measures."},
    {411, "no such theory", "`against` names a theory that the program has. `morula explain theories` lists them."},
    {412, "measure of the wrong thing",
     "Each measure is taken of certain things: cells, a pair of cells that touch, a load, an obstacle, a field. `of` names such "
     "things of the study, and no others."},
    {413, "theory that does not fit", "A theory predicts certain measures, of things that have what it assumes."},
    {414, "criterion without a limit, or with several",
     "A criterion says what must hold by one of: `against` with `within`, `below`, `above`, `between`."},
    {415, "criterion given twice",
     "An id may stand at several criteria that measure different things, and at a plot once; the same question twice is a mistake."},
    {416, "moment that a run does not have", "A measure is taken at outputs: multiples of `time.output` up to `time.end`."},
    {417, "data that cannot be compared",
     "The CSV file of `against.data` gives each column as `name [unit]`, and has the columns `x` and `y` with units of what they are "
     "compared "
     "with; x increases."},
    {501, "thresholds that make cells flip back and forth",
     "A trigger needs a demote threshold on the other side of the promote threshold, with a gap between."},
    {502, "outside the domain", "A region, an obstacle or a shape to fill does not lie where cells can be."},
    {503, "contact range does not fit the mesh",
     "The adhesive range c must be between a quarter and about a half (0.56) of the mean edge of the shell's mesh: below, adhesion depends "
     "on "
     "where the nodes are (warning); above, faces feel more than their opposite (error)."},
    {504, "no friction with the surroundings",
     "A cell that touches nothing would have no friction at all, and the force balance no unique solution."},
    {505, "initial cell outside the domain", "A cell's centre at time 0 lies outside the domain."},
    {506, "cells do not fit", "The cells of one entry have more volume than the shape they shall fill."},
    {507, "step above the stability limit",
     "Explicit Euler diverges with this step. Use `auto`, a smaller step, or the implicit integrator."},
    {508, "time that is never reached",
     "An output or checkpoint interval is longer than the run: nothing would be written before its end."},
    {509, "adhesion stronger than the cortex",
     "With W >= 2 tension two free surfaces spread on each other without limit; only the elasticity of the cortex stops them, and the "
     "contact angle is its own (warning). A cortex with `elastic: none` has no equilibrium (error)."},
    {510, "values that contradict each other", "Two places of the study say different things about one quantity."},
    {511, "domain too small",
     "With periodic faces a cell would touch its own image, or a pressed shell the same neighbour on both sides. Of two cells the nearest "
     "images meet."},
    {512, "field cannot be resolved",
     "The voxel size gives too many or too few voxels; or cells go by a field that they make, of which a grid of voxels wider than their "
     "radius draws each to the middle of its "
     "own (warning)."},
    {513, "elasticity of the area counted twice",
     "Two laws of one shell resist changes of its area. Their moduli add: say `area: {on_top: true}` where that is meant."},
    {514, "Poisson ratio outside the law",
     "A net of springs with an area modulus has a Poisson ratio of at least 1/3: below, the area modulus would be negative."},
    {515, "key without effect",
     "The key belongs to another law than the one that is chosen, to bodies that no cell has, or to rules that are not there (warnings); "
     "it would be "
     "read and left aside."},
    {516, "law without its numbers", "The law that is chosen needs a number that has no default."},
    {517, "surfaces that sink into each other",
     "The repulsion is so soft that the pressure within the cells pushes their surfaces through each other (warning)."},
    {518, "box that cannot change its size",
     "A box that is periodic along x, y and z can follow a course, with nothing in it but cells: fields and obstacles keep their "
     "places. "
     "The "
     "course begins with the box of `size`, volume 1."},
    {520, "load that cells cannot bear",
     "Tractions, pulls and pressures act on surfaces: they need shells, and chosen nodes need shells that keep their mesh and place."},
    {530, "packing curve that is none",
     "Pressure by packing needs three knots or more, whose packing increases from above 0, and whose pressure begins with 0 and never "
     "falls."},
    {531, "packing softer than the spheres",
     "The ideal filled cell adds what Hertz contacts lack of K_V ln(V0/V). With so small a bulk modulus they lack nothing (told where "
     "`packing.bulk_modulus` is given; the default then adds nothing)."},
    {532, "fit of other cells",
     "A file of `morula calibrate` holds for the shells that it was made with: their `dcm`, radius, adhesion and `contact`. With others "
     "their forces are not "
     "known."},
    {533, "fitted law that is none", "The numbers of a file of `morula calibrate` make no law: it was changed by hand, or is damaged."},
    {534, "cells of a size that was not fitted",
     "Radii of the type lie more than 30 % outside of those that the fitted law was found with."},
    {535, "nothing holds the volume",
     "A shell whose bulk modulus is 0 has no pressure: its tension would shrink it to a point. With `osmosis`, too, the bulk modulus ties "
     "the "
     "volume to what water and solutes ask for."},
    {536, "cell that bursts or dries out",
     "The osmolarity around a cell must leave it a volume that its shell can have, between a fifth of the target volume and ten times it."},
    {537, "nucleus does not fit",
     "The nucleus must lie inside its cell with room to float: at most 80 % of the cell's radius, half of its volume."},
    {538, "links without a nucleus",
     "Links from the cortex to the nucleus need a nucleus: give the shell one, or link the cortex to itself."},
    {539, "more links than nodes", "Each node has one link to the nucleus at most, and one across the cell."},
    {540, "nucleus that water would have to leave", "A rigid nucleus is no solvent: the inactive part of the volume must hold it."},
    {542, "friction fitted with another one",
     "How fast spheres of a fitted law come together and go past each other was found from shells with the friction that the file tells. "
     "With "
     "another one it is a guess."},
    {545, "array of a mesh file", "A VTK file has no array of this name, or the array does not give every cell one finite number."},
    {546, "cells reach into each other", "Two surfaces of the files overlap deeper than `meshes.overlap` allows."},
    {547, "cells cannot be told apart",
     "The files hold no cell, or what is said to be one cell consists of several closed surfaces, or of polygons that enclose nothing."},
    {548, "mesh cannot be remeshed",
     "The wanted triangles are too large for this surface, or so small that a cell would have more than 15000 nodes."},
    {549, "types do not fit the cells",
     "`meshes.types` names more or fewer cell types than there are cells, or than `type_array` has values."},
    {550, "size that no cell has", "A surface encloses a ball smaller than 0.1 um or larger than 1 mm: the `scale` is wrong."},
    {555, "mark that no face can carry",
     "Marks are of the faces of shells. A cone about the polarity needs cells with a polarity. `lateral`, `whole` and `seen` have a "
     "meaning of their own."},
    {556, "tension of a region too weak for the adhesion",
     "Where cells touch, half of the adhesion works against the tension of each. Below that a contact grows until something elastic holds "
     "it "
     "(warning); a cortex with `elastic: none` has no rest (error)."},
    {557, "cavity without walls or pressure", "A cavity presses on faces of shells. One that keeps its solute has a positive pressure."},
    {558, "nothing to move along",
     "The leading edge is where the polarity points to: cells that protrude need one. What cells move along is an obstacle."},
    {570, "load by place in a periodic domain",
     "A grip holds nodes at places of the laboratory, and a pressure with a gradient differs from place to place; a cell that leaves "
     "through "
     "a periodic face would be torn back, or feel a jump."},
    {571, "mesh too fine for this adhesion",
     "Where more than two cells meet, adhesion of nearly the tension of both surfaces folds the surfaces; 13 cells of 642 nodes were "
     "measured to "
     "stall on these folds at W = 0.95 times both tensions, and not at 0.9; meshes of 162 nodes were not."},
    {572, "volume that does not bear the tension",
     "A sphere of tension T and bulk modulus K shrinks without end when K is below 2 T/(3 R)."},
    {580, "region that no face has",
     "`regions` of a pair name marks of faces, one for each of the two materials at most, and so do loads with `marked`: only shells of "
     "the "
     "types that a mark is for carry it; obstacles carry none."},
    {581, "adhesion of a region stronger than the cortex",
     "With W of twice the tension there or more, faces of this region spread on each other until something elastic stops them (warning); a "
     "cortex "
     "with `elastic: none` has no equilibrium (error)."},
    {582, "self-contact that reaches the neighbouring faces",
     "A surface touches itself at a distance of less than half an edge of its mesh: parts of the surface that belong together would push "
     "each other "
     "away."},
    {583, "surface too fine for objective friction",
     "Points of contact keep the number of the obstacle's face that they touch, which objective friction needs, in 17 bits."},
    {584, "nodes that may not slide",
     "`renew_mesh_below` moves the nodes of a shell along its surface. What holds on to single nodes or faces, links and local area "
     "moduli, would be "
     "another thing afterwards."},
    {590, "key of a nucleus that is a shell",
     "A rigid nucleus has a size and the drag of the cytoplasm; mesh and mechanics are those of `kind: shell`."},
    {591, "nucleus whose volume does not bear the tension",
     "A nucleus that is a shell has a bulk modulus, above the pressure of the cytosol and two thirds of its own tension over its radius."},
    {592, "nucleus too coarse for its contact",
     "Between its nodes the surface of a mesh lies edge^2/(8 R) under the ball that it stands for; more than half of the contact range is "
     "not resolved."},
    {593, "no room for the nucleus",
     "A nucleus begins at the centroid of its cell; a cell from a surface file may have no room for it there."},
    {594, "load both by place and by mark",
     "Faces with a mark bear the load wherever they are on the cell; an axis or a part of the nodes has no effect then."},
    {595, "layers that do not go together", "The model holds one spontaneous curvature for all Helfrich layers of a shell."},
    {596, "cell within another body",
     "Surfaces that lie in each other push each other apart near where they cross; a cell whose centre is within another body stays "
     "there."},
    {597, "deep overlap at the start",
     "Shells that lie deeper in each other than `limits.overlap` at time 0 stop a run at once, unless `numerics.start_cap` lets them come "
     "apart."},
    {601, "file missing", "A file that the study names does not exist. Paths are relative to the folder of the study."},
    {602, "file cannot be read", "It is a folder, a device, or its permissions forbid reading."},
    {603, "file too large", "Study files are read up to 5 MiB, CSV files up to 500 MiB."},
    {604, "binary file", "The file holds a zero byte: it is not text."},
    {605, "not UTF-8", "The file holds bytes that are no UTF-8 text."},
    {610, "CSV header",
     "The first line names the columns: x, y, z and type are needed; radius, phase and model are optional; others are listed and left "
     "aside."},
    {611, "CSV row with too few or too many values", "Every row has as many values as the header."},
    {612, "CSV value", "The value cannot be read: NA, NaN and infinite values are refused."},
    {613, "CSV without cells", "The file has a header and no rows."},
    {620, "mesh cannot be read", "The STL or OBJ file is damaged or empty."},
    {621, "mesh is open", "Every edge of the surface must have exactly two faces."},
    {622, "mesh is not oriented",
     "Neighbouring faces must have the same sense of rotation, counter-clockwise seen from outside; a closed surface encloses a positive "
     "volume."},
    {623, "mesh crosses itself", "Two faces that are not neighbours intersect."},
    {624, "mesh has degenerate or double faces", "A face has no area, or the same face stands twice."},
    {625, "mesh is not a surface", "An edge has three or more faces, or two parts of the surface touch in one node."},
    {640, "shape term like an elastic cortex",
     "`shape_stiffness` keeps triangles from collapsing. Above 0.6 times the tension it resists the shear of a cortex that should flow, "
     "and "
     "contact radii and angles come out too small."},
    {646, "shells that wait",
     "With `cycle: {shells: wait}` a shell that reaches its division volume stops growing, as the event `division_waits` says, until its "
     "body is exchanged for a sphere."},
    {647, "adhesion beyond the range of JKR",
     "The JKR law of elastic spheres is one of small contacts: a contact radius up to about 0.4 R. Beyond it spheres overlap by more than "
     "a "
     "tenth, and the areas of their contacts add up to more than their surface."},
    {648, "small spheres that may go far",
     "How far cells go in one step is measured by the range of contact. Where that is more than half of a sphere's radius it may pass a "
     "neighbour: `numerics.max_displacement` should be smaller."},
    {650, "mesh too coarse to divide",
     "The halves of a shell that is cut are mapped onto the mesh of its type. With edges longer than half the radius that mesh has no room "
     "for the rim of the cut."},
    {651, "bodies that rest elsewhere",
     "The law of two spheres has them at another distance at rest than the tension and the adhesion of the type's shells have these. Where "
     "both meet, or a cell "
     "changes its body, they come together by a part of the difference, as fast as their friction lets them (decision 0088). A law that "
     "was fitted to the shells does not have it "
     "(docs/calibration.md)."},
    {655, "column without a unit",
     "Lengths in a CSV file carry their unit in the header, `x [um]`, or the entry of `initial` says it for all of them, `units: um`."},
    {656, "cell types like each other without end",
     "`like` names a type that says its own keys, or is itself like another; the row must end, after 32 types at most."},
    {657, "adhesion that could be two things",
     "Two types take the adhesion of this pair from the types they are like, or from `others`, and these disagree."},
    {658, "no room for cells",
     "Cells that fill a shape keep off obstacles and off cells of earlier entries; what is left of the shape does not hold them all."},
    {659, "cells cannot be placed",
     "An obstacle or a file does not let the cells of time 0 be made; a run would stop for the same reason."},
    {660, "layer or mixture that cannot be made",
     "A layer lies on a plane or on a face of the domain that is a wall; the parts of a mixture are of known types and add up to 100 %."},
    {661, "spheres deep in other cells",
     "Cells begin at less than half of the distance at which they touch: the contact laws are made for small overlaps, and the first steps "
     "throw such cells apart (warning)."},
    {662, "capped start that does not end",
     "With `numerics.start_cap` cells that overlap at time 0 come apart slowly. What has not by `numerics.start_cap_within` has no way "
     "out."},
    {680, "not a colour", "The colour of a cell type is one of the palette's names, or # with six hexadecimal digits."},
    {690, "more keys and values than are read",
     "A study holds at most 200,000 keys, values and lists, enough for the places of 50,000 cells. What is beyond is not read: the other "
     "messages "
     "are about what comes before."},
    {691, "what this build of the program lacks",
     "Remeshing uses CGAL's mesh processing, which is under GPL-3-or-later, and with it the program as a whole. A build with "
     "MORULA_WITH_GPL=OFF leaves it out; cells from files keep their nodes then."},
    {692, "law that cannot be used",
     "A program with laws of its own has added one under a name that is there already, so that a study could not say which of them it "
     "means; or one "
     "without a function that its kind must have; or a column of series.csv whose name would break its header."},
    {693, "fitted law that was changed",
     "A file that `morula calibrate` made says by its `checksum` what it was like. Somebody has changed it since: what it says about its "
     "own error and range "
     "may not hold. A file without a `checksum` is taken as it is."},
    {694, "rule that nobody meets",
     "A trigger compares with what no cell can have (a share of a surface above 2, an age below 0), or with what all have, also a "
     "concentration that the field never has by "
     "what it begins with, its faces and what takes or makes it; a region or trigger comes behind a region that holds every cell; a "
     "region, "
     "cavity or "
     "course begins when the run has ended; a region names more cells than `max_shells` lets be shells."},
    {695, "tension in contact of a fluid cortex",
     "A fluid bears no difference of tension along its surface: surfaces adhere by what contact takes from their tension, W + 2 (γ − "
     "γ_lateral) in place of W, "
     "and those for which that is negative do not stick. Where tensions or adhesion differ by marks beside it, faces in contact have a "
     "tension of their own; "
     "the resistance of triangles to distortion bears the difference, and contact angles lie 2 to 6 degrees beside Young's law."},
    {696, "elastic law whose range cells leave",
     "Faces beside a new interface are stretched by a fifth and more, and so are those of cells that touch where tension or adhesion are "
     "more "
     "than some 0.15 E h. A law that holds for small stretches only ends the run there."},
    {697, "obstacle at a periodic face",
     "An obstacle that is shorter than the domain is seen across periodic faces, as cells are. One that is as long goes on beyond them by "
     "itself, "
     "as far as it reaches: a plane or a tube that reaches a cell's radius beyond the domain on both sides is the same everywhere. One "
     "that "
     "cells live "
     "in has no images: they would leave it."},
    {698, "cavity beside obstacles",
     "A cavity that finds its faces by sight is closed by obstacles and walls of the domain, too. One that is bounded by the faces of a "
     "mark knows "
     "these alone: what an obstacle closes counts as an opening, and with less than half of all directions closed there is no pressure."},
    {699, "more memory than there is",
     "Cells, nodes and voxels take a known amount of memory each; a field is solved by multigrid, which takes some 300 bytes a voxel. "
     "What does not fit is ended by the system."},
    {700, "cycle that never ends",
     "A cell that divides at a volume must grow, in one phase at least; one that does not grow divides by the clock of its phases."},
    {701, "division below the size at birth", "A sizer's division volume must be larger than the volume of the type's mean radius."},
    {702, "phase that size cannot end",
     "The phase that ends when the cell has its division volume is the last one in which cells grow. Sizer and adder need such a phase."},
    {703, "no way into quiescence",
     "`quiescence` names a phase of the cycle, and that phase needs an `arrest`, whose factor takes cells out and back."},
    {704, "water of two bodies",
     "Water flows by the volume that a body has. That of a shell is its mesh, which neighbours compress; that of a sphere is its free "
     "ball, and what pressure leaves of it follows from the bulk "
     "modulus alone. Free cells swell and shrink alike; under pressure only shells hold their water (warning)."},
    {705, "noise that folds a mesh",
     "Fluctuations turn faces against their tension and rigidity. Where the mean square of that angle is above 0.4 the mesh folds, and no "
     "step is found."},
    {706, "planes that go through each other",
     "Two planes that face each other, and of which one moves, have no room between them any more before the study ends (warning): what is "
     "between them is pressed to nothing, and the run ends there."},
    {707, "force beyond the law of spheres",
     "A sphere gives way to what presses it as an elastic ball does by a little, with any overlap. By Hertz's law the middle of a sphere "
     "of radius R comes to "
     "a plane, and those of two alike to one place, at 4/3 E/(1 − ν²) R² (warning from half of it): nothing holds them back then."},
    {708, "growth beyond the law of spheres",
     "In a full mould spheres sink into the wall, and take more room than their growth is stopped for: at 0.2 of their modulus a fifth "
     "more cells than shells are, at 0.4 more "
     "than half, and the run ends beyond the curve of packing (warning from 0.3)."},
};

}  // namespace

std::span<const ErrorCode> error_codes() { return kCodes; }

const ErrorCode* find_error_code(int code) {
  const auto found = std::find_if(std::begin(kCodes), std::end(kCodes), [code](const ErrorCode& e) { return e.code == code; });
  return found == std::end(kCodes) ? nullptr : found;
}

}  // namespace morula::scenarios
