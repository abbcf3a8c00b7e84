#include "targets.h"

#include "comparisons/reports/json.h"

namespace fuzzing {

void results(std::string_view bytes) try {
  const std::string text = json_text(comparisons::reports::parse_results(bytes));
  const std::string again = json_text(comparisons::reports::parse_results(text));
  require(text == again, "what is read is written and read again without a change");
} catch (const comparisons::reports::ResultsError &error) {
  require(!std::string_view(error.what()).empty(), "a refusal has a message");
}

} // namespace fuzzing
