#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/law_info.h"
#include "core/law_values.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// On what a law acts: what its energy (or friction) is a function of.
enum class LawStencil { kEdge, kHinge, kFace, kCell, kNode };

/// Where the strength of a law is kept among the parameters of a shell: in a member, or as the first coefficient of a sheet.
class LawStrength {
 public:
  LawStrength(double ShellParameters::*member) : member_(member) {}                 // NOLINT: a member is a strength
  LawStrength(std::shared_ptr<const SheetLaw> sheet) : sheet_(std::move(sheet)) {}  // NOLINT: so is a sheet

  [[nodiscard]] double of(const ShellParameters& p) const;
  /// To be changed; a sheet is added where there is none, with all other coefficients 1.
  [[nodiscard]] double& in(ShellParameters& p) const;

 private:
  double ShellParameters::*member_ = nullptr;
  std::shared_ptr<const SheetLaw> sheet_;
};

/// What a law of a layer is chosen with: a word of `elastic` or of `bending` in the study, for the first layer of a shell and perhaps for the
/// second, its `membrane`.
///
/// The values are those of the layer: `young`, `thickness` and `poisson` or, of a second layer, `shear_modulus` and `area_ratio`; `rigidity`
/// for a law of bending; and the keys of the word's own.
struct LayerWord {
  enum class Of { kElastic, kBending } of = Of::kElastic;
  std::string word;
  std::string doc;              ///< what it is, after the word and a colon
  std::vector<KeySpec> keys{};  ///< of its own
  bool in_membrane = true;      ///< may be a second layer
  bool resists_area = false;    ///< two such laws add up only if the study says so
  bool has_area_ratio = false;  ///< as a second layer it needs `area_ratio`
  /// Adds the law to the shell.
  void (*build)(const LawValues& values, ShellParameters& shell) = nullptr;
  /// What is wrong with the values, on top of what the shell has already; null: nothing can be.
  std::optional<LawProblem> (*judge)(const LawValues& values, const ShellParameters& shell) = nullptr;
  /// Estimate for the longest explicit step: of an elastic law the largest stiffness of a node [nN/µm], of one of bending that by area
  /// [nN/µm³]. Area of a node [µm²] and square of an edge [µm²].
  double (*stiffness)(const LawValues& values, double node_area, double edge_square) = nullptr;
};

/// A law of the single-cell mechanics: what there is to say about it, where its coefficients are kept, and how a study makes them.
struct ShellLaw {
  LawInfo info;  ///< its parameters are the coefficients, the strength first
  LawStencil stencil = LawStencil::kEdge;
  bool conservative = true;                                     ///< has an energy; otherwise it is a friction
  bool zero_in_reference = true;                                ///< no force in the reference shape at its rest volume
  bool in_operator = true;                                      ///< adds to the matrix of the implicit step
  std::vector<double ShellParameters::*> coefficients{};        ///< as info.parameters; empty for a sheet
  std::shared_ptr<const SheetLaw> sheet{};                      ///< of a law of the strain of a face
  void (*build)(const LawValues&, ShellParameters&) = nullptr;  ///< of a law that every shell has; null: only by its words
  std::vector<LayerWord> words{};                               ///< that choose the law

  [[nodiscard]] LawStrength strength() const { return sheet ? LawStrength(sheet) : LawStrength(coefficients.front()); }
};

/// The coefficients of a law in a shell by the names of info.parameters, of every sheet of this law by itself; empty where the law does not act.
std::vector<std::vector<double>> coefficients_of(const ShellLaw& law, const ShellParameters& shell);

/// Adds a sheet to a shell. A sheet of the same law whose other coefficients are the same grows by the strength.
void add_sheet(ShellParameters& shell, const std::shared_ptr<const SheetLaw>& law, const SheetCoefficients& coefficients);

/// Shear modulus G and area ratio α = ν/(1 − ν) of a layer: what is given, else that of a thin sheet of Young's modulus, thickness and
/// Poisson ratio.
struct SheetModuli {
  double shear, area_ratio;
  static SheetModuli of(const LawValues& values);
};

/// LayerWord::stiffness of a sheet: 7.2 E h, with E h = 3 G where that is given, and times an area ratio above 1 where that is given.
double sheet_stiffness(const LawValues& values, double node_area, double edge_square);

}  // namespace morula::dcm
