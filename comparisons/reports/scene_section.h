#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

namespace comparisons::reports {

/// The scenes of a run with the hashes of their texts, so that two reports can be known to be of the same scene.
void append_scenes(Document &document, const Results &results);

} // namespace comparisons::reports
