#include "comparisons/scene/time_keys.h"

namespace comparisons::scene {

std::vector<Declaration> time_declarations(const TimeDefaults &defaults) {
  const Range positive{.lower = 0, .lower_open = true};
  return {
      {.name = "end",
       .dimension = dimensions::time,
       .range = positive,
       .default_value = defaults.end,
       .meaning = "time at which the run ends, s"},
      {.name = "cfl",
       .range = {.lower = 0, .upper = 1000, .lower_open = true},
       .default_value = defaults.cfl,
       .meaning = "time step over " + defaults.cfl_meaning},
      {.name = "step",
       .dimension = dimensions::time,
       .range = positive,
       .meaning = "fixed time step in place of cfl, s"},
      {.name = "snapshots",
       .type = Type::integer,
       .range = {.lower = 1, .upper = 1000},
       .default_value = defaults.snapshots,
       .meaning = "states measured and written as curves, evenly spaced in time, the last at the end"},
      {.name = "checkpoint_every",
       .type = Type::integer,
       .range = {.lower = 1},
       .meaning = "steps between checkpoints; if absent there are none"},
      {.name = "resume",
       .type = Type::boolean,
       .default_value = false,
       .meaning = "start from the cell's checkpoint in the output folder, if there is one"},
  };
}

} // namespace comparisons::scene
