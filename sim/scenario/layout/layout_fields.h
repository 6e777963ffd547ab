// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The keys of a target's `layout` with their bounds.

#include "sim/scenario/fields.h"
#include "sim/scenario/layout/layout_spec.h"

namespace seaglint {

void visit_layout(LayoutSpec& spec, FieldVisitor& v);

}  // namespace seaglint
