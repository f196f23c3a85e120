#pragma once
#include "fields/field.h"

namespace morula::fields {

/// How long a field may wait while its cells move: one integration spans as many of their steps as the error of holding it still allows
/// (decision 0061). Both functions depend on the field's own state only, which a checkpoint keeps.

/// Whether the field is to be integrated up to `now` [s]: its interval is over, or a cell may have left where its uptake was laid.
bool is_due(const Field& field, double now);

/// After an integration of an interval [s] in which the field changed by `change`, a part of its largest concentration: how long the next may be for a
/// change of `tolerance`; not above twice this one, nor five minutes. A tolerance of 0: as short as can be.
double next_interval(double interval, double change, double tolerance);

}  // namespace morula::fields
