#pragma once
// Whom a garment fits: it is made to the measures of one person after another, brought to rest on each and examined.
// For a few; for very many there is `karinui batch`. The document is left as it is. Long; any thread, with its own
// context.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/history.h"
#include "karinui/exchange/measurement_table.h"
#include "karinui/session/fit.h"

namespace karinui {

// The steps that lead to a garment, with all they need, apart from its document.
struct GarmentRecipe {
  std::vector<Step> steps;
  MemoryBlobs blobs;                         // photographs
  std::map<std::uint64_t, Outline> drawnOn;  // by a step's seq: the outline that was drawn anew on the paper
};
using RecipePtr = std::shared_ptr<const GarmentRecipe>;
Result<RecipePtr> recipeOf(DocumentFile& file, Context& context);

// A step as it is done on another figure, on the garment as it is there. An outline that was pulled from the cloth is
// found anew; one that was drawn on the paper is drawn as far from the piece as it is there now.
Operation madeToFit(const GarmentRecipe& recipe, const Step& step, const Document& now);

// The garment made to a figure: every choice of a figure becomes this one. The error names the step. `asFar`, if given,
// is left as far as it came.
Result<Document> madeFor(const GarmentRecipe& recipe, const SetBody& body, Context& context, Document* asFar = nullptr);

struct GarmentWearer {
  std::string name;
  SetBody body;
};
std::vector<GarmentWearer> wearersOf(const MeasurementTable& table);
SetBody figureOf(const Measurements& measures);
// These measures with all girths of the trunk wider by so much (metres).
Measurements widened(Measurements measures, double by);

// The first of these that holds.
enum class FitFault { None, TooSmall, NotClosed, CrossesBody, Stretched, Presses, NotSettled, Refused };
struct FitLimits {
  double strain = 0.08;    // 99 of 100 parts of the cloth are stretched less
  double pressure = 4000;  // Pa, at 99 of 100 places: clothes are comfortable up to 2 to 4 kPa (Denton 1972)
};

struct FitOnBody {
  std::string name;
  Document document;  // at rest; what was refused: as far as it came
  BodyPtr body;       // null: it could not be made
  StrainReport strain;
  std::optional<PressureReport> pressure;
  SnapshotPtr garment;            // of that document
  std::vector<float> pressureAt;  // pressureOnBody() of it; empty where it was refused
  std::vector<Girths> girths;
  FitFault fault = FitFault::None;
  double by = 0;  // metres too small, a stretch, pascals, how many fastenings or places
  Message where;  // may be empty
  Message why;    // of what was refused, is too small or did not come to rest: a sentence
  bool fits() const { return fault == FitFault::None; }
};
Message faultSaid(const FitOnBody& fit);  // "too small: 3 cm, at the waist"; empty: it fits
std::vector<std::string> columnsOf(const std::vector<FitOnBody>& all);  // names of the girths that any has, in English

// One after another; `each` is told of every one that is ready. What is refused on a body is told of that body; an
// error is of the machine, or that it was stopped.
Result<std::vector<FitOnBody>> fitOverBodies(const GarmentRecipe& recipe, const std::vector<GarmentWearer>& wearers,
                                             Context& context, const std::function<void(const FitOnBody&)>& each = {});

// As a table for other programs: RFC 4180, metres, pascals, shares.
std::string csvOf(const std::vector<FitOnBody>& all);

}  // namespace karinui
